"""Formulae as the published book draws them, compared with what the whole font would draw."""

import base64
import io
from dataclasses import replace
from typing import Any

import cv2
import numpy as np
import pytest
from fontTools.ttLib import TTFont
from support.reader import Reader

from site_builder.markdown.text.math import to_mathml
from site_builder.output.font_faces import MATHS_FACES
from site_builder.output.fonts import cut, source_file

pytestmark = pytest.mark.browser

KINDS = {
    "root": r"\sqrt{\frac{a}{b} + \sqrt{2}}",
    "fraction": r"\frac{a + b}{1 - \frac{c}{d}}",
    "matrix": r"\begin{bmatrix} a & b \\ c & d \\ e & f \end{bmatrix}",
    "cases": r"\begin{cases} x & x > 0 \\ -x & \text{otherwise} \end{cases}",
    "overline": r"\overline{AB} + \bar{N}",
    "accents": r"\hat{\mathbf{n}} + \tilde{x} + \vec{v} + \dot{q}",
    "braces": r"\overbrace{a + b + c} + \underbrace{d + e}",
    "big operators": r"\sum \int \prod \frac{a}{b}",
    "fences": r"\left( \frac{a}{b} \right) + \left\{ \frac{e}{f} \right\}",
    "bars": r"\left\lVert \frac{c}{d} \right\rVert + \left| \frac{g}{h} \right|",
}

ROOTS = """() => [...document.querySelectorAll('msqrt')].filter((root) => root.offsetParent
  || root.getBoundingClientRect().width).map((root) => {
    const inside = [...root.children].map((child) => child.getBoundingClientRect());
    const width = Math.max(...inside.map((box) => box.right))
      - Math.min(...inside.map((box) => box.left));
    return {formula: root.textContent, sign: root.getBoundingClientRect().width - width,
      em: parseFloat(getComputedStyle(root).fontSize)};
  })"""

SHOW = """(markup) => {
  document.getElementById('kind')?.remove();
  const place = document.createElement('div');
  place.id = 'kind';
  place.style.cssText = 'position: fixed; inset: 0 auto auto 0; z-index: 99; padding: 20px;'
    + 'width: 400px; background: white; color: black; font-size: 32px';
  place.innerHTML = markup;
  document.body.append(place);
  return document.fonts.ready;
}"""

LOAD = """async (font) => {
  const bytes = Uint8Array.from(atob(font), (letter) => letter.charCodeAt(0));
  document.fonts.add(await new FontFace('Whole', bytes.buffer).load());
}"""


def whole_font() -> str:
    """With every character of its source, made by the same recipe."""
    source = source_file(MATHS_FACES[0]).read_bytes()
    every = frozenset(TTFont(io.BytesIO(source)).getBestCmap())
    return base64.b64encode(cut(replace(MATHS_FACES[0], characters=every), source)).decode()


def seen(reader: Reader) -> Any:
    picture = np.frombuffer(reader.page.locator("#kind").screenshot(), np.uint8)
    return cv2.imdecode(picture, cv2.IMREAD_GRAYSCALE)


def ink(picture: Any) -> float:
    """How many pixels' worth of black it holds."""
    return float(np.sum(1 - picture / 255.0))


@pytest.mark.deep
def test_every_root_of_the_book_has_its_sign(plain_reader: Reader, book: Any) -> None:
    roots = []
    for _ in plain_reader.leaf_through(chapter["url"] for chapter in book["chapters"]):
        roots += plain_reader.page.evaluate(ROOTS)
    assert roots
    assert [root for root in roots if root["sign"] < 0.5 * root["em"]] == []


def test_the_cut_faces_draw_formulae_as_the_whole_font_does(plain_reader: Reader) -> None:
    plain_reader.open("lecture-plan/", live=False)
    plain_reader.page.evaluate(LOAD, whole_font())
    for kind, formula in KINDS.items():
        plain_reader.page.evaluate(SHOW, to_mathml(formula, display=True))
        shown = seen(plain_reader)
        plain_reader.page.evaluate(
            "document.querySelector('#kind math').style.fontFamily = 'Whole'"
        )
        whole = seen(plain_reader)
        assert np.allclose(shown.shape, whole.shape, atol=2), kind
        assert ink(shown) == pytest.approx(ink(whole), rel=0.02), kind
