"""What is done before anyone asks: Python starts in the head, the page's frames are taken for live
ones, pages that are pointed at are fetched, and the next chapter's scenes imported."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Route
from support.reader import START_MS, Reader, visit
from support.static_server import Fault, StaticServer

pytestmark = pytest.mark.browser

WATCH = """window.told = [];
const tell = (...what) => window.told.push(what.join(' '));
globalThis.Worker = class extends Worker {
  constructor(...given) {
    super(...given);
    tell('worker', document.body ? 'late' : 'in the head');
  }
  postMessage(message, ...given) {
    const figure = document.querySelector(`[data-simulation="${message.scene}"]`);
    tell(message.call, message.scene ?? '', figure?.dataset.state ?? '');
    super.postMessage(message, ...given);
  }
};"""
"""Note when workers begin and what they are asked, with the state of that figure, in order."""


OFFER = """(address) => {
  document.getElementById('offered')?.remove();
  const link = Object.assign(document.createElement('a'), {href: address, id: 'offered'});
  link.textContent = 'A link';
  document.getElementById('main').prepend(link);
}"""


@pytest.fixture(scope="module")
def chapters(book: Any) -> list[Any]:
    """One with one figure, the next, which has some too, and one that is far from them."""
    few = [len(chapter["simulations"]) for chapter in book["chapters"]]
    first = next(at for at in range(len(few)) if few[at] == 1 and few[at + 1])
    far = next(at for at in range(first + 3, len(few)) if few[at])
    return [book["chapters"][at] for at in (first, first + 1, far)]


@pytest.fixture(scope="module")
def reader(brisk_chromium: Browser, site_server: StaticServer) -> Iterator[Reader]:
    with visit(brisk_chromium, site_server, WATCH) as someone:
        yield someone


@pytest.fixture(scope="module")
def frames(reader: Reader, chapters: list[Any]) -> list[Any]:
    """What the first chapter's figure shows before Python has started, and once it lives."""
    held: list[Route] = []
    reader.page.context.route("**/runtime.json", lambda route: held.append(route))
    reader.open(chapters[0]["url"], live=False)
    figure = reader.figure(chapters[0]["simulations"][0])
    before = reader.shown(figure)
    for route in held:
        route.continue_()
    reader.wait_live()
    return [before, reader.shown(figure)]


def told(reader: Reader) -> list[str]:
    return [str(what).strip() for what in reader.page.evaluate("window.told")]


@pytest.mark.usefixtures("frames")
def test_python_begins_in_the_head_of_the_page_and_is_the_one_that_figures_ask(
    reader: Reader,
) -> None:
    begun = told(reader)
    assert begun[:2] == ["worker in the head", "start"]
    assert [what for what in begun if what.startswith("worker")] == ["worker in the head"]
    assert len(reader.page.workers) == 1


def test_a_figure_that_nobody_touched_lives_with_the_frame_of_its_page(
    reader: Reader, frames: list[Any], chapters: list[Any]
) -> None:
    (scene,) = chapters[0]["simulations"]
    before, after = frames
    assert before == after
    asked = told(reader)
    assert f"prepare {scene} starting" in asked
    assert f"render {scene} starting" not in asked


@pytest.mark.usefixtures("frames")
def test_the_next_chapter_s_scenes_are_imported_while_the_hand_rests(
    reader: Reader, chapters: list[Any]
) -> None:
    reader.page.wait_for_function(
        "scene => window.told.some((what) => what.startsWith(`prepare ${scene}`))",
        arg=chapters[1]["simulations"][0],
        timeout=START_MS,
    )


@pytest.mark.usefixtures("frames")
def test_a_page_drawn_by_other_sources_than_python_has_is_drawn_anew(
    reader: Reader, site_server: StaticServer, chapters: list[Any]
) -> None:
    """It stands after the others, whose page it leaves."""
    address, scene = chapters[2]["url"], chapters[2]["simulations"][0]
    other = re.compile(rb'data-sources="[^"]*"')
    site_server.faults[f"/{address}"] = Fault(
        lambda page: other.sub(b'data-sources="sha256-other"', page), media_type="text/html"
    )
    reader.page.evaluate("window.told = []")
    try:
        reader.turn_to(address)
    finally:
        site_server.faults.clear()
    assert f"render {scene} starting" in told(reader)


@pytest.mark.parametrize("hint", ["hover", "focus"])
def test_a_page_that_is_pointed_at_is_fetched_once_and_is_there_when_its_link_is_followed(
    plain_reader: Reader, chapters: list[Any], hint: str
) -> None:
    plain_reader.open(chapters[0]["url"], live=False)
    fetched = plain_reader.note_requests()
    wanted = plain_reader.root + chapters[1]["url"]
    link = plain_reader.page.locator(".pager a[rel=next]")
    with plain_reader.page.expect_response(wanted):
        link.hover() if hint == "hover" else link.focus()
    link.click()
    plain_reader.page.wait_for_function(
        "url => location.href === url && document.activeElement?.id === 'main'", arg=wanted
    )
    assert fetched.count(wanted) == 1


def test_of_links_that_lead_out_of_the_book_or_stay_on_the_page_nothing_is_fetched(
    plain_reader: Reader, chapters: list[Any]
) -> None:
    plain_reader.open(chapters[0]["url"], live=False)
    page = plain_reader.page
    fetched = plain_reader.note_requests()
    for address in ("https://elsewhere.example/", "#main", "../book.json", "mailto:a@b.example"):
        page.evaluate(OFFER, address)
        page.locator("#offered").hover()
    page.locator(".pager a[rel=next]").hover()
    page.wait_for_timeout(100)
    pages = [url for url in fetched if not url.startswith(f"{plain_reader.root}assets/")]
    assert pages == [plain_reader.root + chapters[1]["url"]], "but of one that leads on"
