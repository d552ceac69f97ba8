"""Discs of confusion and layered compositing."""

import math

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.lens.depth_of_field import (
    Layer,
    blur_by_depth,
    blur_layer,
    blur_levels,
    composite,
)
from simulations.models.lens.disc_blur import NARROW_RADIUS, disc_blur, disc_kernel
from simulations.models.lens.disc_pyramid import pyramid_blur


def point_of_light(size: int = 129) -> Floats:
    planes = np.zeros((1, size, size), np.float32)
    planes[0, size // 2, size // 2] = 1.0
    return planes


def second_moment(spread: Floats) -> float:
    """Mean square distance from the centre along x, in pixels."""
    columns = np.arange(spread.shape[-1]) - spread.shape[-1] // 2
    return float((spread[0].sum(0) * columns**2).sum() / spread.sum())


def test_a_layer_is_sharp_unless_told_otherwise() -> None:
    layer = Layer(np.ones((4, 3, 3), np.float32), 0, 0)
    assert blur_layer(layer) is layer


@pytest.mark.parametrize("radius", [0.1, 0.5, 0.52])
def test_a_layer_is_blurred_by_a_disc_that_lies_within_a_pixel(radius: float) -> None:
    column = disc_kernel(radius)[:, 1]
    assert column[0] > 0
    blurred = blur_layer(Layer(point_of_light(9), 0, 0, radius))
    assert blurred.planes[0, 5:8, 6] == pytest.approx(column)


def test_blur_by_depth_returns_the_very_picture_where_all_is_in_focus() -> None:
    picture = np.ones((3, 4, 4), np.float32)
    assert blur_by_depth(picture, np.zeros((4, 4))) is picture
    assert blur_by_depth(point_of_light(9), np.full((9, 9), 0.1))[0, 3, 4] > 0


@pytest.mark.parametrize("radius", [0.2, 0.7, 2.0, 3.3, 11.0])
def test_blur_by_depth_is_the_disc_where_the_depth_is_uniform(radius: float) -> None:
    picture = np.random.default_rng(0).random((1, 30, 30)).astype(np.float32)
    assert blur_by_depth(picture, np.full((30, 30), radius)) == pytest.approx(
        disc_blur(picture, radius), abs=1e-6
    )


@pytest.mark.parametrize("largest", [0.1, 0.61, 0.62, 1.23, 1.24, 4.0, 7.3, 24.0, 1024.0])
def test_levels_run_from_none_to_the_largest_and_at_most_double(largest: float) -> None:
    levels = blur_levels(largest)
    assert levels[0] == 0
    assert levels[1] == min(largest, NARROW_RADIUS)
    assert levels[-1] == largest
    steps = np.array(levels[2:]) / levels[1:-1]
    assert (steps > 1).all()
    assert (steps <= 2).all()


@pytest.mark.parametrize("radius", [0.3, 0.6, 0.8, 1.2, 3.0, 5.0, 7.9])
def test_blur_by_depth_between_levels_keeps_the_moment(radius: float) -> None:
    """Of the disc: the pixels' own part is mixed from those of the levels."""
    light = point_of_light(65)
    levels = np.full((65, 65), radius)
    levels[0, 0] = 8.0
    spread = blur_by_depth(light, levels)
    assert second_moment(spread) == pytest.approx(radius**2 / 4 + 1 / 24, rel=0.02, abs=0.12)


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


def test_either_way_of_drawing_a_disc_will_do() -> None:
    picture = np.random.default_rng(3).random((4, 30, 34)).astype(np.float32)
    layer = Layer(picture, 0, 0, 9.0)
    padded = np.pad(picture, ((0, 0), (10, 10), (10, 10)), mode="edge")
    assert np.array_equal(blur_layer(layer, pyramid_blur).planes, pyramid_blur(padded, 9.0))
    everywhere = blur_by_depth(picture, np.full((30, 34), 9.0), pyramid_blur)
    np.testing.assert_allclose(everywhere, pyramid_blur(picture, 9.0), atol=1e-6)


@pytest.mark.parametrize("radius", [-1.0, 1025.0, np.inf, np.nan])
def test_discs_that_no_picture_can_hold_are_refused(radius: float) -> None:
    planes = np.ones((4, 8, 8), np.float32)
    with pytest.raises(ValueError, match=r"radius_px .*; legal: 0 to 1024"):
        blur_layer(Layer(planes, 0, 0, radius))
    radii = np.ones((8, 8))
    radii[3, 4] = radius
    with pytest.raises(ValueError, match="radius_px"):
        blur_by_depth(planes, radii)


def test_sharp_background_shows_through_the_soft_edge_of_a_near_layer() -> None:
    background = np.zeros((3, 40, 40), np.float32)
    background[:, :, ::2] = 1.0
    near = Layer(np.ones((4, 20, 20), np.float32) * 0.5, 10, 10, radius_px=0.0)
    near.planes[3] = 1.0
    opaque = composite(background, [near])
    assert (opaque[:, 12:28, 12:28] == 0.5).all()
    assert (opaque[:, :9] == background[:, :9]).all()
    assert (background[:, :, ::2] == 1.0).all()


def test_blurred_layer_spreads_its_coverage_and_keeps_its_amount() -> None:
    planes = np.zeros((4, 24, 24), np.float32)
    planes[:, 8:16, 8:16] = 1.0
    blurred = blur_layer(Layer(planes, 0, 0, radius_px=5.0))
    assert blurred.planes[3].sum() == pytest.approx(64, rel=1e-3)
    assert (blurred.top, blurred.left) == (-6, -6)
    assert blurred.planes[3].max() <= 1.0


def test_layer_outside_the_picture_changes_nothing() -> None:
    background = np.random.default_rng(0).random((3, 5, 5)).astype(np.float32)
    away = Layer(np.ones((4, 3, 3), np.float32), -3, 9)
    assert np.array_equal(composite(background, [away]), background)


def test_layers_are_laid_over_one_another_by_their_coverage() -> None:
    background = np.random.default_rng(1).random((3, 6, 7)).astype(np.float32)
    planes = np.random.default_rng(2).random((2, 4, 3, 4)).astype(np.float32) * 0.5
    for top, left in ((0, 0), (2, 3), (-1, -2), (4, 5), (1, -1), (-2, 4)):
        layers = [Layer(planes[0], top, left), Layer(planes[1], top, left)]
        expected = background.copy()
        for y, x in np.ndindex(6, 7):
            if 0 <= y - top < 3 and 0 <= x - left < 4:
                for layer in planes:
                    light = layer[:, y - top, x - left]
                    expected[:, y, x] = expected[:, y, x] * (1 - light[3]) + light[:3]
        np.testing.assert_allclose(composite(background, layers), expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("top", "left"), [(-3, 0), (6, 0), (0, -4), (0, 7), (-5, 1), (9, 1), (1, -9), (1, 12)]
)
def test_layers_that_miss_the_picture_change_nothing_and_hide_no_other(top: int, left: int) -> None:
    background = np.zeros((3, 6, 7), np.float32)
    missing, seen = (
        Layer(np.ones((4, 3, 4), np.float32), top, left),
        Layer(np.ones((4, 1, 1), np.float32), 5, 6),
    )
    picture = composite(background, [missing, seen])
    assert picture.sum() == 3
    assert (picture[:, 5, 6] == 1).all()


def test_a_flat_layer_grows_by_its_radius_and_a_pixel() -> None:
    layer = Layer(np.ones((4, 5, 6), np.float32), 3, 4, radius_px=2.5)
    blurred = blur_layer(layer)
    assert (blurred.top, blurred.left) == (3 - 4, 4 - 4)
    assert blurred.planes.shape == (4, 5 + 8, 6 + 8)
    assert blurred.radius_px == 2.5
