"""Expressions have the values that Python gives them and access nothing else; conditions compare
the readouts and settings of a figure."""

import math
from dataclasses import dataclass

import pytest

from simulations.engine.conditions import first_true, readout_value
from simulations.engine.expressions import ExpressionError, evaluate
from simulations.engine.frame import Frame, Readout, readout
from simulations.engine.settings import choice, slider

SOUND = (
    "2 + 3 * 4 ** 2 / 8 - -1",
    "7 // 2 % 2",
    "1 < 2 <= 2 != 3",
    "1 < 2 > 3",
    "not (1 == 2 or 3 >= 4) and 5 in (4, 5)",
    "'kept' not in ['lost']",
    "max(1, abs(-3)) + round(2.675, 2)",
    "(1, (2, 3))[1][0]",
    "(3, 4, 5)[1:]",
    "(2.5).real",
)
REFUSED = (
    "().__class__", "().index", "[x for x in (1, 2)]", "(lambda: open)()", "f'{1}'", "(x := 1)",
    "1 if 2 else 3", "open('file')", "1 is 1", "9**9**9**9", "2 * 'a' * 10**12", "(0,) * 10**12",
    "round(1, -(10**12))", "'%1000000000d' % 1", "10**900 * 10**900", "-" * 100_000 + "1",
    "(" * 1000 + "1" + ")" * 1000, "", "1 +", "sqrt(-1)",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Settings:
    k1: float = slider("k₁", 0.2, -1, 1, 0.1)
    kind: str = choice("Kind", {"a": "A", "b": "B"})


FRAME = Frame(
    (),
    (
        readout("shift", "Shift", -1.26, "px", digits=1),
        readout("fold", "Fold", float("inf")),
        readout("k1", "k₁", 99.0),
        Readout("angles", "Angles", "kept"),
    ),
    "A frame.",
)


@pytest.mark.parametrize("text", SOUND)
def test_expression_has_the_same_value_as_in_python(text: str) -> None:
    assert evaluate(text, {}) == eval(text)


@pytest.mark.parametrize("text", REFUSED)
def test_unsafe_or_invalid_expression_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError):
        evaluate(text, {})


def test_names_have_their_values_and_operators_short_circuit() -> None:
    assert evaluate("f(x, y=2) * cos(pi)", {"f": lambda x, y: x + y, "x": 1}) == -3.0
    assert evaluate("x == 0 or 1 / x > 2", {"x": 0}) is True
    assert evaluate("x != 0 and 1 / x > 2", {"x": 0}) is False


@pytest.mark.parametrize(
    ("conditions", "first"),
    [
        (["shift == -1.3"], 0),  # a readout as displayed,
        (["fold == inf"], 0),
        (["angles == 'kept'"], 0),
        (["k1 == 0.2"], 0),  # or a setting
        (["kind == 'a' and k1 < 1"], 0),
        (["k1 > 1", "shift < 0", "k1 > 0"], 1),
        (["k1 > 1"], None),
    ],
)
def test_first_condition_that_holds_is_found(conditions: list[str], first: int) -> None:
    assert first_true(conditions, Settings(), FRAME) == first
    assert math.isnan(float(readout_value("undefined")))
