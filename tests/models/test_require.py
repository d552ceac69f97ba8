"""A parameter that makes no sense is refused by its name, with its value and what is legal."""

import numpy as np
import pytest

from simulations.models.require import require, require_one_of, require_positive


def test_what_holds_passes() -> None:
    require("gain", 5.0, True, "above 0")
    require_positive("scale", 1e-300)
    require_one_of("method", "nearest", ("nearest", "bilinear"))


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (np.float64(-1.5), "-1.5"),
        (np.array([1.0, np.nan]), "[1.0, nan]"),
        ("xyz", "'xyz'"),
        ((3, 4), "(3, 4)"),
        (np.zeros((40, 80)), "of shape (40, 80)"),
    ],
)
def test_what_does_not_is_refused_in_one_grammar(value: object, shown: str) -> None:
    with pytest.raises(ValueError, match="legal") as refused:
        require("gain", value, False, "above 0")
    assert str(refused.value) == f"gain {shown}; legal: above 0"


@pytest.mark.parametrize("value", [0.0, -1.0, np.inf, -np.inf, np.nan])
def test_only_numbers_above_0_are_positive_and_none_is_infinite(value: float) -> None:
    with pytest.raises(ValueError, match=f"^scale {value}; legal: above 0, finite$"):
        require_positive("scale", value)


def test_of_other_words_the_legal_ones_are_named() -> None:
    with pytest.raises(ValueError, match=r"^method 'cubic'; legal: nearest, bilinear$"):
        require_one_of("method", "cubic", ("nearest", "bilinear"))
