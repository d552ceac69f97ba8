"""What pages may run and load: all that the book is made of, under the strictest policy, and
nothing that found its way in."""

import base64
import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from support.host import hosting
from support.reader import Reader, visit

from site_builder.files.folders import integrity
from site_builder.pages.policy import ANYTHING_INLINE, FOR_TOOLS
from site_builder.publishing.hosting import common_policy

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
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
STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)
NAMED = re.compile(r'(?:src|href)="([^"]+)" integrity="([^"]+)"')


def refused(reader: Reader) -> list[str]:
    """What the policy has refused since this was last asked."""
    found: list[str] = reader.page.evaluate("refused.splice(0)")
    return found


def published_policy(site: Path) -> str:
    """Without the leave that pages at home give to tools."""
    pages = [page.read_bytes() for page in site.rglob("*.html")]
    styles = {style for page in pages for style in STYLE.findall(page.decode())}
    hashes = " ".join(sorted(f"'{integrity(style.encode())}'" for style in styles))
    lax = common_policy(pages)
    strict = lax.replace(f" {FOR_TOOLS}", "").replace(
        f"style-src 'self' {ANYTHING_INLINE}", f"style-src 'self' {hashes}"
    )
    assert len(strict) != len(lax)
    assert f"{ANYTHING_INLINE};" not in strict.replace("style-src-attr 'unsafe-inline';", "")
    return strict


@pytest.fixture(scope="module")
def guarded(brisk_chromium: Browser, built_site: Path) -> Iterator[Reader]:
    """Under the policy of the published book, sent as a header: that one holds workers."""
    header = {"/*": {"Content-Security-Policy": published_policy(built_site)}}
    with hosting(built_site, rules=header) as host, visit(brisk_chromium, host, WATCH) as someone:
        yield someone


def test_a_figure_comes_alive_and_its_python_opens_under_the_policy(guarded: Reader) -> None:
    guarded.open(CHAPTER, live=False)
    figure = guarded.page.locator("simulation-figure").first
    guarded.page.wait_for_selector("simulation-figure[data-state=live]", timeout=60_000)
    figure.locator(".open-python").click()
    figure.locator(".cm-editor .cm-line").first.wait_for()
    # As CodeMirror's own styles have it, which a policy may well refuse.
    scroller = figure.locator(".cm-scroller")
    assert scroller.evaluate("element => getComputedStyle(element).display") == "flex"
    assert refused(guarded) == []
    guarded.assert_no_complaints()


def test_formulae_need_no_more_of_their_face_than_the_book_uses(guarded: Reader) -> None:
    guarded.open(CHAPTER, live=False)
    guarded.page.evaluate("document.fonts.ready")
    names = guarded.page.evaluate(
        "performance.getEntriesByType('resource').map(({name}) => name.split('/').at(-1))"
    )
    assert [name for name in names if name.startswith("maths")] == ["maths.woff2"]


def test_what_found_its_way_into_a_page_neither_runs_nor_calls_anyone(guarded: Reader) -> None:
    guarded.open("licences/", live=False)
    guarded.page.evaluate(INTRUDE)
    assert guarded.page.evaluate("globalThis.ran") is None
    assert guarded.page.evaluate("getComputedStyle(document.body).visibility") == "visible"
    assert sorted(set(refused(guarded))) == [
        "connect-src https://elsewhere.example/",
        "img-src https://elsewhere.example/one.png",
        "script-src-attr inline",
        "script-src-elem inline",
        "style-src-elem inline",
    ]
    guarded.complaints.clear()


def test_scripts_that_heads_name_are_known_by_what_is_in_them(built_site: Path) -> None:
    page = built_site / CHAPTER / "index.html"
    head = page.read_text(encoding="utf-8").partition("</head>")[0]
    named = dict(NAMED.findall(head))
    scripts = re.findall(r'<script type="module"[^>]* src="([^"]+)"', head)
    assert scripts
    assert set(scripts) <= set(named)
    for address, told in named.items():
        digest = hashlib.sha256((page.parent / address).read_bytes()).digest()
        assert told == f"sha256-{base64.b64encode(digest).decode()}", address
