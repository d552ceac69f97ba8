"""Stops and units stay on the line of their formula; a row parts where its author says."""

import pytest

from site_builder.document.passage import passage
from site_builder.languages.words import ENGLISH
from site_builder.markdown.parser import make_parser
from site_builder.markdown.text.formula_breaks import displayed_parts, glue_formulae
from site_builder.render.screen import screen_renderer


def glued(text: str) -> str:
    parser = make_parser()
    tokens = parser.parse(text)
    for block in tokens:
        for child in block.children or ():
            if child.type == "math_inline":
                child.meta["mathml"] = f"<math>{child.content}</math>"
    glue_formulae(tokens)
    return screen_renderer(ENGLISH)(passage(tokens))


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("At $x$, it", '<p>At <span class="nowrap"><math>x</math>,</span> it</p>'),
        ("Is it $x$?", '<p>Is it <span class="nowrap"><math>x</math>?</span></p>'),
        ("So ($x$) is", '<p>So <span class="nowrap">(<math>x</math>)</span> is</p>'),
        ("$x$\u00a0m away", '<p><span class="nowrap"><math>x</math>\u00a0m</span> away</p>'),
        ("$x$ mm.", '<p><span class="nowrap"><math>x</math>\u00a0mm</span>.</p>'),
        ("$x$ more", "<p><math>x</math> more</p>"),
        ("A $x$ or $y$.", '<p>A <math>x</math> or <span class="nowrap"><math>y</math>.</span></p>'),
        ("Then $x$ (of $y$ too)", "<p>Then <math>x</math> (of <math>y</math> too)</p>"),
    ],
)  # fmt: skip
def test_closing_marks_brackets_and_units_stay_with_the_formula(source: str, expected: str) -> None:
    assert glued(source) == expected


def test_a_long_formula_keeps_its_stop_and_lets_its_unit_go() -> None:
    formula = "x + " * 10 + "x"
    assert glued(f"${formula}$ mm") == f"<p><math>{formula}</math> mm</p>"
    assert ",</span>" in glued(f"${formula}$, and")


def test_characters_that_mean_something_in_html_are_escaped() -> None:
    assert "&gt;" in glued("$x$> y")


@pytest.mark.parametrize(
    ("tex", "parts"),
    [
        (r"x = 1", ["x = 1"]),
        (r"x = 1 \qquad y = 2", ["x = 1", "y = 2"]),
        (r"\text{a \qquad b} \qquad c", [r"\text{a \qquad b}", "c"]),
        (
            r"\begin{aligned} a &\qquad b \end{aligned}",
            [r"\begin{aligned} a &\qquad b \end{aligned}"],
        ),
        (r"\left( a \qquad b \right) \qquad \{ c", [r"\left( a \qquad b \right)", r"\{ c"]),
        (r"x \qquad", ["x"]),
    ],
)
def test_a_row_parts_only_at_wide_spaces_outside_of_braces_and_environments(
    tex: str, parts: list[str]
) -> None:
    assert displayed_parts(tex) == parts
