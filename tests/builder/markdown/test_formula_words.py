"""Formulae in words, as ``alttext``: what a listener hears is what a reader sees."""

from xml.etree import ElementTree

import pytest

from site_builder.markdown.text.math import to_mathml
from site_builder.render.screen import named


def words(tex: str, language: str = "en") -> str | None:
    return ElementTree.fromstring(to_mathml(tex, display=True, language=language)).get("alttext")


@pytest.mark.parametrize(
    ("tex", "said"),
    [
        (r"R^\top K^{-\top} H^{-1}", "cap R transpose cap K inverse transpose cap H inverse"),
        (r"(u, v, 1)^\top", "open paren u comma v comma 1 close paren transpose"),
        (r"\mathbf{d}'^\top", "bold d prime transpose"),
        (r"\mathbf{q}^*", "bold q conjugate"),
        (r"x^{-1} + r'^2", "x to the negative 1 power plus r prime squared"),
        (r"\cos 60^\circ", "the cosine of 60 degrees"),
        (r"10\,000 + 3\,\mathrm{m}", "10000 plus 3 metres"),
        (r"0.017\,m", "0.017 m"),
        (r"a_{12} + x_{10}", "a sub 1 2 plus x sub 10"),
        (r"\hat{\mathbf{n}} + \bar N + \vec{v}", "bold n hat plus cap N bar plus v vector"),
        (r"\Delta d \approx \lambda", "cap Delta d is approximately lambda"),
        (r"\ln x \sim \mathrm{d}\omega", "natural log x is proportional to d omega"),
    ],
)
def test_signs_have_the_words_of_the_field(tex: str, said: str) -> None:
    assert words(tex) == said


@pytest.mark.parametrize(
    ("tex", "said"),
    [
        (r"p(x \mid y)", "p of open paren x given y close paren"),
        ("p(x|y)", "p of open paren x given y close paren"),
        (r"[R \mid \mathbf{t}]", "open bracket cap R augmented by bold t close bracket"),
        (r"\{x \mid x > 0\}", "open brace x such that x is greater than 0 close brace"),
        ("|x|", "the absolute value of x end absolute value"),
        (r"|\mathbf{a}||b|", "the norm of bold a end norm times the absolute value of b end "
         "absolute value"),
        (r"\lVert v \rVert", "the norm of v end norm"),
        (r"|\mathbf{a} \cdot \mathbf{b}|", "the absolute value of bold a dot bold b end absolute "
         "value"),
    ],
)  # fmt: skip
def test_a_bar_is_said_by_what_it_means(tex: str, said: str) -> None:
    assert words(tex) == said


@pytest.mark.parametrize(
    ("tex", "said"),
    [
        (r"\mathbf{a} \times \mathbf{b}", "bold a cross bold b"),
        (r"[\mathbf{t}]_\times R", "open bracket bold t close bracket sub cross times cap R"),
        (r"(1, 2) \times 3", "open paren 1 comma 2 close paren cross 3"),
        (r"4 \times 4 \cdot 2", "4 times 4 times 2"),
        (r"\mathbf{n} \cdot K^{-1}\mathbf{x}", "bold n dot cap K inverse bold x"),
        ("fX + h_{31}x", "f cap X plus h sub 3 1 x"),
        ("h/R", "h divided by cap R"),
        ("g(r) + f'(x)", "g of r plus f prime of x"),
        (r"f\,(X - b)", "f times open paren cap X minus b close paren"),
        (r"\mathrm{atan2}(y, x)", "atan 2 of open paren y comma x close paren"),
    ],
)
def test_products_and_functions_are_told_apart(tex: str, said: str) -> None:
    assert words(tex) == said


def test_a_matrix_says_where_it_ends() -> None:
    matrix = r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix} x"
    assert words(matrix) == "the 2 by 2 matrix Row 1: 1 0 Row 2: 0 1 end matrix times x"


def test_lines_say_nothing_of_the_cells_and_stops_that_set_them() -> None:
    lines = r"\begin{aligned} a &= b , \\ &= 1. \end{aligned}"
    assert words(lines) == "2 lines Line 1: a equals b Line 2: equals 1"
    assert words(r"\begin{aligned} a &= b \end{aligned}") == "a equals b"


def test_words_are_escaped_and_only_english() -> None:
    assert words(r"\text{a ``$<$'' b \& c}")
    assert words("x", language="de") is None


def test_a_formula_in_a_name_is_its_label() -> None:
    assert named('<math alttext="x">') == '<math aria-label="x" alttext="x">'
