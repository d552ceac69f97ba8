"""Conditions judge a figure by what it shows."""

import math
from dataclasses import dataclass

import pytest

from simulations.engine.conditions import first_true, shown_value
from simulations.engine.frame import Frame, Readout, readout
from simulations.engine.settings import choice, slider


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


@pytest.mark.parametrize(
    "condition",
    ["shift == -1.3", "fold == inf", "angles == 'kept'", "k1 == 0.2", "kind == 'a' and k1 < 1"],
)
def test_a_name_is_a_setting_or_else_a_readout_as_shown(condition: str) -> None:
    assert first_true([condition], Settings(), FRAME) == 0


def test_the_first_condition_that_holds_is_the_one() -> None:
    assert first_true(["k1 > 1", "shift < 0", "k1 > 0"], Settings(), FRAME) == 1
    assert first_true(["k1 > 1"], Settings(), FRAME) is None


def test_what_is_undefined_is_no_number() -> None:
    assert math.isnan(float(shown_value("undefined")))
