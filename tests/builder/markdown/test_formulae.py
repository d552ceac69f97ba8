"""TeX to MathML: what authors write is set as TeX would set it, what cannot be set is refused."""

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from site_builder.markdown.text.math import UnsupportedTexError, to_mathml

UNSEEN = "[\u2061\u200b\u00a0\\s]"


def tree(tex: str, *, display: bool = False) -> ElementTree.Element:
    return ElementTree.fromstring(to_mathml(tex, display=display))


def letters(tex: str) -> str:
    """What a reader sees of a formula, in one line."""
    return re.sub(UNSEEN, "", "".join(tree(tex).itertext()))


@pytest.mark.parametrize(
    ("tex", "shown"),
    [
        (r"\|v\|", "‖v‖"),
        (r"\text{% of light}", "%oflight"),
        (r"50\% \text{ of it} + 1", "50%ofit+1"),
        (r"\text{50\%}", "50%"),
        (r"\operatorname{atan2}(1,2)", "atan2(1,2)"),
        (r"\operatorname{arg\,max}_1 2", "argmax12"),
        (r"\begin{bmatrix}1\\[4pt] 2\end{bmatrix}", "[12]"),
        (r"\text{for $n$ only}", "fornonly"),
        (r"\mathbb{RP}", "ℝℙ"),
        (r"\mathfrak{so}(3)", "𝔰𝔬(3)"),
        (r"\mathsf{SE}", "𝖲𝖤"),
        (r"\mathbb{1}", "𝟙"),
        (r"\boldsymbol{\phi}", "𝝓"),
        (r"\boldsymbol{\omega} \mathbf{x} \mathbf x \mathbf{0}", "𝝎𝐱𝐱𝟎"),
        (r"5-2\text{mm}", "5−2mm"),
        (
            r"30^\circ \approx 0.52\,\mathrm{rad} \to \sqrt[3]{\lfloor x \rfloor}",
            "30∘≈0.52rad→⌊x⌋3",
        ),
        (r"\ce{2 H2 + O2 -> 2 H2O}", "2H2+O2→2H2O"),
    ],
)
def test_a_formula_shows_what_tex_shows(tex: str, shown: str) -> None:
    assert letters(tex) == shown


@pytest.mark.parametrize("tex", ["1 := 2", r"P(A\mid B)", "a × b", "a ≤ b", "3 − 2"])
def test_a_relation_or_an_operator_is_one_however_it_was_typed(tex: str) -> None:
    signs = [element.text for element in tree(tex).iter("mo")]
    assert set(signs) & set(":=≔|×≤−")


def test_a_prime_shares_its_place_with_an_exponent() -> None:
    (scripts,) = tree("f_3'^2").iter("msubsup")
    assert "".join(scripts[2].itertext()) == "′2"


@pytest.mark.parametrize(
    ("tex", "drawn"),
    [(r"\boxed{1}", "border"), (r"\cancel{2}", "cancel"), (r"\overline{ABCDEF}", "overline")],
)
def test_what_surrounds_or_crosses_a_part_is_drawn(tex: str, drawn: str) -> None:
    assert drawn in to_mathml(tex, display=False)


def test_a_bold_sign_without_a_bold_character_is_bold_by_its_style() -> None:
    assert "font-weight:bold" in to_mathml(r"\boldsymbol{\nabla}", display=False)


def test_a_line_of_an_array_is_a_border() -> None:
    cells = tree(r"\begin{array}{c|c} R & t \\ \hline 0 & 1 \end{array}").findall(".//mtd")
    styles = [cell.get("style", "") for cell in cells]
    assert ["border-right" in style for style in styles] == [True, False, True, False]
    assert ["border-bottom" in style for style in styles] == [True, True, False, False]


def test_a_role_colours_a_part_of_a_formula() -> None:
    ray = tree(r"\role{ray}{Z + 1}").find(".//*[@class='role-ray']")
    assert ray is not None
    assert "".join(ray.itertext()) == "Z+1"


def test_aligned_equations_meet_at_the_sign_between_their_columns() -> None:
    first, second = tree(r"\begin{aligned} a &= b \\ &= c \end{aligned}").findall(".//mtr")
    assert [cell.get("class") for cell in first] == ["tml-right", "tml-left"]
    assert "".join(second[1].itertext()) == "=c"


def test_columns_of_a_matrix_are_spaced_by_the_style_sheet() -> None:
    cells = tree(r"\begin{bmatrix} a & b \\ c & d \end{bmatrix}").findall(".//mtd")
    assert [cell.get("style") for cell in cells] == [None] * 4


def test_limits_of_max_stand_below_it_in_display() -> None:
    assert tree(r"\max_{x} f", display=True).find(".//munder") is not None
    assert tree(r"\max_{x} f").find(".//munder") is None


@pytest.mark.parametrize("tex", ["(-x)", "(40, -40)", "a = -b", "2 \\cdot -3", "[-1]"])
def test_a_minus_after_an_opening_or_an_operator_is_a_sign(tex: str) -> None:
    assert [e.get("form") for e in tree(tex).iter("mo") if e.text == "−"] == ["prefix"]


@pytest.mark.parametrize(
    ("tex", "reason"),
    [
        (r"a}b{", "expected its end, got '}'"),
        ("a^", "is missing"),
        (r"\begin{bmatrix} a", r"\end"),
        (r"\class{other}{x}", r"\class"),
        (r"\ce{H2O{}", "cannot set"),
    ],
)
def test_what_cannot_be_set_is_refused_with_the_reason(tex: str, reason: str) -> None:
    with pytest.raises(UnsupportedTexError) as raised:
        to_mathml(tex, display=False)
    assert reason in str(raised.value)


@given(st.text(alphabet="\\{}<>&\"'ab1^_ $%#~frac", max_size=20))
def test_no_formula_holds_markup_of_its_author_s(tex: str) -> None:
    try:
        found = tree(tex)
    except UnsupportedTexError:
        return
    assert not {element.tag for element in found.iter()} & {"script", "a", "b", "f"}
