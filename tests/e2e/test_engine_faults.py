"""Files that do not arrive, or arrive wrong, in the engines that the other tests do not use."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.engines import ENGINES, HOW_TO
from support.engines.engine import Engine, wait_for
from support.page_scripts import LIVE
from support.runtime_faults import KINDS, SAID, TRIED, WITHOUT_SNAPSHOT
from support.static_server import FAULTS, Fault, StaticServer, serving

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
NOT_STORED = {"/sw.js": Fault(status=404)}
"""So that every file is asked of the host."""
SAMPLE = [("numpy.zip", "login")]
DAMAGED = "arrived damaged"
"""Of half a file, too: Firefox takes it for the whole where the connection breaks off."""


@pytest.fixture(scope="module")
def host(built_site: Path) -> Iterator[StaticServer]:
    with serving(built_site) as server:
        server.uncached = True
        yield server


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(name, marks=[] if name == "Firefox" else pytest.mark.deep) for name in ENGINES
    ],
)
def engine(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Engine]:
    opened = ENGINES[request.param](tmp_path_factory.mktemp("profile"))
    if opened is None:
        pytest.skip(f"{request.param}: {HOW_TO}")
    with opened as window:
        yield window


def script(site: Path, name: str) -> str:
    """The end of the address of a script."""
    (found,) = site.glob(f"assets/*/js/{name}*.js")
    return f"/{found.name}"


@pytest.mark.parametrize(
    "kind",
    [
        "missing",
        *(pytest.param(kind, marks=pytest.mark.deep) for kind in ("cut", "half", "login as file")),
    ],
)
def test_a_page_whose_script_does_not_arrive_says_so(
    engine: Engine, host: StaticServer, kind: str
) -> None:
    host.faults = {**NOT_STORED, "/js/main.js": FAULTS[kind]}
    engine.open(host.url + CHAPTER)
    wait_for(engine, "() => document.querySelector('.scripts-notice').checkVisibility()")


@pytest.mark.deep
@pytest.mark.parametrize("kind", ["missing", "half"])
def test_a_script_that_is_requested_late_in_vain_is_told(
    engine: Engine, host: StaticServer, built_site: Path, kind: str
) -> None:
    host.faults = {**NOT_STORED, script(built_site, "progress_file-"): FAULTS[kind]}
    engine.open(host.url + CHAPTER)
    wait_for(engine, f"() => {LIVE}")
    engine.ask("() => document.querySelector('[data-progress-export]').click()")
    wait_for(engine, f"({SAYS})", "part of the page did not load")


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        pytest.param(name, kind, marks=[] if (name, kind) in SAMPLE else pytest.mark.deep)
        for name, kinds in TRIED.items()
        for kind in kinds
        if (name, kind) != ("worker.js", "type")  # not told in WebKitGTK
    ],
)
def test_what_is_wrong_with_a_file_of_the_runtime_is_told(
    engine: Engine, host: StaticServer, name: str, kind: str
) -> None:
    host.faults = {**NOT_STORED, **WITHOUT_SNAPSHOT, f"/{name}": KINDS[kind]}
    engine.open(host.url + CHAPTER)
    wait_for(engine, FAILED)
    message = engine.ask(MESSAGE)
    assert name in message
    said = {SAID.get(kind, DAMAGED), *([DAMAGED] if kind == "cut" else [])}
    assert any(words in message for words in said), message


def test_figures_live_without_a_snapshot_and_why_the_book_is_not_stored_is_said(
    engine: Engine, host: StaticServer
) -> None:
    host.faults = {**NOT_STORED, "/snapshot.wasm": FAULTS["changed"], "/core.zip": Fault(late_s=2)}
    engine.open(host.url + "licences/")
    engine.ask("() => sessionStorage.clear()")  # it is said once in a visit
    engine.open(host.url + CHAPTER)
    wait_for(engine, f"() => {LIVE}")
    wait_for(engine, SAYS, "sw.js")


SAYS = "(part) => document.querySelector('.notice')?.textContent.includes(part)"
FAILED = "() => document.querySelector('simulation-figure').dataset.state === 'failed'"
MESSAGE = "() => document.querySelector('simulation-figure .figure-message').textContent"
