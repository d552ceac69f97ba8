"""MTF50 by bins and by a spline: what the chapters say of it, on other slants as well."""

from functools import cache

import numpy as np
import pytest

from simulations.ladders.mtf_binning import LADDER, clean_error, noisy_error, prepare, reference
from simulations.models.arrays import Floats

GOOD = (4.0, 7.0, 11.0, 22.0)
"""Slants at which no few rows repeat each other ..."""
REPEATING = (14.04, 18.43, 26.57, 33.69)
"""... and at which they do."""


@cache
def errors(angles_deg: tuple[float, ...], metric: str) -> dict[str, float]:
    work = prepare(angles_deg)
    truth = reference(work)
    measure = {"clean": clean_error, "noisy": noisy_error}[metric]
    return {tier.id: measure(tier.run(work), truth, work) for tier in LADDER.tiers}


@pytest.mark.parametrize("angles", [GOOD, REPEATING])
def test_the_spline_is_the_nearest_without_noise(angles: tuple[float, ...]) -> None:
    found = errors(angles, "clean")
    assert found["spline"] < 0.02
    assert min(error for tier, error in found.items() if tier != "spline") > 10 * found["spline"]


def test_bins_err_at_slants_at_which_rows_repeat_each_other() -> None:
    assert errors(GOOD, "clean")["bins-4"] < 0.6
    assert errors(REPEATING, "clean")["bins-4"] > 2 * errors(GOOD, "clean")["bins-4"]
    assert errors(REPEATING, "clean")["bins-8"] > errors(GOOD, "clean")["bins-8"]


def test_the_correction_helps_where_the_bins_are_evenly_filled() -> None:
    found = errors(GOOD, "clean")
    assert found["bins-4"] < found["bins-4-raw"]


def test_in_noise_bins_and_spline_are_alike() -> None:
    found = errors(GOOD, "noisy")
    assert 0.5 < found["spline"] / found["bins-4"] < 1.5


def test_the_reference_is_where_blur_times_pixel_is_one_half() -> None:
    truth: Floats = reference(prepare((5.0,))).clean
    across, down = (np.sinc(truth * side) for side in (np.cos(np.pi / 36), np.sin(np.pi / 36)))
    spots = np.exp(-2.0 * (np.pi * np.array([0.5, 1.0]) * truth) ** 2)
    np.testing.assert_allclose(spots * across * down, 0.5, atol=1e-6)
