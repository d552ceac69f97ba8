"""Predictions: a guess comes before its answer, by mouse or keyboard; guesses and answers survive
leaving the page."""

import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, Request, expect
from support.page_scripts import SAVE_DATA
from support.reader import Reader, step, visit
from support.static_server import StaticServer, serving

pytestmark = pytest.mark.browser


def test_guess_is_shown_beside_the_answer_until_it_is_reset(
    plain_reader: Reader, book: Any
) -> None:
    page = plain_reader.page
    reset = page.locator("[data-progress-reset]")
    form = open_prediction(plain_reader, book, "corner-of-a-barrel")
    answer = page.locator('[data-answers="corner-of-a-barrel"]')
    submit, guess = form.locator("button[type=submit]"), form.locator("input[name=guess]")
    with step("an empty guess is not judged"):
        submit.click()
        assert form.get_attribute("data-answered") is None, "nothing was guessed"
    with step("a wrong guess stands beside the answer, with its explanation"):
        guess.fill("40")
        submit.click()
        assert form.get_attribute("data-answered") == "wrong"
        assert form.locator(".guessed dd").inner_text() == "40 px"
        assert form.locator(".computed dd").inner_text().replace("\u00a0", " ") == "\u221240.0 px"
        assert form.locator(".explanation").count() == 1
    with step("the guess is reset"):
        reset.click()
        assert form.get_attribute("data-answered") is None
        assert guess.is_enabled()
        assert not answer.locator(".answer-body").is_visible()
    with step("another wrong guess has no explanation"):
        guess.fill("0")
        submit.click()
        assert form.locator(".explanation").count() == 0, "not taken for the mistake of −0.2"
    with step("the answer is shown without a guess, and announced once"):
        reset.click()
        answer.locator("[data-reveal]").click()
        assert answer.locator(".answer-body").is_visible(), "it can be shown where it is hidden"
        assert form.get_attribute("data-answered") == "revealed"
        reset.click()
        form.locator("[data-reveal]").press("Enter")
        assert form.get_attribute("data-answered") == "revealed"
        assert form.locator(".guessed").count() == 0
        status = form.locator("[role=status]")
        assert status.get_attribute("aria-live") == "polite", "announced on request"
        assert status.locator("> *").count() == 1, "as one"
    with step("it is still shown after a reload, and not announced"):
        page.reload()
        assert form.get_attribute("data-answered") == "revealed"
        assert status.get_attribute("aria-live") == "off", "not announced after a reload"

    with step("a wrong option is marked beside the right one"):
        form = open_prediction(plain_reader, book, "sharp-again")
        form.locator('input[name=guess][value="0"]').check()
        form.locator("button[type=submit]").click()
        assert form.get_attribute("data-answered") == "wrong"
        options = prediction_of(book, "sharp-again")["options"]
        (right,) = (option["text"] for option in options if option["correct"])
        assert form.locator(".computed dd").inner_text() == right
        assert form.locator(".explanation").count() == 2
        marks = form.locator("label:is(.correct, .wrong)")
        assert marks.count() == 2
        reset.click()
        assert marks.count() == 0


def test_links_to_an_experiment_wait_for_the_guess(plain_reader: Reader, book: Any) -> None:
    page = plain_reader.page
    form = open_prediction(plain_reader, book, "brightest-point")
    links = form.locator(".predict-question a.set")
    expect(links).to_have_count(2)
    expect(links.and_(page.locator("[href]"))).to_have_count(0)
    form.locator("[data-reveal]").click()
    expect(links.and_(page.locator("[href*='light_angle']"))).to_have_count(2)
    page.locator("[data-progress-reset]").click()
    expect(links.and_(page.locator("[href]"))).to_have_count(0)
    plain_reader.turn_to("speed-and-accuracy/", live=False)
    link = page.locator('.table-wrapper a[href="#ladder-inverse-strong"]')
    link.evaluate("link => { link.closest('details').open = true; }")
    link.click()  # to a table that is hidden until the prediction is answered
    expect(page.locator("#predict-where-iteration-fails button").first).to_be_in_viewport()


def test_sketch_is_drawn_by_mouse_or_keys_and_compared_with_the_truth(
    plain_reader: Reader, book: Any
) -> None:
    form = open_prediction(plain_reader, book, "frequency-shown")
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") is None, "nothing was drawn"
    assert not form.locator(".truth").is_visible()
    box = plain_reader.scroll_to(form.locator("svg"))
    x, y, scale = box["x"], box["y"], box["width"] / 400
    plain_reader.drag((x + 52 * scale, y + 206 * scale), (x + 384 * scale, y + 32 * scale), 20)
    assert sketch_values(form) == pytest.approx([1.2 * i / 8 for i in range(9)], abs=0.04)
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered") == "wrong", "it was drawn without a fold"
    assert form.locator(".truth").is_visible()

    form = open_prediction(plain_reader, book, "brightness-by-angle")
    form.locator("input[name=guess]").first.focus()
    for press in ("End", "Tab", "ArrowUp", "Tab", "ArrowDown", "Tab", "Tab", "ArrowUp"):
        plain_reader.page.keyboard.press(press)
    assert sketch_values(form) == pytest.approx([1, 0.51, 0.49, 0.5, 0.51, 0.5, 0.5, 0.5, 0.5])
    assert form.locator("circle.focused").count() == 1
    form.locator("button[type=submit]").press("Enter")
    assert form.get_attribute("data-answered") == "wrong"
    numbers = re.findall(r"\d[\w.]*\b", form.locator(".feedback").inner_text())
    assert numbers == ["90", "0.51", "0"], "the cosine of 90° is 0 within rounding"


def sketch_values(form: Locator) -> list[float]:
    return [float(point.input_value()) for point in form.locator("input[name=guess]").all()]


def prediction_of(book: Any, identity: str) -> Any:
    return next(item for item in book["predictions"] if item["id"] == identity)


def open_prediction(reader: Reader, book: Any, identity: str) -> Locator:
    chapter = prediction_of(book, identity)["chapter"]
    url = next(c["url"] for c in book["chapters"] if c["id"] == chapter)
    reader.open(url, live=False)
    return reader.page.locator(f'form[data-predict="{identity}"]')


ALL_KINDS = ("why-image-formation/", "perspective-projection/")
"""Chapters that together have every kind of question; the first has one figure."""
GIVE = """() => {
  for (const form of document.querySelectorAll('main form:is([data-quiz], [data-predict])')) {
    for (const input of form.querySelectorAll('input:not([type=hidden])')) {
      const isBox = ['radio', 'checkbox'].includes(input.type);
      if (isBox) input.checked = true;
      else input.value = input.type === 'range' ? input.max : '12';
      input.dispatchEvent(new Event('input', {bubbles: true}));
    }
    form.querySelector('[data-move=down]')?.click();
  }
}"""
"""Answer each question of the page without submitting."""
GIVEN = """() => [...document.querySelectorAll('main form:is([data-quiz], [data-predict])')]
  .map((form) => [form.id, form.dataset.answered, 'drawn' in form.dataset,
    ...[...form.querySelectorAll('input')].map(({value, checked}) => [value, checked])])"""


@pytest.mark.parametrize("chapter", ALL_KINDS)
def test_unsubmitted_answers_survive_a_change_of_page_and_a_reload(
    plain_reader: Reader, chapter: str
) -> None:
    page = plain_reader.page
    plain_reader.open(chapter, live=False)
    page.evaluate(GIVE)
    given = page.evaluate(GIVEN)
    plain_reader.turn_to("glossary/", live=False)
    plain_reader.turn_to(chapter, live=False)
    assert page.evaluate(GIVEN) == given
    page.reload()
    assert page.evaluate(GIVEN) == given
    page.locator("[data-progress-reset]").click()
    plain_reader.turn_to("glossary/", live=False)
    plain_reader.turn_to(chapter, live=False)
    assert page.locator("form.quiz input:checked").count() == 0, "forgotten with the others"


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a page outside the book."""
    root = tmp_path_factory.mktemp("elsewhere")
    (root / "index.html").write_text("<!DOCTYPE html><title>Elsewhere</title>")
    with serving(root) as host:
        yield host.url


@pytest.mark.parametrize(
    "kept", [True, pytest.param(False, marks=pytest.mark.deep)], ids=["page kept", "page reloaded"]
)
def test_settings_answers_and_figures_survive_leaving_the_book_and_back(
    baseline_chromium: Browser,
    launch: Callable[..., Browser],
    full_chromium: Path,
    server: StaticServer,
    elsewhere: str,
    kept: bool,
) -> None:
    with ExitStack() as end:
        browser = baseline_chromium
        if kept:  # as browsers do by default, but not under Playwright
            forbidden = ["--disable-back-forward-cache"]
            options = {"executable_path": full_chromium, "ignore_default_args": forbidden}
            browser = end.enter_context(launch("--js-flags=--liftoff-only", **options))
        reader = end.enter_context(visit(browser, server, f"{RECORD_SHOW}; {SAVE_DATA}"))
        page = reader.page
        under_way = requests_under_way(page)
        with step("a figure is set and questions are answered"):
            reader.open(ALL_KINDS[0])
            figure = page.locator("simulation-figure")
            slider = figure.locator("input[type=range]").first
            slider.press("PageUp")
            moved = slider.input_value()
            page.wait_for_function("location.search !== ''")
            page.evaluate(GIVE)
            sent = page.locator("form.quiz:has([type=radio])").first
            sent.locator("button[type=submit]").click()
            given = page.evaluate(GIVEN)
        with step("the reader leaves the book and comes back"):
            for _ in range(TRIES if kept else 1):
                # A page is kept only while its worker rests and no file is on its way.
                reader.settle(figure)
                while under_way:
                    page.evaluate("new Promise(requestAnimationFrame)")
                page.evaluate("window.persisted = undefined")
                page.evaluate("url => location.assign(url)", elsewhere)
                page.wait_for_url(elsewhere)
                # `go_back` waits for a page to load.
                page.evaluate("setTimeout(() => history.back())")
                page.wait_for_url(lambda url: ALL_KINDS[0] in url, wait_until="commit")
                page.wait_for_function("window.persisted !== undefined")
                reader.wait_live()
                if page.evaluate("window.persisted") is kept:
                    break
            else:
                pytest.fail(page.evaluate(WHY_NOT))
        with step("all is as it was, and the figure answers"):
            assert slider.input_value() == moved
            assert page.evaluate(GIVEN) == given
            assert sent.get_attribute("data-answered")
            reader.press(figure, "PageDown")


RECORD_SHOW = "addEventListener('pageshow', ({persisted}) => { window.persisted = persisted; })"
TRIES = 3
"""A browser on a busy machine may decide not to keep a page."""
WHY_NOT = "JSON.stringify(performance.getEntriesByType('navigation')[0].notRestoredReasons)"
"""The browser's reasons for not keeping the page."""


def requests_under_way(page: Page) -> set[Request]:
    """The requests without a reply so far; the set is updated."""
    under_way: set[Request] = set()
    page.on("request", lambda request: under_way.add(request))
    page.on("requestfinished", lambda request: under_way.discard(request))
    page.on("requestfailed", lambda request: under_way.discard(request))
    return under_way
