"""What the browser fetches where Python starts without a snapshot: what the page's scenes import,
and the rest on demand. Starts from a snapshot are in ``test_snapshot``."""

import json
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from support.page_scripts import FRUGAL
from support.reader import START_MS, Reader, visit
from support.static_server import Fault, StaticServer

from simulations.registry import LADDER_MODULES, load_ladder

pytestmark = pytest.mark.browser

SNAPSHOT = "snapshot.wasm"
OWN_TABLE = re.compile(rb' data-table="[^"]*"')
"""The hash by which a page knows the table."""
AT_ONCE = {"python", "numpy", "core"}
CALL = """async ([name, payload]) => {
  const {sharedRuntime} = (await customElements.whenDefined('simulation-figure')).inside;
  return sharedRuntime().call(name, payload);
}"""


@pytest.fixture(scope="module")
def table(built_site: Path) -> Any:
    """``runtime.json`` without the snapshot."""
    (file,) = built_site.glob("runtime/*/runtime.json")
    read = json.loads(file.read_text(encoding="utf-8"))
    return {**read, "integrity": {k: v for k, v in read["integrity"].items() if k != SNAPSHOT}}


@pytest.fixture(autouse=True)
def plainly(server: StaticServer, table: Any) -> None:
    """Serve that table, and pages without its hash."""
    server.damaged["/runtime.json"] = json.dumps(table).encode()
    server.faults["/"] = Fault(lambda page: OWN_TABLE.sub(b"", page), media_type="text/html")


@pytest.fixture
def fetched(reader: Reader) -> list[str]:
    reader.page.add_init_script(FRUGAL)
    return reader.note_parts()


def a_chapter(book: Any, table: Any, wanted: Callable[[set[str]], bool]) -> tuple[str, set[str]]:
    """Address of a chapter, and the parts its scenes import: those of libraries as ``wanted``."""
    for chapter in book["chapters"]:
        parts = {part for scene in chapter["simulations"] for part in table["scenes"][scene]}
        if chapter["simulations"] and wanted(of_libraries(parts)):
            return chapter["url"], parts
    raise AssertionError("no such chapter")


def of_libraries(parts: Iterable[str]) -> set[str]:
    """Those that hold nothing of ours."""
    return {part for part in parts if not part.startswith(("scene-", "ladder-"))}


@pytest.mark.parametrize(
    "ladders", [("shading",), pytest.param((*LADDER_MODULES,), marks=pytest.mark.deep)]
)
def test_a_page_whose_scenes_need_no_more_fetches_no_more_until_ladders_ask_for_theirs(
    chromium: Browser, server: StaticServer, book: Any, table: Any, ladders: tuple[str, ...]
) -> None:
    address, parts = a_chapter(book, table, lambda parts: not parts)
    with visit(chromium, server, FRUGAL) as reader:
        fetched = reader.note_parts()
        reader.open(address)
        assert sorted(fetched) == sorted(AT_ONCE | parts)
        named = set()
        for ladder in ladders:
            payload = {"ladder": ladder, "tier": load_ladder(ladder).default_tier, "budget": 0.001}
            reply = reader.page.evaluate(CALL, ["measure", payload])
            assert json.loads(reply["result"])["errors"], ladder
            named.update(table["ladders"][ladder])
    assert AT_ONCE | named <= set(fetched)
    assert len(set(fetched)) == len(fetched), "nothing twice"
    assert "python-rest" not in fetched
    reader.assert_no_complaints()


def test_a_page_fetches_what_its_scenes_import_and_a_later_page_what_is_still_missing(
    reader: Reader, book: Any, table: Any, fetched: list[str]
) -> None:
    asked = reader.note_requests()
    first, few = a_chapter(book, table, lambda parts: len(parts) == 1)
    second, many = a_chapter(book, table, lambda parts: parts > of_libraries(few))
    reader.open(first)
    assert sorted(fetched) == sorted(AT_ONCE | few)
    reader.turn_to(second)
    assert sorted(fetched) == sorted(AT_ONCE | few | many), "each of them once"
    assert not [url for url in asked if "editor" in url or "/python/" in url], "not opened yet"


def test_a_part_that_python_asks_for_in_vain_is_named_and_asked_for_again_at_the_next_try(
    reader: Reader, server: StaticServer, book: Any, table: Any, fetched: list[str]
) -> None:
    """The table lists none: each is fetched when Python asks for it."""
    address, parts = a_chapter(book, table, bool)
    part = max(of_libraries(parts))
    foresee_nothing(server, table)
    server.faults[f"/{part}.zip"] = Fault(status=404)
    reader.open(address, live=False)
    figure = reader.page.locator("simulation-figure").first
    retry, message = figure.locator(".retry"), figure.locator(".figure-message")
    figure.locator("input[type=range]").first.press("ArrowRight")  # the page's own needs no part
    retry.wait_for(timeout=START_MS)
    assert f"{part}.zip could not be loaded: the server answered 404" in message.inner_text()
    server.faults[f"/{part}.zip"] = Fault(lambda _: b"<title>Sign in</title>")
    retry.click()
    expect(message).to_contain_text(f"a web page came instead of {part}.zip")
    del server.faults[f"/{part}.zip"]
    retry.click()
    reader.wait_live()
    for figure in reader.page.locator("simulation-figure").all():
        figure.locator("input[type=range]").first.press("ArrowRight")
        reader.settle(figure)  # what only frames import comes after the page's own
    assert {*fetched} == AT_ONCE | parts
    reader.complaints.clear()  # the browser's own words about the missing file


def foresee_nothing(server: StaticServer, table: Any) -> None:
    """Serve a table that lists no imports of scenes."""
    foreseen = {scene: [f"scene-{scene}"] for scene in table["scenes"]}
    server.damaged["/runtime.json"] = json.dumps({**table, "scenes": foreseen}).encode()


def test_a_part_that_cannot_be_had_stops_only_the_figures_that_need_it(
    reader: Reader, server: StaticServer, book: Any, table: Any
) -> None:
    address, parts = a_chapter(book, table, bool)
    part = sorted(of_libraries(parts))[0]
    server.damaged[f"/{part}.zip"] = b"not what it should be"
    reader.open(address, live=False)
    in_need = [scene for scene, needed in table["scenes"].items() if part in needed]
    figure = reader.page.locator(
        ", ".join(f'simulation-figure[data-simulation="{scene}"]' for scene in in_need)
    ).first
    figure.locator(".retry").wait_for(state="visible", timeout=60_000)
    message = figure.locator(".figure-message").inner_text()
    assert f"{part}.zip arrived damaged" in message
    server.damaged.clear()
    figure.locator(".retry").click()
    reader.wait_live()
    reader.complaints.clear()  # the browser's own words about the damaged file
