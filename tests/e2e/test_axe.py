"""axe-core finds nothing that shuts readers out: in both themes, wide and narrow, on every page
(in ``make test``, on one)."""

from collections.abc import Iterable
from importlib.resources import files
from typing import Any

import pytest
from playwright.sync_api import ViewportSize
from support.reader import DESK, PHONE, Reader

pytestmark = pytest.mark.browser

AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
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
"""That what scrolls is reached by keyboard, `test_every_page.py` asks of every page."""
NARROW = {
    "only": [
        *("aria-hidden-focus", "button-name", "color-contrast", "label"),
        *("nested-interactive", "select-name", "summary-name", "target-size"),
    ]
}
"""What may differ where other things are shown."""
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
"""Lists of text, the same on a phone."""


def violations(reader: Reader, scheme: Any, screen: ViewportSize, asked: Any) -> list[str]:
    """What is found on the page that is shown, in a light or dark theme."""
    page = reader.page
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")  # nothing half faded
    page.set_viewport_size(screen)
    if not page.evaluate("'axe' in globalThis"):
        page.evaluate(AXE)
    return list(page.evaluate(VIOLATIONS, asked))


@pytest.mark.deep
def test_no_page_shuts_readers_out(plain_reader: Reader, book: Any) -> None:
    urls = [chapter["url"] for chapter in book["chapters"]]
    assert_open_to_readers(plain_reader, ["", *OTHERS, *urls])
    plain_reader.turn_to(urls[-1], live=False)
    assert violations(plain_reader, "dark", DESK, CONTRAST) == [], "what no phone shows"


def test_a_chapter_shuts_no_reader_out(plain_reader: Reader) -> None:
    assert_open_to_readers(plain_reader, ["lens-distortion/"])


def assert_open_to_readers(plain_reader: Reader, addresses: Iterable[str]) -> None:
    for address in plain_reader.leaf_through(addresses):
        assert violations(plain_reader, "light", DESK, ALL) == [], address
        screen, asked = (DESK, CONTRAST) if address in OTHERS else (PHONE, NARROW)
        assert violations(plain_reader, "dark", screen, asked) == [], f"{address}, dark"


def test_a_live_figure_shuts_no_reader_out(visitor: Reader) -> None:
    visitor.turn_to("lens-distortion/")
    visitor.unfold(visitor.figure("lens-distortion"))
    assert violations(visitor, "light", DESK, {**ALL, "within": "simulation-figure"}) == []
    visitor.page.emulate_media(color_scheme="null", reduced_motion="null")
