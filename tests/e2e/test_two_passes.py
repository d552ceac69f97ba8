"""The first pass through a chapter: deeper sections are folded until they are needed."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect
from support.reader import Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

CHAPTER, NEXT = "digital-sensor/", "sampling-and-aliasing/"
SECTION = "a-sensor-from-pairs-of-frames"
SHUT = "details.deeper:not([open])"


@pytest.fixture
def newcomer(baseline_chromium: Browser, server: StaticServer) -> Iterator[Reader]:
    with visit(baseline_chromium, server, folded=True) as reader:
        yield reader
        reader.assert_no_errors()


def test_figure_of_a_deeper_section_starts_once_it_is_opened(newcomer: Reader) -> None:
    """A reload keeps the section open."""
    newcomer.open(CHAPTER, live=False)
    unfolded = newcomer.page.locator("#figure-few-drops simulation-figure")
    expect(unfolded).to_have_attribute("data-state", "live")
    section, figure = newcomer.page.locator(f"#{SECTION}"), newcomer.figure("photon-transfer")
    fold = newcomer.page.locator("details.deeper", has=section)
    expect(figure).to_be_hidden()
    expect(figure).to_have_attribute("data-state", "still")
    fold.locator("> summary").click()
    expect(figure).to_have_attribute("data-state", "live")
    newcomer.scroll_to(figure.locator(".control-grid").first)
    newcomer.press(figure, "ArrowRight")
    expect(figure.locator(".panel-view canvas").first).to_be_visible()
    newcomer.page.wait_for_function("history.state?.opened?.length === 1")
    newcomer.page.reload()
    expect(figure).to_be_visible()
    assert newcomer.page.locator(SHUT).count() > 1


def test_deeper_section_opens_for_any_link_to_a_place_in_it(newcomer: Reader) -> None:
    page, question = newcomer.page, "quiz-a-leaning-post"
    question_form = page.locator(f"#{question}")
    newcomer.open(f"{CHAPTER}#{question}", live=False)
    expect(question_form).to_be_in_viewport()
    newcomer.open(NEXT, live=False)
    newcomer.turn_to_unlinked(f"{CHAPTER}#{question}")
    expect(question_form).to_be_in_viewport()
    question_form.locator("input").fill("12")
    question_form.locator("[type=submit]").click()
    expect(question_form).to_have_attribute("data-answered", "correct")

    newcomer.open(f"{CHAPTER}?", live=False)
    expect(question_form).to_be_hidden()
    page.locator(f"#contents a[href='#{SECTION}']").click()
    expect(newcomer.figure("photon-transfer").locator("..")).to_be_visible()
    page.keyboard.press("/")
    page.locator("dialog.search input").fill("leans telephone bus")
    page.locator("a[data-result]", has_text="Row by row").click()
    expect(page.locator("#row-by-row")).to_be_in_viewport()
    expect(page.locator("#example-how-far-does-the-bus-lean")).to_be_visible()
    page.go_back()
    page.emulate_media(media="print")
    expect(page.locator("#table-adaptation")).to_be_visible()


def test_choice_to_read_everything_is_stored(newcomer: Reader) -> None:
    page = newcomer.page
    newcomer.open(CHAPTER, live=False)
    everything, first_pass = (
        page.locator(f"[name=pass][value={way}]") for way in ("whole", "first")
    )
    expect(first_pass).to_be_checked()
    everything.check()
    expect(page.locator(SHUT)).to_have_count(0)
    page.reload()
    expect(page.locator(SHUT)).to_have_count(0)
    newcomer.turn_to("lighting-and-reflectance/", live=False)
    expect(everything).to_be_checked()
    expect(page.locator(SHUT)).to_have_count(0)
    first_pass.check()
    page.reload()
    expect(page.locator("#figure-brdf")).to_be_hidden()
