"""Luma and colour differences against the numbers of JFIF."""

import numpy as np

from simulations.models.color import ycbcr


def test_luma_and_differences_of_the_primaries_are_those_of_jfif() -> None:
    expected = [
        [0.299, -0.168736, 0.5],
        [0.587, -0.331264, -0.418688],
        [0.114, 0.5, -0.081312],
    ]
    np.testing.assert_allclose(ycbcr.rgb_to_ycbcr(np.eye(3)), expected, atol=1e-6)
    np.testing.assert_allclose(ycbcr.ycbcr_to_rgb(expected), np.eye(3), atol=5e-6)
