"""Measured numbers as a reader wants them."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from site_builder.benchmarks.quantities import error_text, quantity


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"), (1234.0, "1200"), (123456.0, "1.2\u202f×\u202f10⁵"), (9.96, "10"),
        (0.00996, "0.010"), (6.23e-5, "6.2\u202f×\u202f10⁻⁵"), (-3.04, "−3.0"),
    ],
)  # fmt: skip
def test_quantities_have_two_digits(value: float, text: str) -> None:
    assert quantity(value) == text


@given(st.floats(1e-300, 1e300))
def test_a_quantity_is_within_half_a_unit_of_its_second_digit(value: float) -> None:
    text = quantity(value).translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789", "\u202f"))
    shown = float(re.sub(r"×10(?=[-\d])", "e", text))
    assert shown == pytest.approx(value, rel=0.0501)


def test_an_infinite_ratio_is_no_error() -> None:
    assert (error_text(None, "dB"), error_text(None, "px"), error_text(0.0, "px")) == (
        "∞", "none", "none",
    )  # fmt: skip
