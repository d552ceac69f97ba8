"""Faulty files: in every engine readers get a message and a way to continue, and lose nothing."""

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from playwright.sync_api import Error as PlaywrightError
from support.engines import window
from support.engines.engine import Window
from support.limits import limit_s
from support.reader import Reader, visit
from support.static_server import FAULTS, Fault, StaticServer, serving

pytestmark = pytest.mark.browser

CHAPTER, SCENE = "lens-distortion/", "lens-distortion"
NOT_STORED = {"/sw.js": Fault(status=404)}
"""Without the service worker every file is fetched from the host."""
WITHOUT_SNAPSHOT = {"/snapshot.wasm": Fault(status=404)}
"""Python starts without a snapshot, and needs all other files."""
OTHER_RELEASE = Fault(lambda table: table.replace(b'"sha256-', b'"sha256-A'))
KINDS = {**FAULTS, "type": Fault(media_type="text/plain"), "other release": OTHER_RELEASE}
MESSAGES = {
    "missing": "could not be loaded: the server answered 404",
    "cut": "did not load",
    "login": "a web page came",
    "login as file": "a web page came",
    "type": "the server sends",
    "other release": "damaged or does not belong",
}
"""Messages of a figure by kind of fault; other faults are `DAMAGED`."""
DAMAGED = "arrived damaged"


@dataclass(frozen=True, slots=True)
class Outcome:
    """Functions in the page: the message of a fault, and recovery once the host works again."""

    shown: str
    """Returns the message about the fault, once it is shown."""
    way_on: str
    """Presses the button or link beside the message."""
    whole: str
    """Whether the page works as without the fault."""


LIVES = f"""document.querySelector('#figure-{SCENE} simulation-figure')?.dataset.state === 'live'
  && !document.querySelector('#figure-{SCENE} .figure-status')?.checkVisibility()"""
RELOADED = """performance.getEntriesByType('navigation')[0].type === 'reload'
  && Boolean(document.querySelector('.progress-count')?.textContent)"""
IN_FIGURE = Outcome(
    "() => document.querySelector('[data-state=failed] .figure-message')?.textContent",
    "() => document.querySelector('[data-state=failed] .retry').click()",
    f"() => {LIVES}",
)
ON_PAGE = Outcome(
    """() => {
      const line = document.querySelector('.scripts-notice');
      const isWithout = !document.querySelector('.control-grid').checkVisibility();
      return line.checkVisibility() && isWithout && line.textContent;
    }""",
    "() => document.querySelector('.scripts-notice a').click()",
    """() => !document.querySelector('.scripts-notice').checkVisibility()
      && Boolean(document.querySelector('.progress-count')?.textContent)""",
)
AT_FOOT = Outcome(
    """() => {
      const is_there = document.querySelector('.progress-count').textContent;
      if (is_there && !window.pressed) document.querySelector('[data-progress-export]').click();
      window.pressed = is_there;
      return document.querySelector('.notice')?.textContent.includes('did not load');
    }""",
    "() => [...document.querySelectorAll('.notice button')][0].click()",
    f"() => {RELOADED}",
)
WHEN_MOVED = Outcome(
    f"""() => {{
      const slider = document.querySelector('#figure-{SCENE} input[type=range]');
      if ({LIVES} && slider.valueAsNumber === Number(slider.defaultValue)) {{
        slider.stepUp();
        slider.dispatchEvent(new Event('input', {{bubbles: true}}));
      }}
      return document.querySelector('[data-state=failed] .figure-message')?.textContent;
    }}""",
    IN_FIGURE.way_on,
    IN_FIGURE.whole,
)
"""The snapshot contains the file's modules, until a frame is computed."""
NOWHERE = Outcome(
    f"() => {LIVES}", "() => { sessionStorage.clear(); location.reload(); }", f"() => {LIVES}"
)
"""Python starts without the snapshot."""
NOT_STORED_NOTICE = "() => document.querySelector('.notice')?.textContent.includes('sw.js')"
"""Shown once in a visit; Chromium's contexts block service workers."""
TRIED: Mapping[str, tuple[Outcome, tuple[str, ...]]] = {
    "numpy.zip": (IN_FIGURE, ("missing", "cut", "half", "changed", "login", "login as file")),
    "pyodide.mjs": (IN_FIGURE, ("missing", "cut", "half", "changed", "login", "type")),
    "pyodide.asm.mjs": (IN_FIGURE, ("changed", "type")),
    "pyodide.asm.wasm": (IN_FIGURE, ("half", "login as file")),
    "numpy.linalg._umath_linalg.wasm": (IN_FIGURE, ("missing", "half")),
    "python.zip": (IN_FIGURE, ("missing", "changed")),
    "core.zip": (IN_FIGURE, ("changed", "login")),
    "runtime.json": (IN_FIGURE, ("half", "login as file", "other release")),
    "worker.js": (IN_FIGURE, ("missing", "login", "type")),
    "snapshot.wasm": (NOWHERE, (*FAULTS,)),
    "later python.zip": (WHEN_MOVED, ("missing",)),
    "later numpy.zip": (WHEN_MOVED, ("missing",)),
    "later core.zip": (WHEN_MOVED, ("missing",)),
    "main.js": (ON_PAGE, ("missing", "cut", "half", "login", "login as file")),
    "chunk": (ON_PAGE, ("missing", "half")),
    "progress_file": (AT_FOOT, ("missing", "cut", "half", "login")),
}
"""The outcome of each fault of each file; the last two files have hashes in their names."""
SAMPLE = {
    "Chromium": (
        ("pyodide.asm.wasm", "half"),
        ("runtime.json", "login as file"),
        ("worker.js", "missing"),
        ("later python.zip", "missing"),
        ("chunk", "half"),
        ("progress_file", "half"),
    ),
    "Firefox": (("numpy.zip", "login"), ("main.js", "missing")),
    "WebKitGTK": (),
}
"""The faults that `make test` tries."""


def cases() -> list[Any]:
    return [
        pytest.param(browser, name, kind, marks=[] if (name, kind) in sample else pytest.mark.deep)
        for browser, sample in SAMPLE.items()
        for name, (_, kinds) in TRIED.items()
        for kind in kinds
    ]


@pytest.fixture(scope="module")
def tab(
    request: pytest.FixtureRequest,
    baseline_chromium: Browser,
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[Window]:
    with window(request.param, baseline_chromium, tmp_path_factory.mktemp("profile")) as opened:
        yield opened


def until(tab: Window, expression: str) -> Any:
    """The first true result of a function in the page, across reloads."""
    end = monotonic() + 2 * limit_s()
    while monotonic() < end:
        with suppress(RuntimeError, PlaywrightError):  # the page is just left
            if answer := tab.evaluate(expression):
                return answer
        sleep(0.05)
    raise TimeoutError(expression)


@pytest.mark.parametrize(("tab", "name", "kind"), cases(), indirect=["tab"])
def test_fault_of_a_file_is_reported_and_overcome_by_the_next_try(
    tab: Window,
    uncached: StaticServer,
    built_site: Path,
    request: pytest.FixtureRequest,
    name: str,
    kind: str,
) -> None:
    browser = request.node.callspec.params["tab"]
    outcome, _ = TRIED[name]
    if browser == "WebKitGTK" and ((name, kind) == ("worker.js", "type") or outcome is WHEN_MOVED):
        pytest.skip("WebKitGTK has no event for it, and no snapshot")
    file = name.removeprefix("later ")
    if name == "chunk":
        (main,) = built_site.glob("assets/*/js/main.js")
        file = re.findall(r"chunk-\w+\.js", main.read_text(encoding="utf-8"))[0]
    elif name == "progress_file":
        file = next(built_site.glob("assets/*/js/progress_file-*.js")).name
    late = {NOWHERE: {"/core.zip": Fault(delay_s=2)}, WHEN_MOVED: {}}
    others = {**NOT_STORED, **late.get(outcome, WITHOUT_SNAPSHOT)}
    uncached.faults = {f"/{file}": KINDS[kind], **others}
    tab.open("about:blank")
    tab.open(uncached.url + CHAPTER)
    shown = until(tab, outcome.shown)
    if outcome in (IN_FIGURE, WHEN_MOVED):
        assert shown.startswith("Python did not start") or outcome is WHEN_MOVED
        assert file in shown
        # Where the connection breaks off, Firefox takes what came for the whole.
        is_cut = (browser, kind) == ("Firefox", "cut")
        assert MESSAGES.get(kind, DAMAGED) in shown or (is_cut and DAMAGED in shown), shown
    uncached.faults = {**NOT_STORED}
    until(tab, f"() => {{ ({outcome.way_on})(); return true; }}")
    until(tab, outcome.whole)
    if outcome is NOWHERE and browser != "Chromium":
        until(tab, NOT_STORED_NOTICE)


@pytest.fixture(scope="module")
def patient(baseline_chromium: Browser, uncached: StaticServer) -> Iterator[Reader]:
    """A reader who stays on one page and retries; the browser logs an error for each file."""
    with visit(baseline_chromium, uncached) as reader:
        yield reader


def next_try(reader: Reader) -> str:
    """The figure's message after the next try, or after the page was opened where none failed."""
    figure = reader.figure(SCENE)
    retry = figure.locator(".retry")
    if retry.is_visible():
        retry.click()
    else:
        reader.open(CHAPTER, live=False)
    retry.wait_for()
    return figure.locator(".figure-message").inner_text()


def test_outdated_page_offers_a_reload_and_python_starts_after_an_outage(
    patient: Reader, uncached: StaticServer
) -> None:
    """Settings are kept, even where files arrive late and with wrong media types."""
    page, figure = patient.page, patient.figure(SCENE)
    slider = figure.locator("input[type=range]").first
    uncached.faults = {**WITHOUT_SNAPSHOT, "/numpy.zip": Fault(status=404)}
    next_try(patient)
    uncached.faults |= {
        "/lens-distortion/": Fault(
            lambda page: page.replace(b"/runtime/", b"/runtime/next-"), media_type="text/html"
        )
    }
    next_try(patient)
    slider.press("ArrowRight")
    moved = slider.input_value()
    notice = page.locator(".notice")
    assert "has been updated" in notice.inner_text()
    page.wait_for_function("location.search !== ''")
    del uncached.faults["/lens-distortion/"]
    notice.get_by_role("button", name="Reload the page").click()
    figure.locator(".retry").wait_for()
    assert slider.input_value() == moved

    uncached.offline = True
    assert "did not load" in next_try(patient)
    slider.press("ArrowRight")
    moved = slider.input_value()
    uncached.offline = False
    uncached.faults = {
        **WITHOUT_SNAPSHOT,
        "/numpy.zip": Fault(delay_s=2),
        **{f"/{name}": Fault(media_type="text/plain") for name in ("python.zip", "runtime.json")},
        "/pyodide.asm.wasm": Fault(media_type="application/octet-stream"),
    }
    page.context.set_offline(True)
    page.context.set_offline(False)
    patient.wait_live()
    assert slider.input_value() == moved
    assert not page.locator(".figure-status:visible").count()


def test_pages_without_webassembly_or_scripts_have_no_dead_controls(
    plain_reader: Reader,
    chromium: Browser,
    server: StaticServer,
    built_site: Path,
    book: Any,
    tmp_path: Path,
) -> None:
    plain_reader.open(CHAPTER, live=False)
    figure = plain_reader.figure(SCENE)
    expect(figure.locator(".figure-message")).to_contain_text("WebAssembly")
    assert not figure.locator(".control-grid >> nth=0").is_visible()
    assert figure.locator("svg.overlay").first.is_visible()
    plain_reader.page.goto((built_site / CHAPTER / "index.html").as_uri())
    expect(plain_reader.page.locator(".scripts-notice:visible")).to_contain_text("http.server")
    sandboxed = f'<iframe sandbox="allow-scripts" src="{server.url + CHAPTER}">'
    (tmp_path / "index.html").write_text(sandboxed, encoding="utf-8")
    with serving(tmp_path) as other:
        plain_reader.page.goto(other.url)
        notice = plain_reader.page.frame_locator("iframe").locator(".scripts-notice:visible")
        expect(notice).to_contain_text("allow-same-origin")
    plain_reader.errors.clear()  # the browser's own, of scripts in files and sandboxes
    with chromium.new_context(java_script_enabled=False) as context:
        page = context.new_page()
        for chapter in book["chapters"][::4]:
            page.goto(server.url + chapter["url"])
            paragraphs, drawings, offered, kept_back = page.evaluate(WHOLE)
            assert paragraphs > 3, chapter["id"]
            assert drawings >= len(chapter["simulations"])
            assert (offered, kept_back) == (0, 0), chapter["id"]
            assert page.locator("#contents ol a").first.is_visible()


WHOLE = """() => {
  const count = (what, wanted) => [...document.querySelectorAll(what)]
    .filter((one) => one.checkVisibility() === wanted).length;
  return [
    document.querySelectorAll('article.chapter p').length,
    document.querySelectorAll('simulation-figure svg.overlay').length,
    count('.control-grid, .site-header button, dialog', true),
    count(':is(form.quiz details, .answer-body):not(.scripted *, .deeper:not([open]) *)', false),
  ];
}"""
