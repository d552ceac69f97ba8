"""TeX to MathML: what authors write is set rightly, what cannot be set is refused."""

from xml.etree import ElementTree

import pytest

from site_builder.markdown.text.math import UnsupportedTexError, to_mathml


def tree(tex: str, *, display: bool = False) -> ElementTree.Element:
    return ElementTree.fromstring(to_mathml(tex, display=display))


def words(tex: str) -> str:
    return "".join(tree(tex).itertext())


@pytest.mark.parametrize(
    "tex",
    [
        r"\operatorname{rank}(A)",
        r"\begin{bmatrix} a & b \\ c & d \end{bmatrix}",
        r"\begin{aligned} a &= b \\ &= c \end{aligned}",
        r"\begin{cases} 1 & x > 0 \\ 0 & \text{otherwise} \end{cases}",
        r"\mathbf{K} [\mathbf{R} \mid \mathbf{t}] \tilde{\mathbf{X}}",
        r"\lVert x \rVert \le \tfrac{1}{2} \ne \infty",
        r"I = \rho \max(0, \hat{\mathbf n} \cdot \hat{\mathbf l})",
        r"x'_1 \in \mathbb{R}^3, \quad f_{\text{sample}} \ge 2 f_{\max}",
        r"\left[\begin{array}{c|c} R & t \\ 0 & 1 \end{array}\right]",
        r"30^\circ \approx 0.52\,\mathrm{rad} \to \sqrt[3]{\lfloor x \rfloor}",
    ],
)
def test_common_tex_leaves_neither_backslashes_nor_ampersands(tex: str) -> None:
    assert not set(words(tex)) & set("\\&")


def test_a_role_colours_a_part_of_a_formula() -> None:
    row = tree(r"\role{ray}{Z} + 1").find(".//mrow[@class='role-ray']")
    assert row is not None
    assert "".join(row.itertext()) == "Z"


def test_aligned_equations_are_rows_of_a_table_with_closed_columns() -> None:
    table = tree(r"\begin{aligned} a &= b \\ &= c \end{aligned}").find(".//mtable")
    assert table is not None
    assert len(table.findall("mtr")) == 2
    assert table[0][0].get("style") == "text-align:right;padding-inline:0"


def test_brackets_of_a_matrix_have_a_row_of_their_own() -> None:
    formula = tree(r"A = \begin{bmatrix} 1 \\ 2 \end{bmatrix} b")
    row = next(row for row in formula.iter("mrow") if row.find("mtable") is not None)
    assert "".join(child.text or "" for child in row if child.tag == "mo") == "[]"
    assert len(row) == 3


def test_bold_symbols_become_the_characters_for_them() -> None:
    assert words(r"\boldsymbol{\omega} \mathbf{x} \mathbf x \mathbf{0}") == "𝝎𝐱𝐱𝟎"


def test_upright_letters_are_merged_into_a_word() -> None:
    assert [item.text for item in tree(r"\mathrm{SNR}").iter("mi")] == ["SNR"]


def test_limits_of_max_stand_below_it_in_display() -> None:
    assert tree(r"\max_{x} f", display=True).find(".//munder") is not None
    assert tree(r"\max_{x} f").find(".//munder") is None


@pytest.mark.parametrize(
    ("tex", "reason"),
    [
        (r"\foo{x}", r"unsupported TeX command '\foo'"),
        (r"a \nonumber", r"unsupported TeX command '\nonumber'"),
        (r"\frac{a", "unbalanced braces"),
        (r"a}b{", "unbalanced braces"),
        (r"\frac{a}", "is missing"),
        ("a^", "cannot set"),
        ("a & b", "'&' outside of a table"),
        (r"\begin{bmatrix} a", "do not match"),
        (r"\role{mauve}{x}", "unknown colour role 'mauve'"),
    ],
)
def test_what_cannot_be_set_is_refused_with_the_reason(tex: str, reason: str) -> None:
    with pytest.raises(UnsupportedTexError) as raised:
        to_mathml(tex, display=False)
    assert reason in str(raised.value)
