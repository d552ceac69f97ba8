"""Each file of the runtime missing, maimed, late or another: told in plain words, tried again."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser
from support.reader import START_MS, Reader, visit
from support.runtime_faults import KINDS, SAID, TRIED, WITHOUT_SNAPSHOT
from support.static_server import Fault, StaticServer

pytestmark = pytest.mark.browser

SAMPLE = (
    ("numpy.zip", "missing"),
    ("pyodide.asm.wasm", "half"),
    ("runtime.json", "login as file"),
    ("worker.js", "missing"),
)
"""Of a part, of the interpreter, of the table of both, and of the worker's own script."""


@pytest.fixture(scope="module")
def reader(brisk_chromium: Browser, uncached: StaticServer) -> Iterator[Reader]:
    """A reader who stays on one page and tries again; the browser complains of each file."""
    with visit(brisk_chromium, uncached) as someone:
        yield someone


def told(reader: Reader) -> str:
    """What the figure says of the next try."""
    figure = reader.figure("lens-distortion")
    retry = figure.locator(".retry")
    if reader.page.url == "about:blank":
        reader.open("lens-distortion/", live=False)
    else:
        retry.click()
    retry.wait_for(timeout=START_MS)
    return figure.locator(".figure-message").inner_text()


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        pytest.param(name, kind, marks=[] if (name, kind) in SAMPLE else pytest.mark.deep)
        for name, kinds in TRIED.items()
        for kind in kinds
    ],
)
def test_what_is_wrong_with_a_file_is_told(
    reader: Reader, uncached: StaticServer, name: str, kind: str
) -> None:
    uncached.faults = {**WITHOUT_SNAPSHOT, f"/{name}": KINDS[kind]}
    message = told(reader)
    assert message.startswith("Python did not start")
    assert name in message
    assert SAID.get(kind, "arrived damaged") in message


def test_a_page_older_than_its_host_offers_to_be_loaded_anew_and_keeps_its_settings(
    reader: Reader, uncached: StaticServer
) -> None:
    uncached.faults = {**WITHOUT_SNAPSHOT, "/numpy.zip": Fault(status=404)}
    told(reader)
    uncached.faults |= {
        "/lens-distortion/": Fault(
            lambda page: page.replace(b"/runtime/", b"/runtime/next-"), media_type="text/html"
        ),
    }
    told(reader)
    slider = reader.figure("lens-distortion").locator("input[type=range]").first
    slider.press("ArrowRight")
    moved = slider.input_value()
    notice = reader.page.locator(".notice")
    assert "has been updated" in notice.inner_text()
    reader.page.wait_for_function("location.search !== ''")
    del uncached.faults["/lens-distortion/"]
    notice.get_by_role("button", name="Reload the page").click()
    reader.figure("lens-distortion").locator(".retry").wait_for(timeout=START_MS)
    assert slider.input_value() == moved


def test_python_starts_by_itself_once_the_host_is_back_with_late_files_of_other_types(
    reader: Reader, uncached: StaticServer
) -> None:
    uncached.gone = True
    assert "did not load" in told(reader)
    slider = reader.figure("lens-distortion").locator("input[type=range]").first
    slider.press("ArrowRight")
    moved = slider.input_value()
    uncached.gone = False
    uncached.faults = {
        **WITHOUT_SNAPSHOT,
        "/numpy.zip": Fault(late_s=2),
        **{f"/{name}": Fault(media_type="text/plain") for name in ("python.zip", "runtime.json")},
        "/pyodide.asm.wasm": Fault(media_type="application/octet-stream"),
    }
    reader.page.context.set_offline(True)
    reader.page.context.set_offline(False)
    reader.wait_live()
    assert slider.input_value() == moved
    assert not reader.page.locator(".figure-status:visible").count()
