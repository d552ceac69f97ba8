"""axe-core finds nothing that shuts readers out: in both themes, wide and narrow, on every page
(in ``make test``, on some)."""

from collections.abc import Iterable
from importlib.resources import files
from typing import Any

import pytest
from playwright.sync_api import ViewportSize
from support.reader import DESK, PHONE, Reader

pytestmark = pytest.mark.browser

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
PREPARE = """() => {
  // The rule of contrast is a slow one: what differs in nothing that it depends on is looked at
  // once, on the first page that has it. The words of drawings stand before what is drawn there.
  const seen = new Set();
  const groundOf = (element, known) => {
    if (!element) return '';
    if (!known.has(element)) {
      const {backgroundColor, backgroundImage, opacity, position} = getComputedStyle(element);
      const free = ['absolute', 'fixed', 'sticky'].includes(position) || element.matches('svg *');
      const name = free && element.getAttribute('class');
      const own = [backgroundColor, backgroundImage, opacity, name];
      const bare = own.join() === 'rgba(0, 0, 0, 0),none,1,false';
      const hides = backgroundColor.startsWith('rgb(') && opacity === '1' && !free;
      const behind = hides ? '' : groundOf(element.parentElement, known);
      known.set(element, bare ? behind : `${own} / ${behind}`);
    }
    return known.get(element);
  };
  const markNewTexts = () => {
    const known = new Map();
    for (const element of document.body.querySelectorAll('*')) {
      const {childNodes} = element;
      delete element.dataset.newText;
      if (![...childNodes].some((node) => node.nodeType === 3 && node.data.trim())) continue;
      if (!element.checkVisibility()) continue;
      const {color, fill, fontSize, fontWeight} = getComputedStyle(element);
      const kind = [color, fill, fontSize, fontWeight, groundOf(element, known)].join();
      if (!seen.has(kind)) element.dataset.newText = '';
      seen.add(kind);
    }
  };
  // So is the rule that links in a text are told from it: most of its work is to find what lies
  // behind each.
  const LOOKS = ['color', 'fontSize', 'fontWeight', 'fontStyle', 'fontFamily', 'borderBottom',
    'outline', 'textDecoration', 'verticalAlign'];
  const looksOf = (element) => {
    const style = getComputedStyle(element);
    return [element.getAttribute('class'), ...LOOKS.map((name) => style[name])].join();
  };
  const waysOut = (element) => getComputedStyle(element).display.startsWith('inline')
    ? [looksOf(element), ...waysOut(element.parentElement)] : [looksOf(element)];
  const markNewLinks = () => {
    const known = new Map();
    axe.setup(document);
    for (const link of document.body.querySelectorAll('a[href], [role=link]')) {
      delete link.dataset.newLink;
      if (!link.checkVisibility() || !axe.commons.dom.isInTextBlock(link)) continue;
      const kind = [...waysOut(link), groundOf(link, known)].join(' / ');
      if (!seen.has(kind)) link.dataset.newLink = '';
      seen.add(kind);
    }
    axe.teardown();
  };
  axe.configure({rules: [
    {id: 'color-contrast', selector: '[data-new-text]'},
    {id: 'link-in-text-block', selector: '[data-new-link]'},
  ]});
  globalThis.violations = async ({only, but}) => {
    await document.fonts.ready;
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    markNewTexts();
    if (!only) markNewLinks();
    const rules = Object.fromEntries((but ?? []).map((name) => [name, {enabled: false}]));
    const runOnly = only && {type: 'rule', values: only};
    const found = await axe.run(document, {resultTypes: ['violations'], rules, runOnly});
    return found.violations.filter(({impact}) => impact !== 'minor').map(({id, nodes}) =>
      `${id}: ${nodes.map(({html}) => html.slice(0, 160)).join(' ')}`);
  };
}"""
ALL = "violations({but: ['scrollable-region-focusable']})"
"""That what scrolls is reached by keyboard, `test_widths.py` asks of every page."""
NARROW = """violations({only: ['aria-hidden-focus', 'button-name', 'color-contrast', 'label',
  'nested-interactive', 'select-name', 'summary-name', 'target-size']})"""
"""What may differ where other things are shown."""
CONTRAST = "violations({only: ['color-contrast']})"
SAMPLE = ("", "lens-distortion/", "glossary/")
OTHERS = ("glossary/", "symbols/", "references/", "index-of-terms/", "lecture-plan/", "licences/")
"""Lists of text, the same on a phone."""


def violations(reader: Reader, scheme: Any, screen: ViewportSize, asked: str) -> list[str]:
    """What is found on the page that is shown, in a light or dark theme."""
    page = reader.page
    page.emulate_media(color_scheme=scheme)
    page.set_viewport_size(screen)
    if not page.evaluate("'axe' in globalThis"):
        page.evaluate(AXE)
        page.evaluate(PREPARE)
    return list(page.evaluate(asked))


@pytest.mark.deep
def test_no_page_shuts_readers_out(plain_reader: Reader, book: Any) -> None:
    urls = [chapter["url"] for chapter in book["chapters"]]
    assert_open_to_readers(plain_reader, ["", *urls, *OTHERS])
    plain_reader.turn_to(urls[-1], live=False)
    assert violations(plain_reader, "dark", DESK, CONTRAST) == [], "what no phone shows"


def test_pages_of_each_kind_shut_no_reader_out(plain_reader: Reader) -> None:
    assert_open_to_readers(plain_reader, SAMPLE)


def assert_open_to_readers(plain_reader: Reader, addresses: Iterable[str]) -> None:
    for address in plain_reader.leaf_through(addresses):
        assert violations(plain_reader, "light", DESK, ALL) == [], address
        screen, asked = (DESK, CONTRAST) if address in OTHERS else (PHONE, NARROW)
        assert violations(plain_reader, "dark", screen, asked) == [], f"{address}, dark"


def test_a_live_figure_shuts_no_reader_out(visitor: Reader) -> None:
    visitor.turn_to("lens-distortion/")
    visitor.unfold(visitor.figure("lens-distortion"))
    assert violations(visitor, "light", DESK, ALL) == []
    visitor.page.emulate_media(color_scheme="null")
