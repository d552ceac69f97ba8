"""The built book in a browser, with a script of the bench beside it."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import JSHandle, Page
from support.chromium import open_chromium
from support.reader import DESK
from support.static_server import serving

SCRIPTS = Path(__file__).parent / "js"
CENTRE = """figure => figure.scrollIntoView({block: 'center', behavior: 'instant'})"""
RESTS = """() => [...document.querySelectorAll('simulation-figure')]
  .every(figure => figure.dataset.state === 'live' && figure.rests)"""


@contextmanager
def open_book(site: Path) -> Iterator[tuple[Page, str]]:
    """A page, and the address of the book."""
    with open_chromium() as browser, serving(site) as server:
        page = browser.new_page(viewport=DESK, service_workers="block", bypass_csp=True)
        page.set_default_timeout(60_000)
        yield page, server.url


def script(page: Page, name: str) -> JSHandle:
    """The module ``js/NAME`` in the page; it goes with it."""
    source = (SCRIPTS / name).read_text(encoding="utf-8")
    return page.evaluate_handle(
        "source => import(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})))",
        source,
    )


def figure_at_rest(page: Page, scene: str) -> JSHandle:
    """The figure of a scene in the middle of the window, when all of the page have their frames."""
    figure = page.query_selector(f'simulation-figure[data-simulation="{scene}"]')
    if figure is None:
        raise ValueError(f"scene {scene!r}; legal: one that this page shows")
    figure.evaluate(CENTRE)
    page.wait_for_function(RESTS)
    return figure
