"""PSNR and root mean square against their definitions."""

import numpy as np
import pytest

from simulations.models.error_measures import psnr_db, root_mean_square

FLAT = np.zeros((20, 30))


@pytest.mark.parametrize(
    ("picture", "reference", "peak", "score"),
    [
        (FLAT + 1 / 255, FLAT, 1.0, 20 * np.log10(255)),
        (FLAT + 1, FLAT, 255.0, 20 * np.log10(255)),
        (FLAT, FLAT, 1.0, np.inf),
        (FLAT + 0.3, FLAT + 0.2, 1.0, 20.0),
        ([0.1, 0.3, 0.0], [0.0, 0.2, 0.1], 1.0, 20.0),  # a line of values
        (np.eye(20), np.zeros((20, 20)), 1.0, 10 * np.log10(20)),  # corners count as well
        (FLAT + np.inf, FLAT, 1.0, -np.inf),
        (FLAT + 1e200, FLAT, 1.0, -np.inf),
        (FLAT + 1e100, FLAT, 1.0, -2000.0),
    ],
)
def test_psnr_is_the_mean_square_of_the_difference_in_units_of_the_peak(
    picture: np.ndarray, reference: np.ndarray, peak: float, score: float
) -> None:
    assert psnr_db(picture, reference, peak) == pytest.approx(score)


@pytest.mark.parametrize("crop", [3, 8, 9])
def test_psnr_leaves_out_just_the_border(crop: int) -> None:
    spoilt = np.ones((20, 30))
    inner = (slice(crop, 20 - crop), slice(crop, 30 - crop))
    spoilt[inner] = 0
    assert psnr_db(spoilt, FLAT, crop=crop) == np.inf
    for corner in ((crop, crop), (19 - crop, 29 - crop)):
        one = FLAT.copy()
        one[corner] = 1
        expected = 10 * np.log10(FLAT[inner].size)
        assert psnr_db(one, FLAT, crop=crop) == pytest.approx(expected)


def test_the_root_mean_square_of_three_four_is_that_of_their_hypotenuse() -> None:
    assert root_mean_square([[3.0, -4.0]]) == pytest.approx(5 / np.sqrt(2))
