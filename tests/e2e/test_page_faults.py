"""Failing or corrupt storage, a second tab, a lost host, hostile addresses, injected content: no
answer is lost, and the page keeps working."""

import base64
import hashlib
import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
from playwright.sync_api import Browser, Locator, Page, expect
from support.reader import Reader, visit
from support.static_server import StaticServer, serving

from site_builder.files.folders import integrity
from site_builder.pages.policy import ANYTHING_INLINE, FOR_TOOLS
from site_builder.publishing.hosting import common_policy

pytestmark = pytest.mark.browser

CHAPTER, OTHER = "perspective-projection/", "glossary/"


@pytest.fixture
def chapter(book: Any) -> str:
    """A chapter with two questions of the simplest kind."""
    single = {quiz["id"] for quiz in book["quizzes"] if quiz["kind"] == "single"}
    return str(next(c["url"] for c in book["chapters"] if len(single & set(c["quizzes"])) > 1))


def form(page: Page, number: int = 0) -> Locator:
    return page.locator("form.quiz:has(input[type=radio])").nth(number)


def answer(page: Page, option: int, number: int = 0) -> None:
    """Choose the option at that place in the source, and submit it."""
    question = form(page, number)
    question.locator(f"input[value='{option}']").check()
    question.locator("button[type=submit]").click()


def submitted(page: Page, number: int = 0) -> str | None:
    """The value of the submitted answer."""
    question = form(page, number)
    if question.get_attribute("data-answered") is None:
        return None
    return question.locator("input:checked").get_attribute("value")


def test_full_storage_is_reported_once_and_answers_last_for_the_visit(
    plain_reader: Reader, chapter: str
) -> None:
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
    page.evaluate(FULL)
    answer(page, 1)
    notice = page.locator(".notice")
    assert "stores nothing for the book" in notice.inner_text()
    notice.get_by_role("button", name="Close").click()
    answer(page, 0, number=1)
    assert notice.count() == 0
    plain_reader.turn_to(OTHER, live=False)
    plain_reader.turn_to(chapter, live=False)
    assert (submitted(page), submitted(page, 1)) == ("1", "0")
    with page.expect_download() as download:
        page.locator("[data-progress-export]").click()
    saved = json.loads(download.value.path().read_text(encoding="utf-8"))
    assert len(saved["answers"]) == 2
    page.reload()  # with storage as it was


FULL = """() => {
  for (let size = 2 ** 22; size >= 1; size /= 2) {
    try {
      for (let at = 0; ; at += 1) localStorage.setItem(`other ${size} ${at}`, 'x'.repeat(size));
    } catch {}
  }
}"""
"""Fill the storage of this host."""


def test_answer_in_one_tab_appears_in_another_and_overwrites_nothing(
    plain_reader: Reader, chapter: str
) -> None:
    plain_reader.open(chapter, live=False)
    one = plain_reader.page
    other = one.context.new_page()
    other.goto(one.url)
    unsent = form(other, 1).locator("input[value='1']")
    unsent.check()
    answer(one, 1)
    expect(form(other)).to_have_attribute("data-answered", re.compile("correct|wrong"))
    assert submitted(other) == "1"
    assert unsent.is_checked(), "not yet given"
    answer(other, 0)
    expect(form(one).locator("input[value='0']")).to_be_checked()
    other.close()
    one.reload()
    assert submitted(one) == "0", "the last one"


def test_edits_of_one_figure_in_two_tabs_are_stored_together(
    tabs: list[Page], site_server: StaticServer
) -> None:
    for tab in tabs:
        tab.goto(f"{site_server.url}lens-distortion/")
    figures = [tab.locator("#figure-lens-distortion simulation-figure") for tab in tabs]
    for figure in figures:
        figure.locator(".open-python").click()
    for tab, figure, part in zip(tabs, figures, ("encoded", "pinhole"), strict=True):
        figure.locator(".workshop-part", has_text=part).first.click()
        figure.locator(".cm-content").click()
        tab.keyboard.insert_text("# mine\n")
        figure.locator(f".workshop-part[data-edited]:has-text('{part}')").wait_for()
    stored = "() => Object.keys(JSON.parse(localStorage[EDITS] ?? '{}').edits ?? {}).length"
    stored = stored.replace(
        "EDITS", "'image-formation:python:lens-distortion/#figure-lens-distortion'"
    )
    assert tabs[0].evaluate(stored) == 2
    figures[0].locator(".put-back").click()
    assert tabs[0].evaluate(stored) == 1


def test_page_stays_while_the_host_is_down_and_turns_once_it_is_back(
    plain_reader: Reader, server: StaticServer, chapter: str
) -> None:
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
    answer(page, 1)
    plain_reader.clear_cache()
    server.offline = True
    page.evaluate("document.querySelector('nav a[href*=glossary], a[href*=glossary]').click()")
    notice = page.locator(".notice")
    notice.wait_for()
    server.offline = False
    assert "This one stays" in notice.inner_text()
    assert submitted(page) == "1"
    notice.get_by_role("button", name="Try again").click()
    page.wait_for_url(f"**/{OTHER}")
    plain_reader.errors.clear()  # the browser's own, of the host


FIGURE, HARM = "figure-perspective-projection", "<script>window.harmed = true</script>"
HOSTILE = (
    f"?a.b={HARM}&{FIGURE}.depth={HARM}&{FIGURE}.__proto__=1&__proto__.depth=2#__proto__",
    f"?{FIGURE}.depth=1e309&{FIGURE}.depth=NaN#{HARM}",
    f"?{FIGURE}.depth=&{'&'.join(f'{FIGURE}.{at}=1' for at in range(1000))}#javascript:harmed=true",
    f"?{FIGURE}.depth=%E2%80%AE%1B[31m",
    *("?%00=%00#%00", "#%", "#%E0%A4%A", "#" + "x" * 100_000),
)


def test_hostile_address_runs_and_sets_nothing(plain_reader: Reader) -> None:
    page, figure = plain_reader.page, plain_reader.figure("perspective-projection")
    for end in HOSTILE:
        page.goto("about:blank")
        plain_reader.open(CHAPTER + (end if "%" in end else quote(end, safe="?#&=:~")), live=False)
        expect(page.locator(".progress-count")).not_to_be_empty()
        assert figure.locator("input[name=depth]").input_value() == "5", end[:80]
        assert page.evaluate("window.harmed") is None, end[:80]
        message = figure.locator(".figure-message").text_content() or ""
        assert len(message) < 500, end[:80]
        assert message.strip().isprintable(), end[:80]


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
"""Store junk under every key that the book uses."""
JUNKS = (
    *("[[[", "5", '"text"', "[]", "null", "{}"),
    '{"edition": "EDITION", "runs": true}',
    *(
        f'{{"edition": "EDITION", "answer": {junk}, "guess": {junk}, "edits": {junk}}}'
        for junk in ('"5"', "[null]", "[[0]]", "[-1]", "{}", "1e400", '{"length": 2}')
    ),
)


def test_huge_stored_answers_and_search_texts_are_dropped(
    plain_reader: Reader, chapter: str
) -> None:
    """Half a million numbers in a stored answer, and 100 000 letters in the search."""
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
    page.evaluate(HUGE, 480_000)
    page.reload()
    expect(page.locator(".progress-count")).not_to_be_empty()
    assert submitted(page) is None
    answer(page, 0)
    assert submitted(page) == "0"
    page.keyboard.press("/")
    field = page.locator("dialog.search input")
    for text in ("x" * 100_000, "colour " * 20_000):
        field.fill(text)
        expect(page.locator(".search-status")).not_to_be_empty()
        assert len(field.input_value()) <= 200


HUGE = """(count) => {
  const form = document.querySelector('form.quiz:has(input[type=radio])');
  const {id, edition} = JSON.parse(form.querySelector('script[type="application/json"]').text);
  const prefix = Object.keys(localStorage).find((key) => key.endsWith(':order')).slice(0, -5);
  const answer = Array(count).fill(0);
  localStorage.setItem(`${prefix}quiz:${id}`, JSON.stringify({edition, answer, right: true}));
}"""


@pytest.mark.parametrize("chapter", ["why-image-formation/", "perspective-projection/"])
def test_invalid_answers_in_storage_are_ignored(plain_reader: Reader, chapter: str) -> None:
    """Together the chapters have every kind of question and prediction."""
    plain_reader.open(chapter, live=False)
    page = plain_reader.page
    for junk in JUNKS:
        page.evaluate(JUNK, junk)
        page.evaluate("document.dispatchEvent(new Event('answers-read'))")  # as from a file
        assert page.locator("[data-answered]").count() == 0, junk
        plain_reader.assert_no_errors()
    page.evaluate(JUNK, "[[[")
    page.reload()
    expect(page.locator(".progress-count")).not_to_be_empty()
    assert page.locator("[data-answered]").count() == 0
    answer(page, 0)
    assert submitted(page) == "0"


LOADED = (
    ("perspective-projection/", "sessionStorage", "unsent", "null"),
    ("measure-your-camera/", "localStorage", "instrument:calibration", "5"),
)


@pytest.mark.parametrize(("address", "storage", "name", "junk"), LOADED)
def test_page_with_invalid_storage_works_and_can_be_left(
    plain_reader: Reader, address: str, storage: str, name: str, junk: str
) -> None:
    plain_reader.open(address, live=False)
    page = plain_reader.page
    page.locator(".theme-toggle").click()
    page.evaluate(KEEP, [storage, name, junk])
    page.reload()
    if name.startswith("instrument"):
        expect(
            page.locator("figure:has([data-simulation=calibration]) .intake-keep")
        ).to_be_checked()
    else:
        expect(page.locator(".progress-count")).not_to_be_empty()
    plain_reader.turn_to("glossary/", live=False)
    plain_reader.assert_no_errors()


KEEP = """([storage, name, junk]) => {
  const prefix = Object.keys(localStorage).find((key) => key.endsWith(':theme')).slice(0, -5);
  window[storage].setItem(prefix + name, junk);
}"""


def test_book_works_where_storage_of_every_kind_and_changes_of_the_history_are_denied(
    chromium: Browser, server: StaticServer
) -> None:
    with visit(chromium, server, DENIED) as reader:
        page = reader.page
        reader.open("why-image-formation/", live=False)
        page.locator(".theme-toggle").click()
        assert page.locator("html").get_attribute("data-theme") == "dark"
        answer(page, 0)
        assert submitted(page) == "0"
        unsent = page.locator("form.quiz .number-answer > input").first
        unsent.fill("12")
        reader.turn_to("glossary/", live=False)
        reader.turn_to("why-image-formation/", live=False)
        assert submitted(page) == "0"
        assert unsent.input_value() == "12"
        reader.assert_no_errors()


DENIED = """delete globalThis.WebAssembly;
for (const [owner, name] of [[window, 'localStorage'], [window, 'sessionStorage'],
    [window, 'indexedDB'], [window, 'caches'], [Navigator.prototype, 'serviceWorker'],
    [History.prototype, 'replaceState']]) {
  const get = () => { throw new DOMException('denied', 'SecurityError'); };
  Object.defineProperty(owner, name, {get});
}"""


def published_policy(site: Path) -> str:
    """The policy of published pages, without the exceptions for tools of unpublished ones."""
    pages = [page.read_bytes() for page in site.rglob("*.html")]
    found = (re.findall(r"<style>(.*?)</style>", page.decode(), re.DOTALL) for page in pages)
    styles = {style for each in found for style in each}
    hashes = " ".join(sorted(f"'{integrity(style.encode())}'" for style in styles))
    lax = common_policy(pages)
    strict = lax.replace(f" {FOR_TOOLS}", "").replace(
        f"style-src 'self' {ANYTHING_INLINE}", f"style-src 'self' {hashes}"
    )
    assert len(strict) != len(lax)
    assert f"{ANYTHING_INLINE};" not in strict.replace("style-src-attr 'unsafe-inline';", "")
    return strict


def test_strictest_policy_allows_the_book_and_nothing_else(
    baseline_chromium: Browser, built_site: Path
) -> None:
    """Sent as a header, which also applies to workers. A figure becomes live, its Python opens in
    the styled editor, and formulae need one font file."""
    header = {"Content-Security-Policy": published_policy(built_site)}
    with serving(built_site, header) as host, visit(baseline_chromium, host, WATCH) as reader:
        page = reader.page
        reader.open("lens-distortion/", live=False)
        figure = page.locator("simulation-figure").first
        expect(figure).to_have_attribute("data-state", "live")
        figure.locator(".open-python").click()
        figure.locator(".cm-editor .cm-line").first.wait_for()
        expect(figure.locator(".cm-scroller")).to_have_css("display", "flex")
        names = page.evaluate(
            "performance.getEntriesByType('resource').map(({name}) => name.split('/').at(-1))"
        )
        assert [name for name in names if name.startswith("maths")] == ["maths.woff2"]
        assert page.evaluate("refused.splice(0)") == []
        reader.assert_no_errors()
        reader.open("licences/", live=False)
        page.evaluate(INTRUDE)
        assert page.evaluate("globalThis.ran") is None
        assert page.evaluate("getComputedStyle(document.body).visibility") == "visible"
        assert sorted({*page.evaluate("refused.splice(0)")}) == [
            "connect-src https://elsewhere.example/",
            "img-src https://elsewhere.example/one.png",
            "script-src-attr inline",
            "script-src-elem inline",
            "style-src-elem inline",
        ]


WATCH = """globalThis.refused = [];
document.addEventListener('securitypolicyviolation', (event) =>
  refused.push(`${event.effectiveDirective} ${event.blockedURI}`));"""
INTRUDE = """async () => {
  const put = (name, given) => {
    const element = Object.assign(document.createElement(name), given);
    document.body.append(element);
    return element;
  };
  put('script', {textContent: 'globalThis.ran = true'});
  put('style', {textContent: 'body { visibility: hidden }'});
  put('img', {src: 'https://elsewhere.example/one.png'});
  const button = put('button', {});
  button.setAttribute('onclick', 'globalThis.ran = true');
  button.click();
  await fetch('https://elsewhere.example/').catch(() => {});
  await new Promise((resolve) => setTimeout(resolve));
}"""


def test_scripts_in_the_head_have_their_integrity_hashes(built_site: Path) -> None:
    page = built_site / "lens-distortion" / "index.html"
    head = page.read_text(encoding="utf-8").partition("</head>")[0]
    named = dict(re.findall(r'(?:src|href)="([^"]+)" integrity="([^"]+)"', head))
    scripts = re.findall(r'<script type="module"[^>]* src="([^"]+)"', head)
    assert scripts
    assert {*scripts} <= {*named}
    for address, value in named.items():
        digest = hashlib.sha256((page.parent / address).read_bytes()).digest()
        assert value == f"sha256-{base64.b64encode(digest).decode()}", address
