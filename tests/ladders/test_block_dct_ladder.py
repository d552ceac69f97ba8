"""All ways to transform a block agree to the digits of the numbers that they count in."""

from functools import cache

import numpy as np
import pytest
from scipy.fft import dctn
from support.ladder_run import LadderRun

from simulations.ladders.block_dct import (
    LADDER,
    changed_per_million,
    worst_codes,
)
from simulations.models.compression.blocks import LUMINANCE_TABLE

RUN = LadderRun(LADDER)


@cache
def worst() -> dict[str, float]:
    return RUN.measured(worst_codes)


def test_the_reference_is_scipys_transform() -> None:
    oracle = dctn(RUN.work, type=2, norm="ortho", axes=(-2, -1))
    np.testing.assert_allclose(RUN.truth.astype(float), oracle, atol=1e-11)


def test_the_workload_is_of_whole_codes_and_uses_every_frequency() -> None:
    assert np.array_equal(RUN.work, np.rint(RUN.work))
    assert RUN.work.min() == -128
    assert np.sqrt(np.mean(RUN.truth.astype(float) ** 2, axis=0)).min() > 5.0


@pytest.mark.parametrize("tier", ["separable", "direct", "fourier"])
def test_float64_is_right_to_a_billionth_of_a_code(tier: str) -> None:
    assert worst()[tier] < 1e-11


@pytest.mark.parametrize("tier", ["separable-32", "direct-32"])
def test_float32_is_right_to_a_thousandth_of_a_code(tier: str) -> None:
    assert 1e-6 < worst()[tier] < 1e-3


@pytest.mark.parametrize("tier", ["separable", "direct", "fourier", "separable-32", "direct-32"])
def test_no_float_changes_what_a_file_would_store(tier: str) -> None:
    assert changed_per_million(RUN.results[tier], RUN.truth, RUN.work) == 0.0


def test_integers_are_right_to_a_third_of_a_code_and_change_one_in_a_thousand() -> None:
    # Three bits are kept twice: an eighth of a code, halved by rounding, mixed by two passes.
    assert 1 / 16 < worst()["fixed-point"] < 1 / 3
    assert 100 < changed_per_million(RUN.results["fixed-point"], RUN.truth, RUN.work) < 5000


def test_integers_round_up_as_often_as_down() -> None:
    # Shifts without half a step added would darken every coefficient by a sixteenth.
    assert abs(np.mean(RUN.results["fixed-point"] - RUN.truth)) < 0.005


def test_a_coefficient_halfway_between_two_numbers_may_go_either_way() -> None:
    tie = np.zeros((1, 8, 8))
    tie[0, 0, 0] = 2.5 * LUMINANCE_TABLE[0, 0]
    assert changed_per_million(tie + 0.01, tie, RUN.work) == 0.0
    clear = tie + 0.3 * LUMINANCE_TABLE
    assert changed_per_million(clear + 0.9 * LUMINANCE_TABLE, clear, RUN.work) == 1e6
