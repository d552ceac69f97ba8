"""The start of Python: in the head of the page, with or without a snapshot, with only the files
that the page needs, and for readers who save data only on request."""

import json
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Route, expect
from support.page_scripts import SAVE_DATA, SILENT_WORKER
from support.reader import Reader, chapter_of, visit
from support.static_server import FAULTS, Fault, StaticServer

from simulations.registry import LADDER_MODULES, load_ladder

pytestmark = pytest.mark.browser

CHAPTER, SCENE, CONTROL = "lens-distortion/", "lens-distortion", "k1"
SNAPSHOT = "snapshot.wasm"
BUILT_ON = ("python", "numpy", "core")
"""The parts that a snapshot contains, so that they can arrive later."""


@pytest.fixture
def chapters(book: Any) -> list[Any]:
    """A chapter with one figure, the next, which also has figures, and one farther away."""
    few = [len(chapter["simulations"]) for chapter in book["chapters"]]
    first = next(at for at in range(len(few)) if few[at] == 1 and few[at + 1])
    far = next(at for at in range(first + 3, len(few)) if few[at])
    return [book["chapters"][at] for at in (first, first + 1, far)]


def test_python_starts_in_the_head_with_the_pages_frame_and_prepares_more(
    baseline_chromium: Browser, server: StaticServer, chapters: list[Any]
) -> None:
    """It imports the next chapter's scenes, and redraws a page built from other sources."""
    held: list[Route] = []
    with visit(baseline_chromium, server, WATCH) as reader:
        page, (scene,) = reader.page, chapters[0]["simulations"]
        page.context.route("**/runtime.json", lambda route: held.append(route))
        reader.open(chapters[0]["url"], live=False)
        figure = reader.figure(scene)
        before = reader.content(figure)
        for route in held:
            route.continue_()
        reader.wait_live()
        assert reader.content(figure) == before
        begun = [str(call).strip() for call in page.evaluate("window.calls")]
        assert begun[:2] == ["worker in the head", "start"]
        assert sum(call.startswith("worker") for call in begun) == 1
        assert len(page.workers) == 1
        assert f"prepare {scene} starting" in begun
        assert f"render {scene} starting" not in begun
        page.wait_for_function(
            "scene => window.calls.some((call) => call.startsWith(`prepare ${scene}`))",
            arg=chapters[1]["simulations"][0],
        )
        address, scene = chapters[2]["url"], chapters[2]["simulations"][0]
        other = re.compile(rb'data-sources="[^"]*"')
        server.faults[f"/{address}"] = Fault(
            lambda page: other.sub(b'data-sources="sha256-other"', page), media_type="text/html"
        )
        page.evaluate("window.calls = []")
        reader.turn_to(address)
        assert f"render {scene} starting" in page.evaluate("window.calls")


WATCH = """window.calls = [];
const record = (...what) => window.calls.push(what.join(' '));
globalThis.Worker = class extends Worker {
  constructor(...given) {
    super(...given);
    record('worker', document.body ? 'late' : 'in the head');
  }
  postMessage(message, ...given) {
    const figure = document.querySelector(`[data-simulation="${message.scene}"]`);
    record(message.call, message.scene ?? '', figure?.dataset.state ?? '');
    super.postMessage(message, ...given);
  }
};"""
"""Record workers and their calls in order, with the state of the figure of each call."""


def test_linked_page_is_fetched_once_on_hover_or_focus(
    plain_reader: Reader, chapters: list[Any]
) -> None:
    page, wanted = plain_reader.page, plain_reader.root + chapters[1]["url"]
    for hint in ("hover", "focus"):
        plain_reader.open(chapters[0]["url"], live=False)
        fetched = plain_reader.record_requests()
        for address in ("https://elsewhere.example/", "#main", "../book.json", "mailto:a@b.c"):
            page.evaluate(OFFER, address)
            page.locator("#offered").hover()
        link = page.locator(".pager a[rel=next]")
        with page.expect_response(wanted):
            link.hover() if hint == "hover" else link.focus()
        pages = [url for url in fetched if not url.startswith(f"{plain_reader.root}assets/")]
        assert pages == [wanted]
        link.click()
        page.wait_for_function(
            "url => location.href === url && document.activeElement?.id === 'main'", arg=wanted
        )
        assert fetched.count(wanted) == 1


OFFER = """(address) => {
  document.getElementById('offered')?.remove();
  const link = Object.assign(document.createElement('a'), {href: address, id: 'offered'});
  link.textContent = 'A link';
  document.getElementById('main').prepend(link);
}"""


def test_prerendered_frames_follow_a_slider_until_python_is_live(
    reader: Reader, built_site: Path, book: Any
) -> None:
    held: list[Route] = []
    page, figure = reader.page, reader.figure(SCENE)
    page.context.route("**/runtime.json", lambda route: held.append(route))
    reader.open(chapter_of(book, SCENE), live=False)
    place = figure.get_attribute("data-prerendered") or ""
    strip = json.loads((built_site / place.removeprefix("../")).read_text(encoding="utf-8"))
    wanted = strip["frames"][-2]
    box = reader.scroll_to(figure)
    figure.evaluate(MOVE, [CONTROL, wanted["value"] + 0.01])
    figure.locator(".early-mark").wait_for()
    early = reader.content(figure)
    assert figure.get_attribute("data-early") == str(wanted["value"])
    assert figure.get_attribute("data-frames") == "0"
    for readout in wanted["readouts"]:
        shown = figure.locator(f"output[name={readout['name']}]").text_content()
        assert readout["text"] in (shown or "")
    for route in held:
        route.continue_()
    reader.wait_live()
    assert reader.content(figure) != early, "not the frame of just this value"
    assert figure.locator(".early-mark").count() == 0
    assert reader.scroll_to(figure) == box
    # A slider moved before any script ran.
    page.context.route("**/runtime.json", lambda _: None)
    page.add_init_script(MOVED)
    reader.open(chapter_of(book, SCENE), live=False)
    figure.scroll_into_view_if_needed()
    expect(figure).to_have_attribute("data-early", "0.3")


MOVE = """(figure, [name, value]) => {
  const slider = figure.querySelector(`input[name="${name}"]`);
  slider.value = value;
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}"""
MOVED = f"""document.addEventListener('readystatechange', () => {{
  const figure = document.getElementById('figure-{SCENE}');
  if (figure && document.readyState === 'interactive') {{
    figure.querySelector('input[name={CONTROL}]').value = '0.3';
  }}
}})"""

SAVES_DATA = "Object.defineProperty(navigator, 'connection', {value: {saveData: true}});"
REDUCED = """const query = matchMedia;
globalThis.matchMedia = (text) => text.includes('reduced-data') ? {matches: true} : query(text);"""
SLOW_LINK = "Object.defineProperty(navigator, 'connection', {value: {effectiveType: '2g'}});"
LITTLE_MEMORY = "Object.defineProperty(navigator, 'deviceMemory', {value: 0.5});"
LOST = "addEventListener('pagehide', (event) => event.stopImmediatePropagation());"
"""A tab that crashes gets no `pagehide` event."""


@contextmanager
def data_saving_visit(
    chromium: Browser, server: StaticServer, script: str
) -> Iterator[tuple[Reader, Locator, list[str]]]:
    """A reader whose browser runs ``script``, the figure, and the files of Python requested."""
    with visit(chromium, server, script) as reader:
        python = reader.record_requests("/runtime.json", "/worker.js", ".wasm", ".zip")
        yield reader, reader.figure(SCENE), python
    reader.assert_no_errors()


@pytest.mark.parametrize(
    "script",
    [
        LITTLE_MEMORY,
        *(pytest.param(x, marks=pytest.mark.deep) for x in (SAVES_DATA, REDUCED, SLOW_LINK)),
    ],
)
def test_figure_of_a_data_saving_reader_starts_on_request_with_settings(
    baseline_chromium: Browser, server: StaticServer, book: Any, script: str
) -> None:
    with data_saving_visit(baseline_chromium, server, script) as (reader, figure, python):
        page = reader.page
        reader.open(chapter_of(book, SCENE), live=False)
        begin = figure.get_by_role("button", name="Start the figures")
        reader.scroll_to(begin)
        slider = figure.locator(f"input[name={CONTROL}]")
        slider.press("ArrowRight")
        chosen = slider.input_value()
        figure.locator(".early-mark").wait_for()  # a prerendered frame
        page.wait_for_load_state("networkidle")
        expect(figure).to_have_attribute("data-state", "waiting")
        assert not python
        begin.press("Enter")
        reader.wait_live()
        assert python
        assert not begin.is_visible()
        assert slider.input_value() == chosen
        assert figure.locator(".early-mark").count() == 0
        reader.turn_to(book["chapters"][0]["url"])  # the rest of the visit is as usual
        page.reload()
        begun = re.compile("starting|live")
        expect(page.locator("simulation-figure").first).to_have_attribute("data-state", begun)


def test_figures_wait_for_a_request_after_two_crashed_tabs(
    baseline_chromium: Browser, server: StaticServer, book: Any
) -> None:
    """Tabs that are closed before Python has started do not count as crashed."""
    for script, expected in ((LOST, ["starting", "starting", "waiting"]), ("", ["starting"] * 3)):
        with data_saving_visit(baseline_chromium, server, SILENT_WORKER + script) as (
            reader,
            figure,
            _,
        ):
            states = []
            for _ in range(3):
                reader.open(chapter_of(book, SCENE), live=False)
                states.append(figure.get_attribute("data-state"))
            assert states == expected
            if script:
                figure.get_by_role("button", name="Start the figures").click()
                assert figure.get_attribute("data-state") == "starting"


def open_live(reader: Reader) -> None:
    """Open the chapter until its first figure is live; other figures may lack files."""
    reader.open(CHAPTER, live=False)
    expect(reader.figure(SCENE)).to_have_attribute("data-state", "live")


def content_after_a_move(reader: Reader) -> Any:
    """The figure's content after a key press on its first slider."""
    figure = reader.figure(SCENE)
    reader.press(figure, "ArrowRight")
    reader.settle(figure)
    return reader.content(figure)


def test_figures_start_from_the_snapshot_or_without_a_damaged_one(
    baseline_chromium: Browser, uncached: StaticServer, built_site: Path
) -> None:
    """Before the snapshot's parts arrive, even if it is late and has a wrong media type. On iPhones
    CPython has no trampoline."""
    late = {f"/{name}.zip": Fault(delay_s=3600) for name in (*BUILT_ON, "numpy-fft")}
    uncached.faults = {
        f"/{SNAPSHOT}": Fault(delay_s=1, media_type="application/octet-stream"),
        **late,
    }
    with visit(baseline_chromium, uncached, SAVE_DATA) as reader:
        fetched = reader.record_parts()
        open_live(reader)
        (listed,) = built_site.glob("runtime/*/runtime.json")
        table = json.loads(listed.read_text(encoding="utf-8"))
        needed = {*table["scenes"][SCENE]} - {*table["machine_code"]}
        assert needed <= {*fetched}
        assert len({*fetched}) == len(fetched), "nothing twice"
    uncached.faults = {}
    with visit(baseline_chromium, uncached, SAVE_DATA, user_agent=IPHONE) as reader:
        messages: list[str] = []
        reader.page.on("console", lambda message: messages.append(message.text))
        open_live(reader)
        assert not messages, "a start without the snapshot would be logged"
        after_snapshot = content_after_a_move(reader)
    uncached.faults = {f"/{SNAPSHOT}": FAULTS["changed"]}
    with visit(baseline_chromium, uncached, SAVE_DATA) as reader:
        fetched = reader.record_parts()
        open_live(reader)
        assert {*BUILT_ON} <= {*fetched}
        assert content_after_a_move(reader) == after_snapshot


IPHONE = "Mozilla/5.0 (iPhone; CPU iPhone OS 18_5 like Mac OS X) AppleWebKit/605.1.15"


@pytest.fixture
def table(server: StaticServer, built_site: Path) -> Any:
    """``runtime.json`` served without the snapshot, with pages that do not have its hash."""
    (file,) = built_site.glob("runtime/*/runtime.json")
    read = json.loads(file.read_text(encoding="utf-8"))
    integrity = {name: value for name, value in read["integrity"].items() if name != SNAPSHOT}
    plain = {**read, "integrity": integrity}
    own_table = re.compile(rb' data-table="[^"]*"')
    server.damaged["/runtime.json"] = json.dumps(plain).encode()
    server.faults["/"] = Fault(lambda page: own_table.sub(b"", page), media_type="text/html")
    return plain


def a_chapter(book: Any, table: Any, wanted: Callable[[set[str]], bool]) -> tuple[str, set[str]]:
    """Address and imported parts of a chapter whose library parts are as ``wanted``."""
    for chapter in book["chapters"]:
        parts = {part for scene in chapter["simulations"] for part in table["scenes"][scene]}
        if chapter["simulations"] and wanted(of_libraries(parts)):
            return chapter["url"], parts
    raise AssertionError("no such chapter")


def of_libraries(parts: Iterable[str]) -> set[str]:
    """Parts that contain only libraries."""
    return {part for part in parts if not part.startswith(("scene-", "ladder-"))}


@pytest.mark.parametrize(
    "ladders", [("shading",), pytest.param((*LADDER_MODULES,), marks=pytest.mark.deep)]
)
def test_pages_fetch_only_the_parts_that_scenes_and_ladders_import(
    baseline_chromium: Browser,
    server: StaticServer,
    book: Any,
    table: Any,
    ladders: tuple[str, ...],
) -> None:
    first, none = a_chapter(book, table, lambda parts: not parts)
    second, many = a_chapter(book, table, lambda parts: parts > of_libraries(none))
    with visit(baseline_chromium, server, SAVE_DATA) as reader:
        fetched, requests = reader.record_parts(), reader.record_requests()
        reader.open(first)
        assert sorted(fetched) == sorted({*BUILT_ON} | none)
        reader.turn_to(second)
        assert sorted(fetched) == sorted({*BUILT_ON} | none | many), "each of them once"
        assert not [url for url in requests if "editor" in url or "/python/" in url]
        named = set()
        for ladder in ladders:
            payload = {"ladder": ladder, "tier": load_ladder(ladder).default_tier, "budget": 0.001}
            reply = reader.page.evaluate(CALL, ["measure", payload])
            assert json.loads(reply["result"])["errors"], ladder
            named.update(table["ladders"][ladder])
        assert named <= {*fetched}
        assert len({*fetched}) == len(fetched), "nothing twice"
        assert "python-rest" not in fetched
        reader.assert_no_errors()


CALL = """async ([name, payload]) => {
  const {sharedRuntime} = (await customElements.whenDefined('simulation-figure')).internals;
  return sharedRuntime().call(name, payload);
}"""


def test_unavailable_part_stops_its_figures_and_is_fetched_on_retry(
    reader: Reader, server: StaticServer, book: Any, table: Any
) -> None:
    """The table lists no parts, so that each is fetched when Python imports it."""
    reader.page.add_init_script(SAVE_DATA)
    fetched = reader.record_parts()
    address, parts = a_chapter(book, table, bool)
    part = max(of_libraries(parts))
    foreseen = {scene: [f"scene-{scene}"] for scene in table["scenes"]}
    server.damaged["/runtime.json"] = json.dumps({**table, "scenes": foreseen}).encode()
    server.faults[f"/{part}.zip"] = Fault(status=404)
    reader.open(address, live=False)
    figure = reader.page.locator("simulation-figure").first
    retry, message = figure.locator(".retry"), figure.locator(".figure-message")
    figure.locator("input[type=range]").first.press("ArrowRight")  # the page's own needs no part
    retry.wait_for()
    assert f"{part}.zip could not be loaded: the server answered 404" in message.inner_text()
    for fault, words in (
        (Fault(lambda _: b"<title>Sign in</title>"), f"a web page came instead of {part}.zip"),
        (FAULTS["changed"], f"{part}.zip arrived damaged"),
    ):
        server.faults[f"/{part}.zip"] = fault
        retry.click()
        expect(message).to_contain_text(words)
    del server.faults[f"/{part}.zip"]
    retry.click()
    reader.wait_live()
    for figure in reader.page.locator("simulation-figure").all():
        figure.locator("input[type=range]").first.press("ArrowRight")
        reader.settle(figure)  # parts that only later frames import
    assert {*fetched} == {*BUILT_ON} | parts
    reader.errors.clear()  # the browser's own words about the missing file
