"""Luma and colour differences against the numbers of JFIF."""

import numpy as np

from simulations.models.color import ycbcr

RGB = np.random.default_rng(4).random((500, 3))


def test_ycbcr_of_grey_has_no_colour_and_comes_back() -> None:
    np.testing.assert_allclose(ycbcr.rgb_to_ycbcr([0.4, 0.4, 0.4]), [0.4, 0, 0], atol=1e-15)
    np.testing.assert_allclose(ycbcr.ycbcr_to_rgb(ycbcr.rgb_to_ycbcr(RGB)), RGB, atol=1e-12)


def test_luma_and_differences_of_the_primaries_are_those_of_jfif() -> None:
    primaries = ycbcr.rgb_to_ycbcr(np.eye(3))
    expected = [
        [0.299, -0.168736, 0.5],
        [0.587, -0.331264, -0.418688],
        [0.114, 0.5, -0.081312],
    ]
    np.testing.assert_allclose(primaries, expected, atol=1e-6)
