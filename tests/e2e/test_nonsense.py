"""Settings and answers that no hand could have given: the page takes none of it, and goes on."""

import pytest
from playwright.sync_api import Browser
from support.reader import Reader, visit
from support.static_server import StaticServer

pytestmark = pytest.mark.browser

JUNK = """(junk) => {
  const prefix = Object.keys(localStorage).find((key) => key.endsWith(':order')).slice(0, -5);
  for (const form of document.querySelectorAll('main form:is([data-quiz], [data-predict])')) {
    const {id, edition} = JSON.parse(form.querySelector('script[type="application/json"]').text);
    const kind = form.dataset.quiz ? 'quiz' : 'predict';
    localStorage.setItem(`${prefix}${kind}:${id}`, junk.replace('EDITION', edition));
  }
  const page = location.pathname.split('/').slice(-2).join('/');
  for (const figure of document.querySelectorAll('figure[id]')) {
    localStorage.setItem(`${prefix}python:${page}#${figure.id}`, junk);
  }
  for (const key of ['theme', 'order', 'keys']) localStorage.setItem(prefix + key, junk);
  sessionStorage.setItem(`${prefix}unsent`, junk);
}"""
"""Under every name that the book keeps anything."""
JUNKS = (
    *("[[[", "5", '"text"', "[]", "null", "{}"),
    '{"edition": "EDITION", "runs": true}',
    *(
        f'{{"edition": "EDITION", "answer": {junk}, "guess": {junk}, "edits": {junk}}}'
        for junk in ('"5"', "[null]", "[[0]]", "[-1]", "{}", "1e400", '{"length": 2}')
    ),
)
DENIED = """delete globalThis.WebAssembly;
for (const [owner, name] of [[window, 'localStorage'], [window, 'sessionStorage'],
    [window, 'indexedDB'], [window, 'caches'], [Navigator.prototype, 'serviceWorker']]) {
  const get = () => { throw new DOMException('denied', 'SecurityError'); };
  Object.defineProperty(owner, name, {get});
}"""


@pytest.mark.parametrize("chapter", ["why-image-formation/", "perspective-projection/"])
def test_junk_under_every_name_that_the_book_keeps_is_no_answer_and_does_no_harm(
    plain_reader: Reader, chapter: str
) -> None:
    """Between them the chapters have every kind of question and of prediction."""
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
    for junk in JUNKS:
        page.evaluate(JUNK, junk)
        page.evaluate("document.dispatchEvent(new Event('answers-read'))")  # as from a file
        assert page.locator("[data-answered]").count() == 0, junk
        plain_reader.assert_no_complaints()
    page.evaluate(JUNK, "[[[")
    page.reload()
    page.wait_for_function("document.querySelector('.progress-count')?.textContent")
    assert page.locator("[data-answered]").count() == 0
    form = page.locator("form.quiz:has([type=radio])").first
    form.locator("[type=radio]").first.check()
    form.locator("button[type=submit]").click()
    assert form.get_attribute("data-answered")


def test_a_browser_that_denies_every_kind_of_storage_shows_a_book_that_works(
    chromium: Browser, server: StaticServer
) -> None:
    with visit(chromium, server, DENIED) as reader:
        page = reader.page
        reader.open("why-image-formation/", live=False)
        page.locator(".theme-toggle").click()
        assert page.locator("html").get_attribute("data-theme") == "light"
        form = page.locator("form.quiz:has([type=radio])").first
        form.locator("[type=radio]").first.check()
        form.locator("button[type=submit]").click()
        verdict = form.get_attribute("data-answered")
        assert verdict
        unsent = page.locator("form.quiz input[type=number], form.quiz input[inputmode]").first
        unsent.fill("12")
        reader.turn_to("glossary/", live=False)
        reader.turn_to("why-image-formation/", live=False)
        assert form.get_attribute("data-answered") == verdict
        assert unsent.input_value() == "12"
        reader.assert_no_complaints()
