"""Accessibility of pages and live figures, checked by axe."""

from collections.abc import Iterable
from importlib.resources import files
from typing import Any

import pytest
from playwright.sync_api import ViewportSize
from support.reader import DESK, PHONE, Reader

pytestmark = pytest.mark.browser


AXE_CORE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
VIOLATIONS = """async ({only, but, within}) => {
  await document.fonts.ready;
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const rules = Object.fromEntries((but ?? []).map((name) => [name, {enabled: false}]));
  const runOnly = only && {type: 'rule', values: only};
  const found = await axe.run(within ?? document, {resultTypes: ['violations'], rules, runOnly});
  return found.violations.filter(({impact}) => impact !== 'minor').map(({id, nodes}) =>
    `${id}: ${nodes.map(({html}) => html.slice(0, 160)).join(' ')}`);
}"""
ALL = {"but": ["scrollable-region-focusable"]}
"""`OUT_OF_REACH` finds scrollable parts that the keyboard cannot reach."""
NARROW = {
    "only": [
        *("aria-hidden-focus", "button-name", "color-contrast", "label"),
        *("nested-interactive", "select-name", "summary-name", "target-size"),
    ]
}
"""Rules whose result may differ on a narrow screen."""
CONTRAST = {"only": ["color-contrast"]}
OTHERS = (
    "class/",  # which the title page alone links to
    "glossary/",
    "symbols/",
    "references/",
    "index-of-terms/",
    "lecture-plan/",
    "licences/",
)
"""Pages of plain lists, which are the same on a phone."""


def violations(reader: Reader, scheme: Any, screen: ViewportSize, rules: Any) -> list[str]:
    """Violations of axe's rules on the current page, in a light or dark theme."""
    page = reader.page
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")  # nothing half faded
    page.set_viewport_size(screen)
    if not page.evaluate("'axe' in globalThis"):
        page.evaluate(AXE_CORE)
    return list(page.evaluate(VIOLATIONS, rules))


@pytest.mark.deep
def test_every_page_passes_axe(plain_reader: Reader, book: Any) -> None:
    urls = [chapter["url"] for chapter in book["chapters"]]
    assert_accessible(plain_reader, ["", *OTHERS, *urls])
    plain_reader.turn_to(urls[-1], live=False)
    assert violations(plain_reader, "dark", DESK, CONTRAST) == [], "the desktop layout"


def test_chapter_passes_axe(plain_reader: Reader) -> None:
    assert_accessible(plain_reader, ["why-image-formation/"])


def assert_accessible(plain_reader: Reader, addresses: Iterable[str]) -> None:
    for address in plain_reader.open_each(addresses):
        assert violations(plain_reader, "light", DESK, ALL) == [], address
        screen, rules = (DESK, CONTRAST) if address in OTHERS else (PHONE, NARROW)
        assert violations(plain_reader, "dark", screen, rules) == [], f"{address}, dark"


def test_live_figure_passes_axe(visitor: Reader) -> None:
    visitor.turn_to("lens-distortion/")
    visitor.open_stage_report(visitor.figure("lens-distortion"))
    assert violations(visitor, "light", DESK, {**ALL, "within": "simulation-figure"}) == []
    visitor.page.emulate_media(color_scheme="null", reduced_motion="null")
