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
from support.chromium import HOW_TO, find_chromium, find_headless_shell, launch_arguments
from support.engine import Engine, built_once, make_engine
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
    """One more than the number of cores, since browser tests often wait for the browser."""
    return None if "not browser" in config.option.markexpr else (os.cpu_count() or 1) + 1


def pytest_report_header() -> str:
    """The kernels in use, on which errors near rounding depend."""
    return f"kernels: {in_use()}"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Report each test that passed only when it was run again, which CI allows."""
    for report in terminalreporter.stats.get("rerun", ()):
        terminalreporter.write_line(f"FAULT: it passes or fails by chance: {report.nodeid}")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--site", type=Path, help="test this built site instead of building one")


@pytest.fixture(scope="session")
def imports_of_the_book() -> Table:
    """The imports of each module of ``simulations``, read once from four hundred sources."""
    return imports_of(module_files(ROOT / "simulations"))


@pytest.fixture(scope="session")
def built_site(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, worker_id: str
) -> Path:
    """The whole book, built once for all workers by the usual command."""
    given: Path | None = request.config.getoption("--site")
    if given:
        return given

    def build(out: Path) -> CompletedProcess[str]:
        command = [sys.executable, "-m", "site_builder", "build", "--out", str(out)]
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)

    return built_once(tmp_path_factory, worker_id, "book", build)


@pytest.fixture(scope="session")
def engine(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Engine:
    """The engine as authors install it, for other books."""
    make = partial(make_engine, ROOT)
    return Engine(built_once(tmp_path_factory, worker_id, "engine", make))


@pytest.fixture(scope="session")
def book(built_site: Path) -> Any:
    """``book.json``, from which tests take chapters and scenes, so that new ones are covered."""
    return json.loads((built_site / "book.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def site_server(built_site: Path) -> Iterator[StaticServer]:
    with serving(built_site) as server:
        yield server


@pytest.fixture
def server(site_server: StaticServer) -> Iterator[StaticServer]:
    """The served book; the faults that a test sets end with the test."""
    yield site_server
    site_server.offline = False
    site_server.damaged.clear()
    site_server.faults.clear()


@pytest.fixture(scope="session")
def full_chromium() -> Path:
    """Chromium with a window; without one it has no back/forward cache."""
    found = find_chromium()
    assert found, HOW_TO
    return found


@pytest.fixture(scope="session")
def launch(full_chromium: Path) -> Iterator[Callable[..., Browser]]:
    """Start a browser with these arguments beside those that it needs."""
    usual = {"executable_path": find_headless_shell() or full_chromium}
    with sync_playwright() as playwright:
        yield lambda *arguments, **options: playwright.chromium.launch(
            args=[*launch_arguments(), *arguments], **{**usual, **options}
        )


@pytest.fixture(scope="session")
def chromium(launch: Callable[..., Browser]) -> Iterator[Browser]:
    with launch() as browser:
        yield browser


@pytest.fixture(scope="session")
def baseline_chromium(launch: Callable[..., Browser]) -> Iterator[Browser]:
    """Chromium that compiles WebAssembly without optimisation: the interpreter starts with a third
    less work and runs more slowly afterwards."""
    with launch("--js-flags=--liftoff-only") as browser:
        yield browser


@pytest.fixture
def reader(baseline_chromium: Browser, server: StaticServer) -> Iterator[Reader]:
    """A reader with a fresh browser profile; errors in the browser fail the test."""
    with visit(baseline_chromium, server) as reader:
        yield reader
    reader.assert_no_errors()


@pytest.fixture(scope="session")
def long_visit(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(chromium, site_server) as reader:
        yield reader


@pytest.fixture
def visitor(long_visit: Reader) -> Iterator[Reader]:
    """A reader on a page without a figure, with the interpreter running.

    For tests that change only the page, the storage and the size of the window.
    """
    long_visit.page.set_viewport_size(DESK)
    long_visit.turn_to("lecture-plan/", live=False)  # the smallest page
    long_visit.clear_storage()
    yield long_visit
    long_visit.assert_no_errors()


@pytest.fixture
def guest(long_visit: Reader) -> Iterator[Reader]:
    """The same reader, still on the page of the previous test: for `Reader.figure_at_rest`."""
    long_visit.page.set_viewport_size(DESK)
    yield long_visit
    long_visit.assert_no_errors()


@pytest.fixture(scope="session")
def plain_visit(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(chromium, site_server, "delete globalThis.WebAssembly") as reader:
        yield reader


@pytest.fixture
def plain_reader(plain_visit: Reader) -> Iterator[Reader]:
    """A reader whose browser cannot run Python; everything else must work.

    All tests share one browser profile, since a fresh one takes longer than most tests; it is reset
    before each.
    """
    plain_visit.reset()
    yield plain_visit
    plain_visit.assert_no_errors()
