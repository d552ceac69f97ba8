"""White balance, and the guess of the light by the mean of the picture."""

import numpy as np

from simulations.models.color.white_balance import grey_world, white_balance


def test_white_balance_makes_the_light_grey() -> None:
    lamp = np.array([1.0, 0.7, 0.4])
    np.testing.assert_allclose(white_balance(0.5 * lamp, lamp), [0.35] * 3)


def test_grey_world_takes_the_mean_of_each_channel() -> None:
    picture = np.arange(4 * 6 * 3.0).reshape(4, 6, 3)
    np.testing.assert_allclose(grey_world(picture), [34.5, 35.5, 36.5])
    assert (grey_world(np.full((9, 3), 1e308)) == np.inf).all()
