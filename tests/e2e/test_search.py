"""Every part of the book is found by its words: by hand, by keyboard, without a network."""

import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, expect
from support.reader import Reader
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[2]
TERMS = ROOT / "tests" / "fixtures" / "search_terms.txt"


def terms() -> Iterator[tuple[str, str]]:
    """What is looked for, and the address of the section that explains it."""
    for line in TERMS.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            term, _, address = line.partition(" | ")
            yield term, address


def glossary() -> Iterator[tuple[str, str]]:
    """Every name of every term, and the address of the section that is to explain it."""
    text = (ROOT / "content" / "glossary.toml").read_text(encoding="utf-8")
    for term, entry in tomllib.loads(text).items():
        chapter, mark, section = entry["explained"].partition("#")
        for name in (term, *entry.get("also", ())):
            yield name, f"{chapter}/{mark}{section}"


def opened(reader: Reader) -> Locator:
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
    """Nothing more is fetched for it once the index is there."""
    dialog = opened(visitor)
    first_hit(visitor, dialog, "lens")
    asked = visitor.note_requests()
    wanted = {**dict(terms()), **dict(glossary())}
    found = dict(zip(wanted, dialog.evaluate(FIRST_HITS, [*wanted]), strict=True))
    visitor.page.keyboard.press("Escape")
    assert not [address for address in asked if "/search/" in address]
    wrong = {
        term: (found[term], where)
        for term, where in wanted.items()
        if found[term] != visitor.root + where
    }
    assert not wrong


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


def test_what_was_found_is_marked_and_misspelt_words_find_what_is_near_or_nothing(
    visitor: Reader,
) -> None:
    button = visitor.page.locator("button[data-search]")
    button.click()
    dialog = visitor.page.locator("dialog.search")
    first_hit(visitor, dialog, "circle of confusion")
    marks = dialog.locator("a[data-result]").first.locator(".result-excerpt mark")
    assert {mark.lower() for mark in marks.all_inner_texts()} >= {"circle", "confusion"}
    assert first_hit(visitor, dialog, "vingetting") == first_hit(visitor, dialog, "vignetting")
    dialog.locator("input").fill("vingetting")
    expect(dialog.get_by_role("status")).to_contain_text("Similar")
    dialog.locator("input").fill("xyzzyplugh")
    expect(dialog.get_by_role("status")).to_contain_text("Nothing found")
    expect(dialog.locator(".search-nothing")).to_be_visible()
    assert dialog.locator("a[data-result]").count() == 0
    visitor.page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(button).to_be_focused()


def test_nothing_is_fetched_before_someone_is_about_to_search(
    plain_reader: Reader, book: dict[str, list[dict[str, str]]]
) -> None:
    asked = plain_reader.note_requests()
    plain_reader.open(book["chapters"][0]["url"], live=False)
    plain_reader.page.wait_for_load_state("networkidle")
    assert not [url for url in asked if "/search/" in url]
    with plain_reader.page.expect_request("**/search/index.json"):
        plain_reader.page.locator("button[data-search]").hover()


def test_results_are_chosen_by_keyboard_and_turn_the_page(visitor: Reader) -> None:
    dialog, keyboard = opened(visitor), visitor.page.keyboard
    first_hit(visitor, dialog, "quaternion")
    hits = dialog.locator("a[data-result]")
    keyboard.press("ArrowDown")
    expect(hits.nth(0)).to_be_focused()
    keyboard.press("ArrowDown")
    expect(hits.nth(1)).to_be_focused()
    keyboard.press("ArrowUp")
    keyboard.press("ArrowUp")
    expect(dialog.locator("input")).to_be_focused()
    keyboard.press("ArrowDown")
    keyboard.type("s")  # goes to the words, wherever the reader is
    expect(dialog.locator("input")).to_have_value("quaternions")
    expect(dialog.locator("input")).to_be_focused()
    wanted = first_hit(visitor, dialog, "gimbal lock")
    keyboard.press("Enter")
    visitor.page.wait_for_url(visitor.root + wanted)
    expect(visitor.page.locator("dialog.search")).to_be_hidden()
    heading = visitor.page.locator(f"#{wanted.partition('#')[2]}")
    expect(heading).to_be_in_viewport()
    visitor.page.wait_for_function(
        "heading => heading.getBoundingClientRect().top >="
        " document.querySelector('.site-header').getBoundingClientRect().bottom",
        arg=heading.element_handle(),
    )


def test_an_index_that_cannot_be_fetched_is_told_and_asked_for_again(
    plain_reader: Reader, server: StaticServer
) -> None:
    server.damaged["search/index.json"] = b"{"
    plain_reader.open(live=False)
    dialog = opened(plain_reader)
    again = dialog.get_by_role("button", name="Try again")
    expect(again).to_be_visible()
    server.damaged.clear()
    again.click()
    expect(again).to_be_hidden()
    first_hit(plain_reader, dialog, "vignetting")


def test_no_answer_of_a_question_is_in_the_index(built_site: Path, book: dict[str, list]) -> None:  # type: ignore[type-arg]
    """Of those that are long enough to be told from other sentences."""
    index = (built_site / "search" / "index.json").read_text(encoding="utf-8")
    chapters = [
        (built_site / chapter["url"] / "index.html").read_text(encoding="utf-8")
        for chapter in book["chapters"]
    ]
    options = [
        option["text"]
        for quiz in book["quizzes"]
        if quiz["kind"] in ("single", "multiple")
        for option in quiz["options"]
        if len(option["text"]) > 40 and sum(page.count(option["text"]) for page in chapters) < 2
    ]
    assert options
    assert not [option for option in options if option in index]
