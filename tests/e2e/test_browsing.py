"""Turning pages, finding one's place, themes, paper."""

from typing import Any, Literal

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

HEAD = """() => [...document.head.querySelectorAll(
    "link:not([rel=stylesheet], [rel=preload], [rel=modulepreload]), meta:not([http-equiv])")]
  .map((part) => `${part.rel ?? part.name} ${part.href ?? part.content}`).sort()"""


def test_turning_the_page_keeps_the_interpreter(visitor: Reader, book: Any) -> None:
    with_figures = [c for c in book["chapters"] if c["simulations"]][:2]
    first, second = with_figures
    visitor.turn_to(first["url"])
    (worker,) = visitor.page.workers
    visitor.turn_to(second["url"])
    assert visitor.page.workers == [worker]
    assert visitor.page.locator("h1").inner_text().strip() == second["title"]
    assert second["title"] in visitor.page.title()
    current = visitor.page.locator('#contents a[aria-current="page"]')
    assert second["title"] in (current.text_content() or "")


def test_another_language_keeps_section_figures_interpreter_and_answers(visitor: Reader) -> None:
    page, section = visitor.page, "exploit-it-or-compensate-for-it"
    visitor.turn_to("why-image-formation/")
    (worker,) = page.workers
    page.locator("#figure-formation-pipeline input[name=albedo]").fill("0.3")
    page.wait_for_url("**albedo=0.3**")
    page.locator("#quiz-why-model-formation input[value='3']").check()
    page.locator("#quiz-why-model-formation button[type=submit]").click()
    page.evaluate(
        "id => document.getElementById(id).scrollIntoView({behavior: 'instant'})", section
    )
    page.locator(f".other-language[href$='#{section}']").click()
    page.wait_for_url(f"{visitor.root}de/why-image-formation/?*albedo=0.3#{section}")
    assert page.locator("html").get_attribute("lang") == "de"
    page.wait_for_function(
        "id => Math.abs(document.getElementById(id).getBoundingClientRect().top) < 120", arg=section
    )
    reply = page.locator("#quiz-why-model-formation [role=status]").inner_text()
    assert "Die Höhe in Pixeln" in reply
    visitor.wait_live()
    assert page.workers == [worker]
    assert page.locator("#figure-formation-pipeline .control-value").first.inner_text() == "0,30"
    drawing = page.locator("#figure-formation-pipeline svg.overlay").last
    page.locator("#figure-formation-pipeline").get_by_text("Weiter", exact=True).click()
    expect(drawing).to_contain_text("(0,40; −0,30; 4,00) m von der Kamera")
    description = page.locator("#figure-formation-pipeline .description[lang=de]")
    expect(description).to_contain_text("Die Pose der Kamera macht aus")
    page.go_back()
    page.wait_for_function("document.documentElement.lang === 'en'")
    assert page.locator(f".other-language[href$='#{section}']").inner_text() == "Deutsch"


def test_a_search_in_another_language_finds_what_is_not_translated_too(visitor: Reader) -> None:
    visitor.turn_to("why-image-formation/", live=False)
    visitor.turn_to("de/why-image-formation/", live=False)
    found = visitor.page.locator(".search-results a")
    for words, address in (("Farbtupfer", "/de/why-image-formation/"), ("vignetting", "/lens-")):
        visitor.page.keyboard.press("/")
        visitor.page.locator("dialog.search input").fill(words)
        visitor.page.wait_for_function(
            "start => document.querySelector('.search-results a')?.href.includes(start)",
            arg=address,
        )
        assert found.count()
        visitor.page.keyboard.press("Escape")


def test_a_link_to_a_heading_arrives_at_it_and_back_returns_to_the_place_that_was_left(
    plain_reader: Reader, book: Any
) -> None:
    first, second = (chapter["url"] for chapter in book["chapters"][1:3])
    plain_reader.open(first, live=False)
    link = plain_reader.page.locator("#contents .sections a").last
    target = (link.get_attribute("href") or "").removeprefix("#")
    link.click()
    plain_reader.page.wait_for_function(IN_VIEW, arg=target)
    plain_reader.page.evaluate("scrollTo({top: 700, behavior: 'instant'})")
    left_at = plain_reader.page.evaluate("scrollY")
    plain_reader.turn_to(second, live=False)
    assert plain_reader.page.evaluate("scrollY") == 0
    plain_reader.page.go_back()
    plain_reader.page.wait_for_function(
        "url => location.href === url", arg=f"{plain_reader.root}{first}#{target}"
    )
    plain_reader.page.wait_for_function("top => Math.abs(scrollY - top) < 3", arg=left_at)


def test_what_a_head_says_of_its_page_turns_with_it_there_and_back(
    plain_reader: Reader, book: Any
) -> None:
    plain_reader.open("", live=False)
    page, chapter = plain_reader.page, book["chapters"][1]
    page.evaluate("window.stays = true")
    plain_reader.turn_to(chapter["url"], live=False)
    turned = page.evaluate(HEAD)
    page.evaluate("history.back()")
    page.wait_for_function("title => !document.title.includes(title)", arg=chapter["title"])
    assert page.evaluate("window.stays")
    plain_reader.open(chapter["url"], live=False)
    assert turned == page.evaluate(HEAD)


IN_VIEW = """(id) => {
  const {top} = document.getElementById(id).getBoundingClientRect();
  return top >= 0 && top < innerHeight;
}"""


def test_the_whole_book_is_read_by_next_links(plain_reader: Reader, book: Any) -> None:
    chapters = book["chapters"]
    plain_reader.open(chapters[0]["url"], live=False)
    for chapter in chapters[1:]:
        plain_reader.page.locator('a[rel="next"]').last.click()
        plain_reader.page.wait_for_function(
            "url => location.href === url", arg=plain_reader.root + chapter["url"]
        )
        assert plain_reader.page.evaluate("document.activeElement.id") == "main"


@pytest.mark.parametrize(("system", "pressed"), [("light", "dark"), ("dark", "light")])
def test_the_first_press_of_the_theme_button_changes_what_is_seen_and_is_remembered(
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


def test_a_reload_keeps_the_place_though_the_address_names_a_figure(plain_reader: Reader) -> None:
    page = plain_reader.page
    address = "lens-distortion/?figure-lens-distortion.k1=-0.2#figure-lens-distortion"
    plain_reader.open(address, live=False)
    page.evaluate("scrollBy(0, 150)")
    page.wait_for_function("history.state?.scroll === Math.round(scrollY)")
    place = page.evaluate("Math.round(scrollY)")
    page.reload()
    page.wait_for_function("place => Math.abs(scrollY - place) < 3", arg=place)


def test_the_contents_open_and_close_by_keyboard(plain_reader: Reader) -> None:
    plain_reader.page.set_viewport_size({"width": 800, "height": 800})
    plain_reader.open(live=False)
    button = plain_reader.page.locator(".contents-toggle")
    button.focus()
    plain_reader.page.keyboard.press("Enter")
    assert plain_reader.page.locator("#contents").is_visible()
    plain_reader.page.keyboard.press("Escape")
    assert not plain_reader.page.locator("#contents").is_visible()
    assert button.evaluate("button => button === document.activeElement")
