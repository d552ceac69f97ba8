"""Navigation: pages, sections, keys, themes, terms, citations and search."""

import re
import tomllib
from collections.abc import Iterator
from typing import Any, Literal
from urllib.parse import quote

import pytest
from playwright.sync_api import Locator, expect
from support.places import ROOT
from support.reader import PHONE, Reader
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

SCROLL_TO = "top => scrollTo({top, behavior: 'instant'})"
SECTIONS = "lens-distortion/"
"""A chapter with many sections."""


def test_links_lead_to_sections_and_going_back_restores_the_place(
    plain_reader: Reader, book: Any
) -> None:
    page = plain_reader.page
    first, second = (chapter["url"] for chapter in book["chapters"][1:3])
    plain_reader.open(first, live=False)
    link = page.locator("#contents .sections a").last
    target = (link.get_attribute("href") or "").removeprefix("#")
    link.click()
    expect(page.locator(f"#{target}")).to_be_in_viewport()
    page.evaluate(SCROLL_TO, 700)
    page.wait_for_function("history.state?.scroll === Math.round(scrollY)")
    left_at = page.evaluate("scrollY")
    plain_reader.turn_to(second, live=False)
    page.wait_for_function("scrollY === 0")
    page.go_back()
    back = f"{plain_reader.root}{first}#{target}"
    page.wait_for_function("url => location.href === url", arg=back)
    page.wait_for_function("top => Math.abs(scrollY - top) < 3", arg=left_at)

    figure = "figure-lens-distortion"
    plain_reader.open(f"lens-distortion/?{figure}.k1=-0.2#{figure}", live=False)
    page.evaluate("scrollBy(0, 150)")
    page.wait_for_function("history.state?.scroll === Math.round(scrollY)")
    place = page.evaluate("Math.round(scrollY)")
    page.reload()
    page.wait_for_function("place => Math.abs(scrollY - place) < 3", arg=place)

    citation = page.locator("a.citation").first
    key = (citation.get_attribute("href") or "").partition("#")[2]
    place = citation.get_attribute("id")
    citation.click()
    expect(page.locator(f"#{key}")).to_be_in_viewport()
    page.locator(f'#{key} a[href$="lens-distortion/#{place}"]').click()
    expect(page.locator(f"#{place}")).to_be_in_viewport(ratio=1)
    link = page.locator("a.anchor").first
    expect(link).to_have_css("opacity", "0")
    link.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    expect(link).to_have_css("opacity", "1")
    page.keyboard.press("Enter")
    page.wait_for_function("href => location.hash === href", arg=link.get_attribute("href"))


@pytest.mark.parametrize(("system", "pressed"), [("light", "dark"), ("dark", "light")])
def test_first_press_of_the_theme_button_changes_the_theme_for_good(
    plain_reader: Reader, system: Literal["light", "dark"], pressed: str
) -> None:
    page = plain_reader.page
    page.emulate_media(color_scheme=system)
    plain_reader.open(live=False)
    ground = "getComputedStyle(document.body).backgroundColor"
    before = page.evaluate(ground)
    page.locator(".theme-toggle").click()
    assert page.locator("html").get_attribute("data-theme") == pressed
    assert page.evaluate(ground) != before
    plain_reader.open(live=False)
    assert page.locator("html").get_attribute("data-theme") == pressed


def test_header_is_slim_and_hides_while_a_phone_scrolls_down(plain_reader: Reader) -> None:
    page = plain_reader.page
    header = page.locator(".site-header")
    for address in ("", SECTIONS):
        plain_reader.open(address, live=False)
        for width, height in ((1440, 900), (1024, 768), (320, 640)):
            page.set_viewport_size({"width": width, "height": height})
            assert header.evaluate("header => header.offsetHeight") <= 48, width
            assert header.evaluate("header => header.scrollWidth <= header.clientWidth"), width
            expect(header.locator("button[data-search]")).to_be_in_viewport(ratio=1)
    page.set_viewport_size(PHONE)
    for top, away in ((1500, True), (1300, False), (1600, True), (0, False)):
        page.evaluate(SCROLL_TO, top)
        is_away = "(header, away) => header.classList.contains('away') === away"
        plain_reader.wait_for(header, is_away, away)


def test_contents_lead_to_sections_and_close_by_escape(plain_reader: Reader) -> None:
    page = plain_reader.page
    page.set_viewport_size(PHONE)
    plain_reader.open(SECTIONS, live=False)
    button, contents = page.locator(".contents-toggle"), page.locator("#contents")
    button.click()
    last = contents.locator(".sections a").last
    target = (last.get_attribute("href") or "").removeprefix("#")
    last.click()
    expect(page.locator(f"#{target}")).to_be_in_viewport()
    page.set_viewport_size({"width": 800, "height": 800})
    button.press("Enter")
    expect(contents).to_be_visible()
    page.keyboard.press("Escape")
    expect(contents).to_be_hidden()
    expect(button).to_be_focused()


def test_page_shows_its_progress_and_the_section_in_view(plain_reader: Reader) -> None:
    page = plain_reader.page
    page.set_viewport_size({"width": 1280, "height": 900})
    plain_reader.open(SECTIONS, live=False)
    read = "Number(document.querySelector('.site-header').style.getPropertyValue('--read'))"
    page.wait_for_function(f"{read} === 0")
    page.evaluate(SCROLL_TO, page.evaluate("document.querySelector('article').scrollHeight / 2"))
    page.wait_for_function(f"{read} > 0.4 && {read} < 0.7")
    links = page.locator("#contents .sections a")
    for link in (links.nth(2), links.nth(5), links.nth(2)):
        link.click()
        expect(link).to_have_attribute("aria-current", "location")
        assert page.locator("#contents .sections a[aria-current]").count() == 1
    page.evaluate(SCROLL_TO, 1e6)  # past all headings
    expect(links.last).to_have_attribute("aria-current", "location")
    page.wait_for_function(f"{read} === 1")


def test_keys_turn_pages_unless_turned_off_or_typed_in_a_field(visitor: Reader, book: Any) -> None:
    page, chapters, keyboard = visitor.page, book["chapters"], visitor.page.keyboard
    visitor.turn_to(chapters[9]["url"], live=False)
    for key, number in (("]", 10), ("[", 9)):
        keyboard.press(key)
        page.wait_for_url(visitor.root + chapters[number]["url"])
    keyboard.press("?")
    card = page.locator("dialog.keys")
    expect(card).to_be_visible()
    keyboard.press("Escape")
    expect(card).to_be_hidden()
    for turned_off in (True, False):
        page.locator("button[data-keys]").click()
        expect(card).to_be_visible()
        card.get_by_role("checkbox").set_checked(not turned_off)
        keyboard.press("Escape")
        keyboard.press("/")
        expect(page.locator("dialog[open]")).to_have_count(0 if turned_off else 1)
    keyboard.press("Escape")
    numbers = {quiz["chapter"] for quiz in book["quizzes"] if quiz["kind"] == "number"}
    url = next(chapter["url"] for chapter in chapters if chapter["id"] in numbers)
    visitor.turn_to(url, live=False)
    page.locator(".number-answer > input:visible").first.focus()
    for key in ("/", "]", "?"):
        keyboard.press(key)
    assert page.locator("dialog[open]").count() == 0
    assert page.url == visitor.root + url


def test_term_shows_its_definition_and_leads_to_the_glossary(plain_reader: Reader) -> None:
    """On hover, focus and tap; a second tap follows the link."""
    page = plain_reader.page
    plain_reader.open("full-camera-model/", live=False)
    mark = page.locator("#term-circle-of-confusion")
    definition = page.locator("#definition-circle-of-confusion")
    expect(definition).to_be_hidden()
    mark.hover()
    expect(definition).to_be_visible()
    expect(definition).to_be_in_viewport(ratio=1)
    definition.hover()
    page.wait_for_timeout(400)  # longer than it stays after the pointer has left
    expect(definition).to_be_visible()
    page.mouse.move(2, 2)
    expect(definition).to_be_hidden()
    mark.evaluate("mark => mark.focus({ focusVisible: true })")
    expect(definition).to_be_visible()
    page.keyboard.press("Escape")
    expect(definition).to_be_hidden()
    expect(mark).to_be_focused()
    expect(mark).to_have_accessible_description(definition.text_content() or "")
    assert mark.evaluate(TAP) is False, "its default, to follow the link, is prevented"
    expect(definition).to_be_visible()
    mark.evaluate(TAP)
    page.wait_for_url("**/glossary/#circle-of-confusion")
    expect(page.locator("#circle-of-confusion")).to_be_in_viewport()


TAP = """mark => mark.dispatchEvent(new PointerEvent('click',
  {pointerType: 'touch', bubbles: true, cancelable: true}))"""


def test_folds_open_and_the_filter_finds_hard_cases(plain_reader: Reader) -> None:
    """Prerequisites of a chapter, the docstring of a listing, and the table of hard cases."""
    page = plain_reader.page
    plain_reader.open("lens-distortion/", live=False)
    facts = page.locator(".chapter-facts")
    need = facts.locator('.before a[href$="perspective-projection/"]')
    expect(need).to_be_hidden()
    facts.locator("summary").press("Enter")
    expect(need).to_be_visible()
    expect(facts.locator(".after li").first).to_be_visible()

    plain_reader.turn_to("2d-transformations/", live=False)
    listing = page.locator(".source", has_text="apply_homography").first
    docstring = listing.locator(".docstring pre")
    expect(docstring).to_be_hidden()
    expect(listing.locator("> pre").first).to_contain_text("def apply_homography")
    listing.locator("summary").press("Enter")
    expect(docstring).to_contain_text('"""')
    expect(docstring).to_be_visible()

    plain_reader.turn_to("hard-cases/", live=False)
    field = page.get_by_role("combobox", name="Filter the cases")
    rows = page.locator(".extremes tbody tr").locator("visible=true")
    field.fill("undistort(")
    expect(page.locator("#case-functions option[value='undistort(']")).to_have_count(1)
    assert all("undistort(" in text for text in rows.all_inner_texts())
    field.fill("quaternion zero")
    expect(rows).not_to_have_count(0)
    for text in rows.all_inner_texts():
        assert "quaternion" in text.lower()
        assert "zero" in text.lower()
    expect(page.locator(".case-filter [role=status]")).to_contain_text(f"{rows.count()} case")
    tables = page.locator("details.extremes")
    field.fill("no such case")
    expect(tables.locator("visible=true")).to_have_count(0)
    field.fill("")
    expect(tables.locator("visible=true")).to_have_count(tables.count())
    expect(page.locator("details.extremes[open]")).to_have_count(0)


def read_toml(name: str) -> dict[str, Any]:
    return tomllib.loads((ROOT / "content" / f"{name}.toml").read_text(encoding="utf-8"))


def terms() -> Iterator[tuple[str, str]]:
    """Search words and the address of the section that explains them: the listed questions, the
    book's search phrases, and every name of a glossary term."""
    listed = (ROOT / "tests" / "fixtures" / "search_terms.txt").read_text(encoding="utf-8")
    for line in listed.splitlines():
        if line and not line.startswith("#"):
            term, _, address = line.partition(" | ")
            yield term, address
    for section, queries in read_toml("search").items():
        for words in queries:
            yield words, quote(section.replace("#", "/#"), safe="/#")
    for term, entry in read_toml("glossary").items():
        chapter, mark, section = entry["explained"].partition("#")
        for name in (term, *entry.get("also", ())):
            yield name, f"{chapter}/{mark}{section}"


def open_search(reader: Reader) -> Locator:
    """The search dialog, opened by its key."""
    reader.page.keyboard.press("/")
    dialog = reader.page.locator("dialog.search")
    expect(dialog.locator("input[type=search]")).to_be_focused()
    return dialog


def first_hit(reader: Reader, dialog: Locator, words: str) -> str:
    """Address of the best section for ``words``, relative to the book."""
    dialog.locator("input[type=search]").fill(words)
    hits = dialog.locator("a[data-result]")
    hits.first.wait_for()
    address: str = hits.first.evaluate("link => link.href")
    return address.removeprefix(reader.root)


def test_each_term_is_found_first_where_it_is_explained(visitor: Reader) -> None:
    """No further request is made once the index is loaded."""
    dialog = open_search(visitor)
    first_hit(visitor, dialog, "lens")
    requests = visitor.record_requests()
    wanted = dict(terms())
    assert {*read_toml("book")["search_examples"]} <= wanted.keys()
    found = dict(zip(wanted, dialog.evaluate(FIRST_HITS, [*wanted]), strict=True))
    visitor.page.keyboard.press("Escape")
    assert not [address for address in requests if "/search/" in address]
    assert found == {term: visitor.root + where for term, where in wanted.items()}


FIRST_HITS = """async (dialog, terms) => {
  const field = dialog.querySelector('input[type=search]');
  const found = [];
  for (const term of terms) {
    field.value = term;
    field.dispatchEvent(new Event('input', {bubbles: true}));
    await new Promise(setTimeout);
    found.push(dialog.querySelector('a[data-result]')?.href);
  }
  return found;
}"""


def test_search_marks_matches_and_tolerates_misspelling(visitor: Reader) -> None:
    button, keyboard = visitor.page.locator("button[data-search]"), visitor.page.keyboard
    button.click()
    dialog = visitor.page.locator("dialog.search")
    field, hits = dialog.locator("input"), dialog.locator("a[data-result]")
    field.fill("")
    dialog.get_by_role("button", name="white sky").click()
    expect(hits.first).to_have_attribute("href", re.compile("#from-photons-to-a-number$"))
    expect(field).to_be_focused()
    first_hit(visitor, dialog, "circle of confusion")
    marks = hits.first.locator(".result-excerpt mark")
    assert {mark.lower() for mark in marks.all_inner_texts()} >= {"circle", "confusion"}
    assert first_hit(visitor, dialog, "vingetting") == first_hit(visitor, dialog, "vignetting")
    field.fill("vingetting")
    expect(dialog.get_by_role("status")).to_contain_text("Similar")
    field.fill("banana")  # not similar enough to "balance"
    expect(dialog.get_by_role("status")).to_contain_text("Nothing found")
    expect(dialog.locator(".search-nothing")).to_be_visible()
    assert hits.count() == 0
    keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(button).to_be_focused()

    open_search(visitor)
    first_hit(visitor, dialog, "quaternion")
    for key, focused in (("ArrowDown", 0), ("ArrowDown", 1), ("ArrowUp", 0)):
        keyboard.press(key)
        expect(hits.nth(focused)).to_be_focused()
    keyboard.press("ArrowUp")
    expect(field).to_be_focused()
    keyboard.press("ArrowDown")
    keyboard.type("s")  # typing continues the search from any result
    expect(field).to_have_value("quaternions")
    expect(field).to_be_focused()
    wanted = first_hit(visitor, dialog, "gimbal lock")
    keyboard.press("Enter")
    visitor.page.wait_for_url(visitor.root + wanted)
    expect(dialog).to_be_hidden()
    heading = visitor.page.locator(f"#{wanted.partition('#')[2]}")
    expect(heading).to_be_in_viewport()
    below = """heading => heading.getBoundingClientRect().top >=
      document.querySelector('.site-header').getBoundingClientRect().bottom"""
    visitor.wait_for(heading, below)


def test_search_index_is_fetched_on_hover_and_again_after_a_failure(
    plain_reader: Reader, server: StaticServer
) -> None:
    page = plain_reader.page
    requests = plain_reader.record_requests()
    plain_reader.clear_cache()
    server.damaged["search/index.json"] = b"{"
    plain_reader.open("why-image-formation/", live=False)
    page.wait_for_load_state("networkidle")
    assert not [url for url in requests if "/search/" in url]
    with page.expect_request("**/search/index.json"):
        page.locator("button[data-search]").hover()
    dialog = open_search(plain_reader)
    again = dialog.get_by_role("button", name="Try again")
    expect(again).to_be_visible()
    server.damaged.clear()
    again.click()
    expect(again).to_be_hidden()
    first_hit(plain_reader, dialog, "vignetting")
