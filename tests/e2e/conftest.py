"""Fixtures that tests of the browser share."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page
from support.page_scripts import SILENT_WORKER
from support.reader import PHONE, Reader, visit
from support.static_server import StaticServer, serving


@pytest.fixture(scope="session")
def uncached(built_site: Path) -> Iterator[StaticServer]:
    """The book from a host that forbids caching; tests set its faults."""
    with serving(built_site) as server:
        server.uncached = True
        yield server


@pytest.fixture(scope="session")
def telephone(baseline_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    options: dict[str, Any] = {"viewport": PHONE, "has_touch": True, "is_mobile": True}
    with visit(baseline_chromium, site_server, SILENT_WORKER, **options) as reader:
        yield reader


@pytest.fixture
def quiet_phone(telephone: Reader) -> Iterator[Reader]:
    """A telephone on which Python never starts; each test loads its pages anew."""
    telephone.reset(PHONE)
    yield telephone
    telephone.assert_no_errors()


@pytest.fixture
def tabs(baseline_chromium: Browser, site_server: StaticServer) -> Iterator[list[Page]]:
    """Two tabs of one browser, in which Python never starts."""
    with visit(baseline_chromium, site_server, SILENT_WORKER) as reader:
        other = reader.page.context.new_page()
        other.add_init_script(SILENT_WORKER)
        yield [reader.page, other]
        reader.assert_no_errors()


@pytest.fixture
def figure(guest: Reader, book: Any) -> Iterator[Locator]:
    """The figure at rest at its page's settings, with all answers shown, and with a clock that lets
    glides have intermediate frames even on a busy machine."""
    found = guest.figure_at_rest(book, "lens-distortion")
    guest.page.evaluate("document.querySelectorAll('[data-reveal]').forEach((b) => b.click())")
    guest.page.evaluate(STEADY_CLOCK)
    yield found
    guest.page.evaluate("() => { requestAnimationFrame = usualFrame; }")
    guest.page.emulate_media(reduced_motion="null")


STEADY_CLOCK = """() => {
  const usual = requestAnimationFrame;
  let [now, last] = [0, 0];
  globalThis.usualFrame = usual;
  requestAnimationFrame = (draw) => usual((time) => {
    if (time > last) [now, last] = [now + 40, time];
    draw(now);
  });
}"""
