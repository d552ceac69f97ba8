"""Detail that colours have in common, against OpenCV's Laplacian and SciPy's correlation."""

import cv2
import numpy as np
import pytest
from scipy.stats import pearsonr

from simulations.models.sensor.shared_detail import shared_detail


def test_it_is_the_correlation_of_the_laplacians() -> None:
    picture = np.random.default_rng(0).random((30, 41, 3))
    picture[..., 0] += 0.7 * picture[..., 1]
    picture[..., 2] -= 0.2 * picture[..., 1]
    detail = cv2.Laplacian(picture, cv2.CV_64F, ksize=1)[1:-1, 1:-1].reshape(-1, 3).T
    expected = [pearsonr(detail[colour], detail[1])[0] for colour in (0, 2)]
    assert shared_detail(picture) == pytest.approx(expected, abs=1e-12)


def test_a_colour_without_detail_shares_an_undefined_amount() -> None:
    picture = np.random.default_rng(3).random((8, 8, 3))
    picture[..., 0] = 0.25
    red, blue = shared_detail(picture)
    assert np.isnan(red)
    assert np.isfinite(blue)


@pytest.mark.parametrize("scale", [1e-300, 1e300])
def test_the_unit_of_light_does_not_matter(scale: float) -> None:
    picture = np.random.default_rng(4).random((9, 9, 3))
    assert shared_detail(scale * picture) == pytest.approx(shared_detail(picture), abs=1e-12)
