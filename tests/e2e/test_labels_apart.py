"""Labels of figures at rest: apart from one another, inside their panels, beside the handles."""

from typing import Any

import pytest
from playwright.sync_api import ViewportSize
from support.reader import PHONE, Reader

pytestmark = pytest.mark.browser

WIDE: ViewportSize = {"width": 1440, "height": 900}
KNOWN = {
    "figure-perspective-projection top: x × (point)": "there the point is about to cross the plane",
}
"""What may touch, as it is listed, and why."""

TOUCHING = """async () => {
  await document.fonts.ready;
  const found = new Set();
  const box = (text) => {
    const {left, right, top, bottom} = text.getBoundingClientRect();
    const air = 0.2 * (bottom - top);
    return {left: left - 1, right: right + 1, top: top + air, bottom: bottom - air};
  };
  const overlap = (a, b) =>
    a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  for (const view of document.querySelectorAll('simulation-figure .panel-view')) {
    const panel = view.getBoundingClientRect();
    const of = `${view.closest('figure').id} ${view.closest('.panel').dataset.panel}: `;
    const texts = [...view.querySelectorAll('svg.overlay text')]
      .filter((text) => text.textContent.trim() && getComputedStyle(text).opacity !== '0')
      .map((text) => ({words: text.textContent, ...box(text)}));
    const marks = [...view.querySelectorAll('.handle:not(.drag, .aim, [hidden])')]
      .map((mark) => {
        const share = (name) => Number.parseFloat(mark.style.getPropertyValue(name)) / 100;
        const x = panel.left + share('--x') * panel.width;
        const y = panel.top + share('--y') * panel.height;
        return {words: `(${mark.dataset.handle})`,
                left: x - 10, right: x + 10, top: y - 10, bottom: y + 10};
      });
    texts.forEach((text, index) => {
      for (const other of [...texts.slice(index + 1), ...marks]) {
        if (overlap(text, other)) found.add(`${of}${text.words} × ${other.words}`);
      }
      if (text.left < panel.left - 2 || text.right > panel.right + 2 ||
          text.top < panel.top - 1 || text.bottom > panel.bottom + 1) {
        found.add(`${of}${text.words} is cut`);
      }
    });
  }
  return [...found];
}"""
"""Letters need a fifth of their line above and below them less than it has."""


@pytest.mark.parametrize("screen", [WIDE, PHONE], ids=["wide", "phone"])
def test_no_label_touches_another_a_handle_or_an_edge(
    plain_reader: Reader, book: Any, screen: ViewportSize
) -> None:
    plain_reader.page.set_viewport_size(screen)
    found = []
    for chapter in book["chapters"]:
        if chapter["simulations"]:
            plain_reader.open(chapter["url"], live=False)
            found += plain_reader.page.evaluate(TOUCHING)
    assert [one for one in found if one not in KNOWN] == []
