"""Fixtures that tests of several folders share."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from playwright.sync_api import Browser, sync_playwright
from support.built import built_once
from support.chromium import HOW_TO, find_chromium, find_headless_shell, launch_arguments
from support.engine import Engine, make_engine
from support.kernels import in_use
from support.places import ROOT
from support.reader import DESK, Reader, visit
from support.static_server import StaticServer, serving

from site_builder.photographs import prepare_photographs
from site_builder.runtime.imports import Table, imports_of, module_files

# The same examples in every run: a change is judged by its own failures. `make test-deep` looks
# for new ones.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.register_profile(
    "deep", max_examples=1000, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")

prepare_photographs(ROOT)  # scenes import them


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """One more than there are cores: tests of the browser often wait for it to paint or to rest."""
    return None if "not browser" in config.option.markexpr else (os.cpu_count() or 1) + 1


def pytest_report_header() -> str:
    """Errors near rounding depend on them."""
    return f"kernels: {in_use()}"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Under continuous integration a test may be tried again; that it had to be is a fault."""
    for report in terminalreporter.stats.get("rerun", ()):
        terminalreporter.write_line(f"FAULT: it passes or fails by chance: {report.nodeid}")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--site", type=Path, help="test this built site instead of building one")


@pytest.fixture(scope="session")
def imports_of_the_book() -> Table:
    """What each module of the simulations imports: four hundred sources, read once."""
    return imports_of(module_files(ROOT / "simulations"))


@pytest.fixture(scope="session")
def built_site(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, worker_id: str
) -> Path:
    """The whole book, built once for all workers by the command that everyone uses."""
    given: Path | None = request.config.getoption("--site")
    if given:
        return given

    def build(out: Path) -> CompletedProcess[str]:
        command = [sys.executable, "-m", "site_builder", "build", "--out", str(out)]
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    return built_once(tmp_path_factory, worker_id, "book", build)


@pytest.fixture(scope="session")
def engine(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Engine:
    """What authors install, for books that are not this one."""
    make = partial(make_engine, ROOT)
    return Engine(built_once(tmp_path_factory, worker_id, "engine", make))


@pytest.fixture(scope="session")
def book(built_site: Path) -> Any:
    """``book.json``: what the tests are driven by, so that new chapters and scenes are covered."""
    return json.loads((built_site / "book.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def site_server(built_site: Path) -> Iterator[StaticServer]:
    with serving(built_site) as server:
        yield server


@pytest.fixture
def server(site_server: StaticServer) -> Iterator[StaticServer]:
    """The served book; after a test, its files are whole again and the host is back."""
    yield site_server
    site_server.gone = False
    site_server.damaged.clear()
    site_server.faults.clear()


@pytest.fixture(scope="session")
def whole_browser() -> Path:
    """Chromium with a window: others do not keep a page that was left."""
    found = find_chromium()
    assert found, HOW_TO
    return found


@pytest.fixture(scope="session")
def launch(whole_browser: Path) -> Iterator[Callable[..., Browser]]:
    """Start a browser with these arguments beside those that it needs."""
    usual = {"executable_path": find_headless_shell() or whole_browser}
    with sync_playwright() as playwright:
        yield lambda *arguments, **options: playwright.chromium.launch(
            args=[*launch_arguments(), *arguments], **{**usual, **options}
        )


@pytest.fixture(scope="session")
def chromium(launch: Callable[..., Browser]) -> Iterator[Browser]:
    with launch() as browser:
        yield browser


@pytest.fixture(scope="session")
def brisk_chromium(launch: Callable[..., Browser]) -> Iterator[Browser]:
    """It starts the interpreter with a third less work and is slower afterwards: WebAssembly is
    compiled once, and not again to run faster."""
    with launch("--js-flags=--liftoff-only") as browser:
        yield browser


@pytest.fixture
def reader(brisk_chromium: Browser, server: StaticServer) -> Iterator[Reader]:
    """A reader with a fresh browser profile. Complaints of the browser fail the test."""
    with visit(brisk_chromium, server) as someone:
        yield someone
    someone.assert_no_complaints()


@pytest.fixture(scope="session")
def long_visit(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(chromium, site_server) as someone:
        yield someone


@pytest.fixture
def visitor(long_visit: Reader) -> Iterator[Reader]:
    """A reader in the middle of a visit: the interpreter runs, and the page has no figure.

    For tests that change no more than the page, the storage and the size of the window.
    """
    long_visit.page.set_viewport_size(DESK)
    long_visit.turn_to("lecture-plan/", live=False)  # the lightest page
    long_visit.forget()
    yield long_visit
    long_visit.assert_no_complaints()


@pytest.fixture
def guest(long_visit: Reader) -> Iterator[Reader]:
    """The same reader, on the page of the test before: for `Reader.stay_at_figure`."""
    long_visit.page.set_viewport_size(DESK)
    yield long_visit
    long_visit.assert_no_complaints()


@pytest.fixture(scope="session")
def plain_visit(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(chromium, site_server, "delete globalThis.WebAssembly") as someone:
        yield someone


@pytest.fixture
def plain_reader(plain_visit: Reader) -> Iterator[Reader]:
    """A reader whose browser cannot run Python: pages open at once, all else must work.

    It is one browser for all tests, since a fresh profile costs more than most of them: it
    forgets before each, and loads its pages anew.
    """
    plain_visit.begin_anew()
    yield plain_visit
    plain_visit.assert_no_complaints()
