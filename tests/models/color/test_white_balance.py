"""White balance, and the guess of the light by the mean of the picture."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.color import white_balance


def test_white_balance_makes_the_light_grey() -> None:
    lamp = np.array([1.0, 0.7, 0.4])
    np.testing.assert_allclose(white_balance.white_balance(0.5 * lamp, lamp), [0.35] * 3)
    with pytest.raises(ValueError, match="illuminant"):
        white_balance.white_balance(lamp, [1, 1, 0])


def test_grey_world_takes_the_mean_of_each_channel() -> None:
    picture = np.arange(4 * 6 * 3.0).reshape(4, 6, 3)
    np.testing.assert_allclose(white_balance.grey_world(picture), [34.5, 35.5, 36.5])


@pytest.mark.parametrize(
    "light", [[1.0, -0.5, 1], [1, np.nan, 1], [1, 1, np.inf], [1, 1], [[1] * 3]]
)
def test_what_is_no_light_is_refused(light: ArrayLike) -> None:
    with pytest.raises(ValueError, match="illuminant"):
        white_balance.white_balance([0.5, 0.5, 0.5], light)


def test_a_picture_without_pixels_has_no_mean_colour_and_a_glaring_one_an_infinite_one() -> None:
    with pytest.raises(ValueError, match="one pixel or more"):
        white_balance.grey_world(np.ones((0, 3)))
    assert (white_balance.grey_world(np.full((9, 3), 1e308)) == np.inf).all()


@pytest.mark.parametrize(
    "function",
    [white_balance.grey_world, lambda rgb: white_balance.white_balance(rgb, (1.0, 1.0, 1.0))],
)
def test_three_channels_are_asked_for_and_no_alpha(function: Callable[[Floats], object]) -> None:
    for shape in ((5, 5, 4), (5, 1)):
        with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
            function(np.ones(shape))
