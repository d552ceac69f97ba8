"""The snapshot of a started interpreter that the book ships: Python continues from it, and starts
plainly where it does not arrive whole."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from support.page_scripts import FRUGAL
from support.reader import START_MS, Reader, visit
from support.static_server import FAULTS, Fault, StaticServer

pytestmark = pytest.mark.browser

CHAPTER, SCENE = "lens-distortion/", "lens-distortion"
SNAPSHOT = "/snapshot.wasm"
IPHONE = "Mozilla/5.0 (iPhone; CPU iPhone OS 18_5 like Mac OS X) AppleWebKit/605.1.15"
BUILT_ON = ("python", "numpy", "core")
"""The parts that a snapshot holds, so that they can come later."""


@pytest.fixture
def reader(brisk_chromium: Browser, uncached: StaticServer) -> Iterator[Reader]:
    """Someone who opens the book for the first time."""
    uncached.faults = {}
    with visit(brisk_chromium, uncached, FRUGAL) as someone:
        yield someone


def open_live(reader: Reader) -> None:
    """Open the chapter, until its first figure lives; others may lack what they need."""
    reader.open(CHAPTER, live=False)
    expect(reader.figure(SCENE)).to_have_attribute("data-state", "live", timeout=START_MS)


def moved(reader: Reader) -> Any:
    """What the figure shows after a key on its first slider."""
    figure = reader.figure(SCENE)
    reader.press(figure, "ArrowRight")
    reader.settle(figure)
    return reader.shown(figure)


def test_figures_live_before_what_the_snapshot_holds_has_come_and_machine_code_that_they_need_later(
    reader: Reader, uncached: StaticServer, built_site: Path
) -> None:
    """Though the snapshot comes late, and by the type of a file that a host does not know."""
    uncached.faults = {SNAPSHOT: Fault(late_s=1, media_type="application/octet-stream")}
    uncached.faults |= {f"/{name}.zip": Fault(late_s=3600) for name in (*BUILT_ON, "numpy-fft")}
    fetched = reader.note_parts()
    open_live(reader)
    (listed,) = built_site.glob("runtime/*/runtime.json")
    table = json.loads(listed.read_text(encoding="utf-8"))
    needed = {*table["scenes"][SCENE]} - {*table["machine_code"]}
    assert needed <= {*fetched}
    assert len({*fetched}) == len(fetched), "nothing twice"


def test_figures_live_where_python_has_no_trampoline(
    brisk_chromium: Browser, server: StaticServer
) -> None:
    """On iPhones CPython does without, so its table of functions is shorter by one."""
    with visit(brisk_chromium, server, FRUGAL, user_agent=IPHONE) as someone:
        said: list[str] = []
        someone.page.on("console", lambda message: said.append(message.text))
        open_live(someone)
        moved(someone)
    someone.assert_no_complaints()
    assert not said, "it would say that it starts plainly"


def test_from_a_damaged_snapshot_python_starts_plainly_and_figures_show_the_same(
    reader: Reader, uncached: StaticServer, brisk_chromium: Browser
) -> None:
    fetched = reader.note_parts()
    reader.open(CHAPTER)
    after_snapshot = moved(reader)
    assert {*BUILT_ON} <= {*fetched}, "they come when a frame is computed"
    uncached.faults = {SNAPSHOT: FAULTS["changed"]}
    with visit(brisk_chromium, uncached, FRUGAL) as someone:
        fetched = someone.note_parts()
        open_live(someone)
        assert {*BUILT_ON} <= {*fetched}
        assert not someone.page.locator(".figure-status:visible").count()
        assert moved(someone) == after_snapshot


@pytest.mark.deep
@pytest.mark.parametrize("kind", FAULTS)
def test_from_any_damaged_snapshot_python_starts_plainly_and_the_page_says_nothing(
    reader: Reader, uncached: StaticServer, kind: str
) -> None:
    uncached.faults = {SNAPSHOT: FAULTS[kind]}
    fetched = reader.note_parts()
    open_live(reader)
    assert {*BUILT_ON} <= {*fetched}
    assert not reader.page.locator(".figure-status:visible").count()


@pytest.mark.parametrize(
    "name",
    [BUILT_ON[0], *(pytest.param(name, marks=pytest.mark.deep) for name in BUILT_ON[1:])],
)
def test_what_a_frame_lacks_is_told_and_asked_for_again(
    reader: Reader, uncached: StaticServer, name: str
) -> None:
    uncached.faults = {f"/{name}.zip": Fault(status=404)}
    open_live(reader)
    figure = reader.figure(SCENE)
    figure.locator("input[type=range]").first.press("ArrowRight")
    retry = figure.locator(".retry")
    retry.wait_for(timeout=START_MS)
    message = figure.locator(".figure-message").inner_text()
    assert f"{name}.zip could not be loaded: the server answered 404" in message
    uncached.faults = {}
    retry.click()
    reader.wait_live()
