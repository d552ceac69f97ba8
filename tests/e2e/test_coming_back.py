"""A page that is left and come back to: figures and answers are as they were, sent or not."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, Request
from support.page_scripts import FRUGAL
from support.reader import START_MS, Reader, visit
from support.static_server import StaticServer, serving

pytestmark = pytest.mark.browser

ALL_KINDS = ("why-image-formation/", "perspective-projection/")
"""Chapters with every kind of question between them; the first has one figure."""
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
"""An answer to each question of the page, none of them sent."""
GIVEN = """() => [...document.querySelectorAll('main form:is([data-quiz], [data-predict])')]
  .map((form) => [form.id, form.dataset.answered, 'drawn' in form.dataset,
    ...[...form.querySelectorAll('input')].map(({value, checked}) => [value, checked])])"""
LEAVE = """(url) => {
  const link = document.createElement('a');
  link.href = url;
  document.getElementById('main').append(link);
  link.click();
}"""
TELL = "addEventListener('pageshow', ({persisted}) => { window.persisted = persisted; })"
TRIES = 3
"""A browser on a busy machine may decide not to keep a page."""
WHY_NOT = "JSON.stringify(performance.getEntriesByType('navigation')[0].notRestoredReasons)"
"""What the browser says where it has not kept the page."""


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a page that is none of the book's."""
    root = tmp_path_factory.mktemp("elsewhere")
    (root / "index.html").write_text("<!DOCTYPE html><title>Elsewhere</title>")
    with serving(root) as host:
        yield host.url


@pytest.mark.parametrize(
    "kept",
    [True, pytest.param(False, marks=pytest.mark.deep)],
    ids=["page kept", "page loaded anew"],
)
def test_back_from_elsewhere_settings_and_answers_are_as_they_were_and_the_figure_answers(
    brisk_chromium: Browser,
    launch: Callable[..., Browser],
    whole_browser: Path,
    server: StaticServer,
    elsewhere: str,
    kept: bool,
) -> None:
    with ExitStack() as end:
        browser = brisk_chromium
        if kept:  # as browsers do of themselves; Playwright has them not do it
            forbidden = ["--disable-back-forward-cache"]
            browser = launch(
                "--js-flags=--liftoff-only",
                executable_path=whole_browser,
                ignore_default_args=forbidden,
            )
            end.enter_context(browser)
        reader = end.enter_context(visit(browser, server, f"{TELL}; {FRUGAL}"))
        page = reader.page
        under_way = requests_under_way(page)
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

        for _ in range(TRIES if kept else 1):
            reader.settle(figure)  # whose worker computes is not kept, nor who still asks for files
            deadline = time.monotonic() + START_MS / 1000
            while under_way and time.monotonic() < deadline:
                page.wait_for_timeout(50)
            page.evaluate("window.persisted = undefined")
            page.evaluate(LEAVE, elsewhere)
            page.wait_for_url(elsewhere)
            page.evaluate("setTimeout(() => history.back())")  # `go_back` waits for a page to load
            page.wait_for_url(lambda url: ALL_KINDS[0] in url, wait_until="commit")
            page.wait_for_function("window.persisted !== undefined")
            reader.wait_live()
            if page.evaluate("window.persisted") is kept:
                break
        else:
            pytest.fail(page.evaluate(WHY_NOT))

        assert slider.input_value() == moved
        assert page.evaluate(GIVEN) == given
        assert sent.get_attribute("data-answered")
        reader.press(figure, "PageDown")


def requests_under_way(page: Page) -> set[Request]:
    """Those that are not answered, now and whenever one looks."""
    under_way: set[Request] = set()
    page.on("request", lambda request: under_way.add(request))
    page.on("requestfinished", lambda request: under_way.discard(request))
    page.on("requestfailed", lambda request: under_way.discard(request))
    return under_way


@pytest.mark.parametrize("chapter", ALL_KINDS)
def test_answers_that_are_not_sent_outlive_a_turn_of_the_page_and_a_reload(
    plain_reader: Reader, chapter: str
) -> None:
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
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
