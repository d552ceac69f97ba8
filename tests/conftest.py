"""Fixtures that tests of several folders share."""

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock
from hypothesis import settings
from playwright.sync_api import Browser, sync_playwright
from support.chromium import HOW_TO, find_chromium, launch_arguments
from support.reader import Reader
from support.static_server import StaticServer, serving

ROOT = Path(__file__).resolve().parents[1]

# The same examples in every run: a change is judged by its own failures. To look for new ones,
# run `pytest --hypothesis-profile=default`.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What needs the site goes first: one worker builds it while the others test the rest."""
    items.sort(key=lambda item: item.get_closest_marker("browser") is None)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--site", type=Path, help="test this built site instead of building one")


@pytest.fixture(scope="session")
def built_site(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, worker_id: str
) -> Path:
    """The whole book, built once for all workers by the command that everyone uses."""
    given: Path | None = request.config.getoption("--site")
    if given:
        return given
    own = tmp_path_factory.getbasetemp()
    out = (own if worker_id == "master" else own.parent) / "book" / "site"
    with FileLock(f"{out.parent}.lock"):
        if not out.exists():
            command = [sys.executable, "-m", "site_builder", "build", "--out", str(out)]
            build = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
            assert build.returncode == 0, build.stderr
    return out


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
    """The served book; what a test damages is whole again after it."""
    yield site_server
    site_server.damaged.clear()


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    executable = find_chromium()
    assert executable, HOW_TO
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=launch_arguments())
        yield browser
        browser.close()


@pytest.fixture
def reader(chromium: Browser, server: StaticServer) -> Iterator[Reader]:
    """A reader with a fresh browser profile. Complaints of the browser fail the test."""
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    someone = Reader(context, server.url)
    yield someone
    context.close()
    assert not someone.complaints, "\n".join(someone.complaints)


@pytest.fixture(scope="session")
def long_visit(chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    yield Reader(context, site_server.url)
    context.close()


@pytest.fixture
def visitor(long_visit: Reader) -> Iterator[Reader]:
    """A reader who has been here for a while: the interpreter runs, and the page has no figure.

    For tests that leave nothing behind but what goes when the page is turned.
    """
    long_visit.turn_to("licences/", live=False)
    yield long_visit
    complaints = [*long_visit.complaints]
    long_visit.complaints.clear()
    assert not complaints, "\n".join(complaints)


@pytest.fixture
def plain_reader(reader: Reader) -> Reader:
    """A reader whose browser cannot run Python: pages open at once, all else must work."""
    reader.page.add_init_script("delete globalThis.WebAssembly")
    return reader
