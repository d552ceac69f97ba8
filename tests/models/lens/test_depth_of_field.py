"""Discs of confusion and layered compositing."""

import math

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.lens.depth_of_field import (
    Layer,
    blur_by_depth,
    blur_layer,
    composite,
)
from simulations.models.lens.disc_blur import NARROW_RADIUS, disc_blur


def point_of_light(size: int = 129) -> Floats:
    planes = np.zeros((1, size, size), np.float32)
    planes[0, size // 2, size // 2] = 1.0
    return planes


def test_what_is_sharp_comes_back_as_it_is() -> None:
    layer, picture = Layer(np.ones((4, 3, 3), np.float32), 0, 0), np.ones((3, 4, 4), np.float32)
    assert blur_layer(layer) is layer
    assert blur_by_depth(picture, np.zeros((4, 4))) is picture


@pytest.mark.parametrize("radius", [0.1, 0.2, 0.7, 2.0, 3.3, 11.0])
def test_blur_by_depth_is_the_disc_where_the_depth_is_uniform(radius: float) -> None:
    picture = np.random.default_rng(0).random((1, 30, 30)).astype(np.float32)
    assert blur_by_depth(picture, np.full((30, 30), radius)) == pytest.approx(
        disc_blur(picture, radius), abs=1e-6
    )


@pytest.mark.parametrize("largest", [NARROW_RADIUS * 2**k for k in range(5)])
def test_a_new_level_enters_without_a_jump(largest: float) -> None:
    """What is blurred less stays as it was when the widest disc passes a power of two."""
    picture = np.random.default_rng(3).random((1, 40, 44)).astype(np.float32)
    radius = np.linspace(0.0, largest, 44) + np.zeros((40, 1))
    before, after = (
        blur_by_depth(picture, np.where(radius < largest, radius, largest * (1 + step)))
        for step in (-1e-5, 1e-5)
    )
    assert np.abs(after - before).max() < 2e-4


def test_each_place_is_blurred_by_the_two_levels_next_to_its_radius() -> None:
    """Halfway between the squares of 2 and 4: half of each level's blur."""
    picture = np.random.default_rng(3).random((1, 30, 34)).astype(np.float32)
    column = np.arange(34) + np.zeros((30, 1))
    radius = np.where(column < 10, math.sqrt(10), np.where(column < 20, 0.0, 4.0))
    mixed = blur_by_depth(picture, radius)
    expected = 0.5 * (disc_blur(picture, 2.0) + disc_blur(picture, 4.0))
    assert mixed[..., :10] == pytest.approx(expected[..., :10], abs=1e-6)
    assert mixed[..., 10:20] == pytest.approx(picture[..., 10:20], abs=1e-6)
    assert mixed[..., 20:] == pytest.approx(disc_blur(picture, 4.0)[..., 20:], abs=1e-6)


def test_layers_are_laid_over_one_another_by_their_coverage() -> None:
    background = np.random.default_rng(1).random((3, 6, 7)).astype(np.float32)
    planes = np.random.default_rng(2).random((2, 4, 3, 4)).astype(np.float32) * 0.5
    missing = ((-3, 0), (6, 0), (0, -4), (0, 7), (9, 1), (1, -9))
    for top, left in ((0, 0), (2, 3), (-1, -2), (4, 5), (1, -1), (-2, 4), *missing):
        layers = [Layer(planes[0], top, left), Layer(planes[1], top, left)]
        expected = background.copy()
        for y, x in np.ndindex(6, 7):
            if 0 <= y - top < 3 and 0 <= x - left < 4:
                for layer in planes:
                    light = layer[:, y - top, x - left]
                    expected[:, y, x] = expected[:, y, x] * (1 - light[3]) + light[:3]
        np.testing.assert_allclose(composite(background, layers), expected, rtol=1e-6)


def test_a_layer_grows_by_its_radius_and_a_pixel_and_keeps_its_amount() -> None:
    planes = np.zeros((4, 5, 6), np.float32)
    planes[:, 2, 2:4] = 1.0
    layer = Layer(planes, 3, 4, radius_px=2.5)
    blurred = blur_layer(layer)
    assert (blurred.top, blurred.left) == (3 - 4, 4 - 4)
    assert blurred.planes.shape == (4, 5 + 8, 6 + 8)
    assert blurred.radius_px == 2.5
    assert blurred.planes[3].sum() == pytest.approx(2, rel=1e-3)
