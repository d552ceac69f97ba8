"""Spaces in formulae, by TeX's rules (The TeXbook, chapter 18)."""

from xml.etree import ElementTree

import pytest

from site_builder.markdown.text.math import to_mathml


def elements(tex: str) -> list[ElementTree.Element]:
    return list(ElementTree.fromstring(to_mathml(tex, display=False)).iter())


def forms_of_minus(tex: str) -> list[str | None]:
    return [element.get("form") for element in elements(tex) if element.text == "−"]


def thin_spaces(tex: str) -> int:
    return sum(element.tag == "mspace" for element in elements(tex))


@pytest.mark.parametrize("tex", ["(-x)", "(40, -40)", "a = -b", "2 \\cdot -3", "[-1]"])
def test_a_minus_after_an_opening_or_an_operator_is_a_sign(tex: str) -> None:
    assert forms_of_minus(tex) == ["prefix"]


@pytest.mark.parametrize("tex", ["a - b", "(a) - b", "x_1 - 2", "\\frac{1}{2} - y", "x' - x"])
def test_a_minus_between_operands_is_an_operator(tex: str) -> None:
    assert forms_of_minus(tex) == [None]


@pytest.mark.parametrize(
    "tex",
    [
        "\\cos\\theta",
        "\\cos^2 x",
        "\\log 2",
        "\\mathrm{tr} R",
        "a \\sin(x)",
        "\\arctan\\frac{y}{x}",
    ],
)
def test_function_names_stand_apart_from_letters_and_numbers(tex: str) -> None:
    assert thin_spaces(tex) == 1


@pytest.mark.parametrize("tex", ["\\cos(x)", "1 - \\cos(x)", "x y", "\\mathrm{px} x"])
def test_brackets_operators_and_plain_letters_get_no_space(tex: str) -> None:
    assert thin_spaces(tex) == 0


def test_bars_stand_close_to_what_they_enclose() -> None:
    bars = [element for element in elements("|x| = 1") if element.text == "|"]
    assert [(bar.get("lspace"), bar.get("rspace")) for bar in bars] == [("0", "0")] * 2


@pytest.mark.parametrize(
    ("tex", "stretchy"), [("\\lVert x \\rVert", "false"), ("\\left\\| x \\right\\|", "true")]
)
def test_bars_grow_only_when_asked_to(tex: str, stretchy: str) -> None:
    assert {bar.get("stretchy") for bar in elements(tex) if bar.text == "‖"} == {stretchy}


@pytest.mark.parametrize(("tex", "tight"), [("1/400", "/"), ("f_{\\max}", "max")])
def test_slashes_and_operators_in_a_subscript_get_no_space(tex: str, tight: str) -> None:
    spaces = [(e.get("lspace"), e.get("rspace")) for e in elements(tex) if e.text == tight]
    assert spaces == [("0", "0")]


def test_a_sign_by_itself_has_no_operands_to_keep_away_from() -> None:
    [sign] = [element for element in elements(">") if element.tag == "mo"]
    assert (sign.get("lspace"), sign.get("rspace")) == ("0", "0")
