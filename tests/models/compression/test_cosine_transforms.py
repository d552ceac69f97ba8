"""Every way to the cosine transform against scipy's, each as close as its numbers allow."""

import numpy as np
import pytest
from scipy.fft import dctn

from simulations.models.arrays import Floats
from simulations.models.compression.cosine_transforms import (
    PASS_BITS,
    TRANSFORMS,
    exact_block_dct,
    exact_cosines,
    fixed_point,
)

CODES = np.random.default_rng(5).integers(-128, 128, (3, 50, 8, 8)).astype(float)
ORACLE = dctn(CODES, type=2, norm="ortho", axes=(-2, -1))
ALLOWED = {
    # Two roundings to an eighth, the first mixed by a second pass of unit rows.
    "fixed-point": (1 + np.sqrt(8)) * 2.0 ** -(PASS_BITS + 1) + 0.1,
    # Sums of 64 products of up to 128, at 2⁻²⁴ each.
    "separable-32": 64 * 128 * 2.0**-24,
    "separable": 64 * 128 * 2.0**-52,
    "direct-32": 64 * 128 * 2.0**-24,
    "direct": 64 * 128 * 2.0**-52,
    "fourier": 64 * 128 * 2.0**-52,
}


def impulse(row: int, column: int, height: float = 100.0) -> Floats:
    block = np.zeros((8, 8))
    block[row, column] = height
    return block


@pytest.mark.parametrize("name", TRANSFORMS)
def test_a_transform_is_scipys_to_the_digits_of_its_numbers(name: str) -> None:
    ours = TRANSFORMS[name](CODES)
    assert ours.shape == CODES.shape
    assert np.abs(ours - ORACLE).max() < ALLOWED[name]


@pytest.mark.parametrize("name", TRANSFORMS)
def test_the_largest_codes_do_not_overflow(name: str) -> None:
    for code in (-128.0, 127.0):
        # A cosine of 13 bits is off by a ten-thousandth here, and that twice.
        flat = TRANSFORMS[name](np.full((8, 8), code))
        assert flat[0, 0] == pytest.approx(8 * code, abs=0.5)
        assert np.abs(flat).sum() == pytest.approx(abs(8 * code), abs=0.5)


@pytest.mark.parametrize("name", ["separable-32", "direct-32"])
def test_single_precision_stays_single(name: str) -> None:
    assert TRANSFORMS[name](CODES).dtype == np.float32


def test_integers_give_eighths_of_a_code_and_no_less() -> None:
    eighths = fixed_point(CODES) * 8
    assert np.array_equal(eighths, np.rint(eighths))
    assert not np.array_equal(eighths / 2, np.rint(eighths / 2))


def test_integers_hold_means_of_four_whole_codes_exactly() -> None:
    quarters = np.round(4 * impulse(2, 5, 3.75) + 1) / 4
    exact = dctn(quarters, type=2, norm="ortho")
    assert np.abs(fixed_point(quarters) - exact).max() < ALLOWED["fixed-point"]
    # Half a code everywhere is a mean of four: whole samples would make it 0 or 8.
    assert fixed_point(np.full((8, 8), 0.5))[0, 0] == pytest.approx(4, abs=0.3)
    assert fixed_point(np.full((8, 8), -0.25))[0, 0] == pytest.approx(-2, abs=0.3)


def test_integers_round_finer_samples_to_quarters() -> None:
    for sample, quarter in ((0.24, 0.25), (-0.26, -0.25), (0.4, 0.5), (0.1, 0.0)):
        flat, whole = (fixed_point(np.full((8, 8), height)) for height in (sample, quarter))
        assert np.array_equal(flat, whole)


def test_the_judge_is_scipys_transform_and_keeps_more_digits() -> None:
    truth = exact_block_dct(CODES)
    assert truth.dtype == np.longdouble
    np.testing.assert_allclose(truth.astype(float), ORACLE, atol=1e-12)
    # An orthonormal transform keeps the sum of squares: here to the digits beyond float64's.
    kept = (truth**2).sum(axis=(-2, -1)) / (CODES**2).sum(axis=(-2, -1)).astype(np.longdouble)
    wider = float(np.finfo(np.longdouble).eps)
    assert float(np.abs(kept - 1).max()) < 100 * max(wider, 1e-19)


def test_nested_roots_are_cosines() -> None:
    np.testing.assert_allclose(
        exact_cosines().astype(float), np.cos(np.pi * np.arange(32) / 16), atol=2e-16
    )
