"""Helpers that all models share: array types, checks, quantiles, error measures, least squares."""

from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares

from simulations.models.arrays import (
    Floats,
    as_array,
    as_floats,
    as_matrices,
    as_vectors,
    quantile_of,
)
from simulations.models.error_measures import psnr_db, root_mean_square
from simulations.models.least_squares import levenberg_marquardt
from simulations.models.require import as_whole, require

FLAT = np.zeros((20, 30))


@pytest.mark.parametrize(
    ("given", "kept"), [("f2", "f4"), ("f4", "f4"), ("f8", "f8"), ("u1", "f8"), ("?", "f8")]
)
def test_pictures_keep_single_precision_and_vectors_become_double(given: str, kept: str) -> None:
    assert as_floats(np.ones(2, given)).dtype == kept
    assert as_vectors("x", np.ones((2, 3), given), 3).dtype == np.float64


def test_complex_numbers_and_other_shapes_are_refused_by_name() -> None:
    for call in (
        lambda: as_floats([1j]),
        lambda: as_vectors("x", [1j], 1),
        lambda: as_array("x", [1j], 1),
        lambda: as_array("x", np.ones((1, 3)), 3),
        lambda: as_matrices("x", np.ones((4, 4)), 3, 3),
    ):
        with pytest.raises(ValueError, match=r"(x of|values of).*; legal: "):
            call()


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
def test_refusal_states_name_value_and_legal_values(value: object, shown: str) -> None:
    require("gain", value, True, "above 0")
    with pytest.raises(ValueError, match="legal") as refused:
        require("gain", value, False, "above 0")
    assert str(refused.value) == f"gain {shown}; legal: above 0"


@pytest.mark.parametrize("value", [3, 3.0, np.int64(3), np.float32(3)])
def test_whole_numbers_of_any_type_become_ints(value: Any) -> None:
    assert type(as_whole("count", value, 1)) is int
    assert as_whole("count", value, 1, 3) == as_whole("count", value, 3) == 3


@pytest.mark.parametrize("share", [0.0, 0.05, 0.5, 1.0])
def test_quantile_agrees_with_numpy(share: float) -> None:
    values = np.random.default_rng(0).normal(size=(7, 9))
    assert quantile_of(values, share) == np.percentile(values, 100 * share, method="nearest")


@pytest.mark.parametrize(
    ("picture", "reference", "peak", "score"),
    [
        (FLAT + 1, FLAT, 255.0, 20 * np.log10(255)),
        (FLAT, FLAT, 1.0, np.inf),
        ([0.1, 0.3, 0.0], [0.0, 0.2, 0.1], 1.0, 20.0),
        (np.eye(20), np.zeros((20, 20)), 1.0, 10 * np.log10(20)),
        (FLAT + 1e200, FLAT, 1.0, -np.inf),
    ],
)
def test_psnr_is_the_mean_squared_error_relative_to_the_peak(
    picture: Floats, reference: Floats, peak: float, score: float
) -> None:
    assert psnr_db(picture, reference, peak) == pytest.approx(score)


def test_psnr_leaves_out_exactly_the_border() -> None:
    spoilt = np.ones((20, 30))
    spoilt[3:-3, 3:-3] = 0
    assert psnr_db(spoilt, FLAT, crop=3) == np.inf
    spoilt[3, -4] = 1
    assert psnr_db(spoilt, FLAT, crop=3) == pytest.approx(10 * np.log10(14 * 24))
    assert root_mean_square([[3.0, -4.0]]) == pytest.approx(5 / np.sqrt(2))


def test_fitted_curve_agrees_with_scipy() -> None:
    rng = np.random.default_rng(3)
    t = np.linspace(0, 4, 40)
    y = 2.0 * np.exp(-0.7 * t) + rng.normal(0, 0.05, 40)

    def residuals(at: Floats) -> tuple[Floats, Floats]:
        decay = np.exp(-at[1] * t)
        return at[0] * decay - y, np.column_stack([decay, -at[0] * t * decay])

    found = levenberg_marquardt(residuals, np.add, np.array([1.0, 0.1]))
    expected = least_squares(lambda at: residuals(at)[0], (1.0, 0.1), xtol=1e-14, ftol=1e-14)
    np.testing.assert_allclose(found, expected.x, rtol=1e-6)


def test_minimum_is_found_where_full_steps_would_diverge() -> None:
    def residuals(at: Floats) -> tuple[Floats, Floats]:
        return np.arctan(at), np.diag([1.0, 0.0]) / (1.0 + at * at)

    found = levenberg_marquardt(residuals, np.add, np.array([5.0, 0.0]))
    np.testing.assert_allclose(found, 0.0, atol=1e-5)
