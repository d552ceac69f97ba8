"""TeX commands of an author's own, and quantities."""

from collections.abc import Callable
from xml.etree import ElementTree

import pytest
from support.little_book import OUTLINE, rendered

from site_builder.build import Options
from site_builder.markdown.text.math import UnsupportedTexError, to_mathml

MACROS = {
    "R": r"\mathbb{R}",
    "norm": r"\lVert #1 \rVert",
    "pair": "(#1, #2)",
    "deep": r"\norm{\R}",
    "loop": r"1 + \loop",
    "ray": r"\role{ray}{#1}",
}


@pytest.mark.parametrize(
    ("tex", "shown"),
    [
        (r"\R^n", "ℝn"),
        (r"\norm\alpha", "‖α‖"),
        (r"\pair a {b + c}", "(a,b+c)"),
        (r"\deep", "‖ℝ‖"),
        (r"\ray{x}", "x"),
        (r"\pu{1.5e-3 m s^-1}", "1.5⋅10−3ms−1"),
    ],
)
def test_macros_and_quantities_are_set(tex: str, shown: str) -> None:
    tree = ElementTree.fromstring(to_mathml(tex, display=False, macros=MACROS))
    assert "".join("".join(tree.itertext()).split()) == shown


@pytest.mark.parametrize(
    ("tex", "report"),
    [
        (r"\pair{x}", "cannot set"),
        (r"\loop", "too many expansions"),
        (r"1 \tag{a}", "legal: a label"),
        (r"\qty{1}{m}", r"legal: '\pu"),
    ],
)
def test_a_macro_that_cannot_be_set_is_refused(tex: str, report: str) -> None:
    with pytest.raises(UnsupportedTexError) as caught:
        to_mathml(tex, display=False, macros=MACROS)
    assert report in str(caught.value)


def test_a_book_s_macros_are_set_and_their_symbols_are_read(
    make_book: Callable[..., Options],
) -> None:
    body = "In $\\norm{\\mathbf{R}}$ it is.\n"
    files: dict[str, str | None] = {
        "content/book.toml": f"{OUTLINE}[macros]\nnorm = '\\lVert #1 \\rVert'\n",
        "content/symbols.toml": "[book]\n'\\mathbf{R}' = [\"rotation\"]\n",
    }
    page = rendered(make_book(body, files))["first/index.html"].decode()
    assert page.count("‖") == 2
