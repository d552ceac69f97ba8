"""TeX in Markdown: its MathML, its alternative text and its symbols."""

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from site_builder.document.places import passage
from site_builder.formulae.temml import UnsupportedTexError, to_mathml
from site_builder.languages.words import ENGLISH
from site_builder.markdown.parser import make_parser
from site_builder.markdown.text.symbols import covers, spelt, symbols_of
from site_builder.markdown.text.tokens import displayed_parts, glue_formulae
from site_builder.render.screen import screen_renderer

INVISIBLE = "[\u2061\u200b\u00a0\\s]"
MACROS = {
    "R": r"\mathbb{R}",
    "norm": r"\lVert #1 \rVert",
    "pair": "(#1, #2)",
    "deep": r"\norm{\R}",
    "ray": r"\role{ray}{#1}",
}


def tree(tex: str, *, display: bool = False) -> ElementTree.Element:
    return ElementTree.fromstring(to_mathml(tex, display=display, macros=MACROS))


@pytest.mark.parametrize(
    ("tex", "glyphs"),
    [
        (r"\text{% of light}", "%oflight"),
        (r"50\% \text{ of it} + 1", "50%ofit+1"),
        (r"\text{50\%}", "50%"),
        (r"\text{for $n$ only}", "fornonly"),
        (r"\boldsymbol{\omega} \mathbf{x} \mathbf x \mathbf{0}", "𝝎𝐱𝐱𝟎"),
        (r"5-2\text{mm}", "5−2mm"),
        (r"\ce{2 H2 + O2 -> 2 H2O}", "2H2+O2→2H2O"),
        (r"\R^n", "ℝn"),
        (r"\norm\alpha", "‖α‖"),
        (r"\pair a {b + c}", "(a,b+c)"),
        (r"\deep", "‖ℝ‖"),
        (r"\ray{x}", "x"),
        (r"\pu{1.5e-3 m s^-1}", "1.5⋅10−3ms−1"),
    ],
)
def test_formula_has_the_glyphs_that_tex_sets(tex: str, glyphs: str) -> None:
    assert re.sub(INVISIBLE, "", "".join(tree(tex).itertext())) == glyphs


@pytest.mark.parametrize("tex", ["1 := 2", r"P(A\mid B)", "a × b", "a ≤ b", "3 − 2"])
def test_operators_are_recognised_as_commands_and_as_characters(tex: str) -> None:
    assert {element.text for element in tree(tex).iter("mo")} & set(":=≔|×≤−")


@pytest.mark.parametrize(
    ("tex", "markup"),
    [
        (r"\boldsymbol{\nabla}", "font-weight:bold"),
        (r"\role{ray}{Z + 1}", 'class="role-ray"'),
        (r"f_3'^2", r"<msubsup>.*′.*2.*</msubsup>"),
    ],
)
def test_bold_roles_and_primes_have_their_mathml(tex: str, markup: str) -> None:
    assert re.search(markup, to_mathml(tex, display=False))


def test_array_rules_are_cell_borders_and_matrix_cells_have_no_style() -> None:
    cells = tree(r"\begin{array}{c|c} R & t \\ \hline 0 & 1 \end{array}").findall(".//mtd")
    styles = [cell.get("style", "") for cell in cells]
    assert ["border-right" in style for style in styles] == [True, False, True, False]
    assert ["border-bottom" in style for style in styles] == [True, True, False, False]
    cells = tree(r"\begin{bmatrix} a & b \\ c & d \end{bmatrix}").findall(".//mtd")
    assert [cell.get("style") for cell in cells] == [None] * 4


@pytest.mark.parametrize("tex", ["(-x)", "(40, -40)", "a = -b", "2 \\cdot -3", "[-1]"])
def test_minus_after_a_bracket_or_operator_is_a_sign(tex: str) -> None:
    assert [e.get("form") for e in tree(tex).iter("mo") if e.text == "−"] == ["prefix"]


@given(st.text(alphabet="\\{}<>&\"'ab1^_ $%#~frac", max_size=20))
def test_html_in_a_formula_does_not_become_markup(tex: str) -> None:
    try:
        found = tree(tex)
    except UnsupportedTexError:
        return
    assert not {element.tag for element in found.iter()} & {"script", "a", "b", "f"}


ALTERNATIVE_TEXTS = [
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
    (r"p(x \mid y)", "p of open paren x given y close paren"),
    ("p(x|y)", "p of open paren x given y close paren"),
    (r"[R \mid \mathbf{t}]", "open bracket cap R augmented by bold t close bracket"),
    (r"\{x \mid x > 0\}", "open brace x such that x is greater than 0 close brace"),
    ("|x|", "the absolute value of x end absolute value"),
    (r"|\mathbf{a}|b", "the norm of bold a end norm times b"),
    (r"\lVert v \rVert", "the norm of v end norm"),
    (r"|\mathbf{a} \cdot b|", "the absolute value of bold a dot b end absolute value"),
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
    (
        r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix} x",
        "the 2 by 2 matrix Row 1: 1 0 Row 2: 0 1 end matrix times x",
    ),
    (
        r"\begin{aligned} a &= b , \\ &= 1. \end{aligned}",
        "2 lines Line 1: a equals b Line 2: equals 1",
    ),
    (r"\begin{aligned} a &= b \end{aligned}", "a equals b"),
    (r"\lfloor x \rfloor + \lceil y \rceil", "the floor of x plus the ceiling of y"),
    (r"n = \lceil 2 r \rceil + 1", "n equals the ceiling of 2 r plus 1"),
    (r"\lfloor 3.7 \rfloor", "the floor of 3.7"),
    (r"\left\lfloor \frac{x}{2} \right\rfloor", "the floor of x over 2 end floor"),
    (r"\langle x y \rangle", "left angle bracket x y right angle bracket"),
    (r"\langle u, v \rangle", "left angle bracket u comma v right angle bracket"),
    ("[A]", "open bracket cap A close bracket"),
    ("2 (x) + (a)(b)", "2 times x plus a times b"),
    (r"\binom{n}{k} + \dbinom{2n}{2}", "n choose k plus 2 n choose 2"),
    (r"A^T \mathbf{b}^{\mathsf T}", "cap A transpose bold b transpose"),
    ("(A B)^T", "cap A cap B transpose"),
    (r"f(x)\big|_{x=0}", "f of x at x equals 0"),
    (r"\left.\frac{df}{dx}\right|_{x=0}", "d f over d x at x equals 0"),
    (r"g\big|_{(0,1)}", "g at open paren 0 comma 1 close paren"),
    (r"F\big|_a^b", "cap F from a to b"),
    (r"x \% 2 + 50\%", "x percent 2 plus 50 percent"),
    (r"\|x\|", "the norm of x end norm"),
    ("(0,4)", "open paren 0 comma 4 close paren"),
    ("[0,1)", "open bracket 0 comma 1 close paren"),
    (r"x \in [0,255]", "x is a member of open bracket 0 comma 255 close bracket"),
    ("(2,3,4)", "open paren 2 comma 3 comma 4 close paren"),
    ("x_{1,2}", "x sub 1 comma 2"),
    (r"a \bmod b", "a mod b"),
    (r"\sum_{i=1}^n x_i", "the sum from i equals 1 to n of x sub i"),
    (r"\{1,2\}", "the set 1 comma 2"),
    (r"f: A \to B", "f colon cap A goes to cap B"),
    (r"\lceil \log_2 n \rceil", "the ceiling of the log base 2 of n"),
]


@pytest.mark.parametrize(("tex", "text"), ALTERNATIVE_TEXTS)
def test_alternative_text_reads_the_formula_aloud(tex: str, text: str) -> None:
    assert tree(tex, display=True).get("alttext") == text


def test_alternative_text_is_escaped_and_exists_only_in_english() -> None:
    assert tree(r"\text{a ``$<$'' b \& c}").get("alttext")
    assert "alttext" not in to_mathml("x", display=True, language="de")


def with_no_break_spans(text: str) -> str:
    """The paragraph with ``⟨…⟩`` around text that does not break, and ``~`` for no-break spaces."""
    parser = make_parser()
    tokens = parser.parse(text)
    for block in tokens:
        for child in block.children or ():
            if child.type == "math_inline":
                child.meta["mathml"] = f"<math>{child.content}</math>"
    glue_formulae(tokens)
    html = screen_renderer(ENGLISH)(passage(tokens))
    kept = re.sub("<span[^>]*>(.*?)</span>", r"⟨\1⟩", html)
    return re.sub("</?(?:p|math)>", "", kept).replace("\u00a0", "~")


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("At $x$, it", "At ⟨x,⟩ it"),
        ("Is it $x$?", "Is it ⟨x?⟩"),
        ("So ($x$) is", "So ⟨(x)⟩ is"),
        ("$x$\u00a0m away", "⟨x~m⟩ away"),
        ("$x$ mm.", "⟨x~mm⟩."),
        ("$x$ more", "x more"),
        ("A $x$ or $y$.", "A x or ⟨y.⟩"),
        ("Then $x$ (of $y$ too)", "Then x (of y too)"),
        ("$x$> y", "⟨x&gt;⟩ y"),
        (f"${'x + ' * 10}x$ mm", f"{'x + ' * 10}x mm"),
        (f"${'x + ' * 10}x$, and", f"⟨{'x + ' * 10}x,⟩ and"),
    ],
)
def test_punctuation_brackets_and_units_stay_on_the_formula_line(
    source: str, expected: str
) -> None:
    assert with_no_break_spans(source) == expected


@pytest.mark.parametrize(
    ("tex", "parts"),
    [
        (r"x = 1", ["x = 1"]),
        (r"x = 1 \qquad y = 2", ["x = 1", "y = 2"]),
        (r"\text{a \qquad b} \qquad c", [r"\text{a \qquad b}", "c"]),
        (r"\begin{a} a &\qquad b \end{a}", [r"\begin{a} a &\qquad b \end{a}"]),
        (r"\left( a \qquad b \right) \qquad \{ c", [r"\left( a \qquad b \right)", r"\{ c"]),
        (r"x \qquad", ["x"]),
    ],
)
def test_displayed_row_is_split_only_at_wide_spaces_outside_braces(
    tex: str, parts: list[str]
) -> None:
    assert displayed_parts(tex) == parts


@pytest.mark.parametrize(
    ("tex", "symbols"),
    [
        (r"r_d = r\,(1 + k_1 r^2)", ["r_{d}", "r", "k_{1}", "r"]),
        (r"\mathbf{x}' \sim \hat{\mathbf n}_0 + \bar x", [r"\mathbf{x}", None, r"\bar{x}"]),
        (r"r_{\text{fold}} \cos\theta \text{ or } r_{n+1}", ["r_{«fold»}", r"\theta", "r_{n+1}"]),
        (r"\mathrm{SNR}_w + \role{image}{x} + \max y", ["x", "y"]),
        (r"\int E\,\mathrm{d}\lambda + \int L\,d\omega", ["E", r"\lambda", "L", r"\omega"]),
        (r"\begin{bmatrix} f_x & 0 \end{bmatrix} \dots", ["f_{x}"]),
        (r"\Delta E \ell", [r"\DeltaE", r"\ell"]),
        (r"\mathrm ds + \frac{ds}{dt} A^{\mathsf T}", ["s", "s", "t", "A"]),
    ],
)
def test_symbols_of_a_formula_are_found(tex: str, symbols: list[str | None]) -> None:
    for found, wanted in zip(symbols_of(tex), symbols, strict=True):
        assert wanted is None or found.replace(" ", "") == wanted


@pytest.mark.parametrize(
    ("declared", "symbol", "covered"),
    [
        ("h_{11}", "h_{32}", True),
        ("t_x", "t_y", True),
        ("x", "x_0", True),
        (r"\mathbf{n}", "n_x", True),
        ("f_x", "f", False),
        ("z_s", "z_t", False),
        ("x", "y", False),
    ],
)
def test_declared_symbol_covers_symbols_that_differ_only_in_numbers(
    declared: str, symbol: str, covered: bool
) -> None:
    assert covers(spelt(declared), spelt(symbol)) is covered
