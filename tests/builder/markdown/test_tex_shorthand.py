"""Macros and units are written out as TeX, or are mistakes with their place."""

from collections.abc import Callable
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from site_builder.build import Options, render_site
from site_builder.markdown.text.macros import expanded, faults_of
from site_builder.markdown.text.math import UnsupportedTexError, to_mathml
from site_builder.markdown.text.shorthand import written_out
from site_builder.markdown.text.units import with_units
from site_builder.output.assets import content_bytes

type Find = Callable[..., list[str]]
type MakeBook = Callable[..., Options]

MACROS = {"R": r"\mathbb{R}", "norm": r"\lVert #1 \rVert", "pair": "(#1, #2)", "deep": r"\norm{\R}"}
OUTLINE = """\
title = "T"
subtitle = "S"
prerequisites = "P"
chapters = ["00-first", "01-second"]

[macros]
"""


def letters(tex: str) -> str:
    """What a reader sees of a formula, in one line."""
    tree = ElementTree.fromstring(to_mathml(tex, display=False))
    return "".join(tree.itertext()).replace(" ", "")


@pytest.mark.parametrize(
    ("tex", "written"),
    [
        (r"\R^n", r"{\mathbb{R}}^n"),
        (r"\norm{x}_2", r"{\lVert x \rVert}_2"),
        (r"\norm\alpha", r"{\lVert \alpha \rVert}"),
        (r"\pair a {b + c}", "{(a, b + c)}"),
        (r"\deep", r"{{\lVert {\mathbb{R}} \rVert}}"),
        (r"\Rx \Re", r"\Rx \Re"),
        (r"\pair{#2}{x}", "{(#2, x)}"),
    ],
)
def test_a_macro_is_written_out(tex: str, written: str) -> None:
    assert expanded(tex, MACROS) == written


def test_a_macro_without_its_arguments_is_refused() -> None:
    with pytest.raises(UnsupportedTexError, match="takes 2 arguments, 1 given"):
        expanded(r"\pair{x}", MACROS)


def test_a_macro_that_doubles_and_doubles_comes_to_an_end() -> None:
    macros = {"a": "x" * 20}
    for one, next_one in zip("abcdefgh", "bcdefghi", strict=True):
        macros[next_one] = rf"\{one}\{one}\{one}"
    with pytest.raises(UnsupportedTexError, match="10000 characters"):
        expanded(r"\i", macros)


@pytest.mark.parametrize(
    ("line", "report"),
    [
        (r"R2 = '\mathbb{R}'", "is no name"),
        (r"'\R' = '\mathbb{R}'", "is no name"),
        (r"qty = 'q'", "is a command of the book"),
        (r"norm = '|#2|'", "takes #2 but no #1"),
        (r"norm = '{#1'", "unbalanced braces"),
        (r"norm = ''", "stands for nothing"),
    ],
)
def test_a_macro_that_cannot_be_is_reported_at_its_line(
    mistakes: Find, line: str, report: str
) -> None:
    (found,) = mistakes(files={"content/book.toml": f"{OUTLINE}Z = '\\mathbb{{Z}}'\n{line}\n"})
    assert found.startswith("content/book.toml:8: macro "), found
    assert report in found


def test_macros_that_go_round_in_circles_are_reported() -> None:
    macros = {"a": r"\b", "b": r"\a", "c": r"1 + \c", "d": "1"}
    faults = dict(faults_of(macros))
    assert len(faults) == 2
    assert all("in a circle" in fault for fault in faults.values())


def test_a_book_s_macros_are_set_and_their_symbols_are_read(make_book: MakeBook) -> None:
    body = "In $\\norm{\\mathbf{R}}$ it is.\n"
    files: dict[str, str | None] = {
        "content/book.toml": f"{OUTLINE}norm = '\\lVert #1 \\rVert'\n",
        "content/symbols.toml": "[book]\n'\\mathbf{R}' = [\"rotation\"]\n",
    }
    page = content_bytes(render_site(make_book(body, files))["first/index.html"]).decode()
    assert page.count("‖") == 2


@pytest.mark.parametrize(
    ("tex", "shown"),
    [
        (r"\qty{3}{\milli\metre}", "3mm"),
        (r"\SI{1.5e-3}{m/s}", "1.5×10−3ms−1"),
        (r"\qty{30}{\degree}", "30°"),
        (r"\qty{20}{\celsius}", "20°C"),
        (r"\qty{12345.67891}{\kilo\gram\metre\per\second\squared}", "12345.67891kgms−2"),
        (r"\unit{W.m^-2.sr^{-1}}", "Wm−2sr−1"),
        (r"\si{\per\cubic\centi\metre}", "cm−3"),
        (r"\unit{\metre\tothe{4}}", "m4"),
        (r"\num{2.00(3)e8}", "2.00(3)×108"),
        (r"\num{-0,5}", "−0.5"),
        (r"\num{e-9}", "10−9"),
        (r"\qty{5.0 +- 0.2}{\micro\metre}", "(5.0±0.2)µm"),
        (r"\qty{20}{\percent}", "20%"),
        (r"L = \qty{4}{m} + \qty{2}{cm}", "L=4m+2cm"),
    ],
)
def test_quantities_read_as_siunitx_sets_them(tex: str, shown: str) -> None:
    assert letters(with_units(tex)) == shown


def test_a_thin_space_parts_a_number_from_its_unit_and_long_numbers_into_threes() -> None:
    assert with_units(r"\qty{12345}{m}") == r"{12\,345\,\text{m}}"


def test_letters_of_units_stand_upright() -> None:
    tree = ElementTree.fromstring(to_mathml(with_units(r"\unit{\metre\per\second}"), display=False))
    assert [element.text for element in tree.iter("mtext")] == ["m", "s"]
    assert not list(tree.iter("mi"))


@pytest.mark.parametrize(
    ("tex", "report"),
    [
        (r"\qty{3}{\milli\meters}", r"unknown unit '\\meters'; did you mean '\\meter'"),
        (r"\qty{3}{\milli}", "ends before its last unit"),
        (r"\qty{x}{m}", "number 'x'; legal: '12'"),
        (r"\qty{3}", "takes 2 arguments, 1 given"),
        (r"\unit{}", "no unit"),
        (r"\unit{/s}", "unit '/s'; legal"),
        (r"\unit{\metre\tothe{x}}", "power 'x' of a unit"),
    ],
)
def test_a_unit_that_is_none_is_refused(tex: str, report: str) -> None:
    with pytest.raises(UnsupportedTexError) as caught:
        with_units(tex)
    assert report.replace("\\\\", "\\") in str(caught.value).replace("\\\\", "\\")


@given(st.text(alphabet="\\{}qtyceSIumR norm#123+-.^_/(ABab)", max_size=30))
def test_whatever_is_written_is_set_or_refused(tex: str) -> None:
    for command in ("", r"\qty", r"\norm", r"\unit"):
        try:
            written_out(f"{command}{tex}", MACROS)
        except UnsupportedTexError:
            continue


def test_a_mistake_in_a_unit_has_its_place(mistakes: Find) -> None:
    (found,) = mistakes("It is\n$\\qty{3}{\\metres}$ long.\n")
    assert found.startswith("content/00-first.md:6: unknown unit")


def test_a_tag_stands_in_place_of_the_number(make_book: MakeBook) -> None:
    body = "$$1 = 1 \\tag{*}$$ (eq-one)\n\n$$2 = 2$$ (eq-two)\n\n{ref}`eq-one`, {ref}`eq-two`\n"
    page = content_bytes(render_site(make_book(body))["first/index.html"]).decode()
    assert "Equation (*)" in page
    assert "Equation (0.1)" in page
    assert "tag" not in page.partition("<math")[2].partition("</math>")[0]


@pytest.mark.parametrize(
    ("body", "report"),
    [
        ("$$1 = 1 \\tag{a b}$$\n", "5: \\tag{a b}; legal"),
        ("$$1 \\tag{a} \\tag{b}$$\n", "5: \\tag{a}; legal: one \\tag"),
        ("$$1 \\tag{a}$$\n\n$$2 \\tag{a}$$\n", "7: duplicate tag 'a'; first used on line 5"),
        ("In $1 \\tag{a}$ text.\n", "5: \\tag in '1 \\tag{a}'; legal"),
    ],
)
def test_a_tag_that_cannot_be_is_refused(mistakes: Find, body: str, report: str) -> None:
    found = mistakes(body)
    assert any(report in line for line in found), found
