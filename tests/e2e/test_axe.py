"""axe-core finds nothing that shuts readers out: on every page, in both themes, wide and narrow."""

from importlib.resources import files
from typing import Any

import pytest
from support.reader import DESK, PHONE, Reader

pytestmark = pytest.mark.browser

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
PREPARE = """() => {
  // The rule of contrast is a slow one: what differs in nothing that it depends on is looked at
  // once, on the first page that has it.
  const kindOf = (element) => {
    const {color, fontSize, fontWeight} = getComputedStyle(element);
    const around = [element, element.parentElement, element.closest('section, figure, form, nav')];
    const classes = around.map((one) => one && `${one.tagName}.${one.getAttribute('class')}`);
    return [...classes, color, fontSize, fontWeight].join();
  };
  globalThis.newTexts = () => {
    const found = new Set();
    for (const element of document.body.querySelectorAll('*')) {
      const {childNodes} = element;
      if (![...childNodes].some((node) => node.nodeType === 3 && node.data.trim())) continue;
      const kind = kindOf(element);
      if (!sessionStorage.getItem(kind)) found.add(element);
      sessionStorage.setItem(kind, 'seen');
    }
    return found.size > 0 ? [...found] : [document.querySelector('h1')];
  };
  globalThis.violations = async (context, {only, but}) => {
    await document.fonts.ready;
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const rules = Object.fromEntries((but ?? []).map((name) => [name, {enabled: false}]));
    const runOnly = only && {type: 'rule', values: only};
    const found = await axe.run(context, {resultTypes: ['violations'], rules, runOnly});
    return found.violations.filter(({impact}) => impact !== 'minor').map(({id, nodes}) =>
      `${id}: ${nodes.map(({html}) => html.slice(0, 160)).join(' ')}`);
  };
}"""
ALL = "violations(document, {but: ['color-contrast', 'scrollable-region-focusable']})"
SCROLLING = "violations(document, {only: ['scrollable-region-focusable']})"
"""By itself, as the answers of other rules mislead it: it then counts a pixel as too much."""
CONTRAST = "violations({include: newTexts()}, {only: ['color-contrast']})"
NARROW = """violations(document, {only: ['aria-hidden-focus', 'button-name', 'label',
  'nested-interactive', 'select-name', 'summary-name', 'target-size']})"""
"""What may differ where other things are shown."""
OTHERS = ("glossary/", "symbols/", "references/", "index-of-terms/", "lecture-plan/", "licences/")
"""Lists of text, the same on a phone."""


def violations(reader: Reader, scheme: Any, *kinds: str) -> list[str]:
    """What is found of these kinds on the page that is shown, in a light or dark theme."""
    page = reader.page
    page.emulate_media(color_scheme=scheme)
    if not page.evaluate("'axe' in globalThis"):
        page.evaluate(AXE)
        page.evaluate(PREPARE)
    return [found for kind in kinds for found in page.evaluate(kind)]


def test_no_page_shuts_readers_out(plain_reader: Reader, book: Any) -> None:
    for address in ("", *(chapter["url"] for chapter in book["chapters"]), *OTHERS):
        plain_reader.page.set_viewport_size(DESK)
        plain_reader.open(address, live=False)
        assert violations(plain_reader, "light", ALL, SCROLLING, CONTRAST) == [], address
        assert violations(plain_reader, "dark", CONTRAST) == [], f"{address}, dark"
        if address in OTHERS:
            continue
        plain_reader.page.set_viewport_size(PHONE)
        assert violations(plain_reader, "dark", NARROW, SCROLLING) == [], f"{address}, on a phone"


def test_a_live_figure_shuts_no_reader_out(visitor: Reader) -> None:
    visitor.turn_to("lens-distortion/")
    visitor.unfold(visitor.figure("lens-distortion"))
    assert violations(visitor, "light", ALL, CONTRAST) == []
    visitor.page.emulate_media(color_scheme="null")
