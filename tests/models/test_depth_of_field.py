"""Discs of confusion and layered compositing."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from simulations.models import depth_of_field
from simulations.models.depth_of_field import (
    Layer,
    blur_by_depth,
    blur_layer,
    composite,
    disc_blur,
    disc_kernel,
    double,
)


def point_of_light(size=129):
    planes = np.zeros((1, size, size), np.float32)
    planes[0, size // 2, size // 2] = 1.0
    return planes


def second_moment(spread):
    """Mean square distance from the centre along x, in pixels."""
    columns = np.arange(spread.shape[-1]) - spread.shape[-1] // 2
    return float((spread[0].sum(0) * columns**2).sum() / spread.sum())


@settings(deadline=None)
@given(radius=st.floats(0, 20))
def test_disc_weights_sum_to_one_and_are_symmetric(radius):
    kernel = disc_kernel(radius)
    assert kernel.sum() == pytest.approx(1, abs=1e-5)
    assert np.allclose(kernel, kernel[::-1, ::-1], atol=1e-7)
    assert (kernel >= 0).all()


def test_disc_weights_are_the_share_of_each_pixel_that_the_disc_covers():
    """Against counting on a grid 64 times finer."""
    radius, fine = 3.3, 64
    reach = disc_kernel(radius).shape[0] // 2
    line = (np.arange((2 * reach + 1) * fine) + 0.5) / fine - reach - 0.5
    inside = np.hypot(line, line[:, None]) < radius
    counted = inside.reshape(2 * reach + 1, fine, -1, fine).mean((1, 3))
    assert np.abs(disc_kernel(radius) * (math.pi * radius**2) - counted).max() < 0.3
    assert disc_kernel(radius)[reach, reach] == pytest.approx(1 / (math.pi * radius**2), rel=1e-3)


@pytest.mark.parametrize("radius", [1.5, 2.9, 3.4, 3.6, 5.0, 7.1, 9.0, 15.0, 25.0])
@pytest.mark.parametrize("offset", [0, 1, 3])
def test_blur_keeps_light_and_place_and_has_the_moment_of_a_disc(radius, offset):
    size = 161
    planes = np.roll(point_of_light(size), offset, axis=2)
    spread = disc_blur(planes, radius)[0].sum(0)
    columns = np.arange(size) - size // 2 - offset
    assert spread.sum() == pytest.approx(1, rel=1e-4)
    assert (spread * columns).sum() == pytest.approx(0, abs=1e-3)
    # r²/4 for the disc, and a little for the pixels, or the reduced pixels, it is drawn on.
    moment = (spread * columns**2).sum()
    assert moment == pytest.approx(radius**2 / 4, rel=0.06, abs=0.12)


@settings(max_examples=30, deadline=None)
@given(radius=st.floats(0, 40))
def test_flat_light_stays_flat(radius):
    flat = np.full((3, 23, 31), 0.4, np.float32)
    assert disc_blur(flat, radius) == pytest.approx(0.4, abs=1e-5)


def test_small_blur_agrees_with_a_plain_convolution():
    picture = np.random.default_rng(0).random((2, 20, 24)).astype(np.float32)
    expected = [ndimage.convolve(plane, disc_kernel(2.4), mode="nearest") for plane in picture]
    assert disc_blur(picture, 2.4) == pytest.approx(np.array(expected), abs=1e-5)


def test_disc_within_a_pixel_returns_the_very_picture():
    picture = np.ones((3, 4, 4), np.float32)
    assert disc_blur(picture, 0.5) is picture
    assert blur_by_depth(picture, np.full((4, 4), 0.5)) is picture


def test_disc_just_wider_than_a_pixel_blurs():
    light = point_of_light(9)
    column = disc_kernel(0.52)[:, 1]
    assert column[0] > 0
    assert disc_blur(light, 0.52)[0, 3:6, 4] == pytest.approx(column)
    assert blur_by_depth(light, np.full((9, 9), 0.52))[0, 3, 4] > 0
    assert blur_layer(Layer(light, 0, 0, 0.52)).planes[0, 5:8, 6] == pytest.approx(column)


def test_a_layer_is_sharp_unless_told_otherwise():
    layer = Layer(np.ones((4, 3, 3), np.float32), 0, 0)
    assert blur_layer(layer) is layer


def test_a_disc_is_drawn_exactly_up_to_a_radius_of_three_and_a_half_and_spread_wider_beyond():
    light = point_of_light(31)
    assert np.array_equal(disc_blur(light, 3.5)[0, 12:19, 12:19], disc_kernel(3.5))
    for radius in (3.52, 3.8):
        beyond = (disc_blur(light, radius)[0, 15] > 0).sum()
        assert beyond > disc_kernel(radius).shape[1]


@pytest.mark.parametrize("length", [1, 2, 3, 40])
def test_a_line_of_pixels_is_blurred_as_a_picture_of_that_line_repeated(length):
    line = np.random.default_rng(5).random((1, 1, length)).astype(np.float32)
    repeated = disc_blur(np.repeat(line, 33, axis=1), 9.0)
    assert disc_blur(line, 9.0)[0, 0] == pytest.approx(repeated[0, 16], abs=1e-6)
    upright = np.repeat(line, 33, axis=1).swapaxes(1, 2)
    assert disc_blur(line.swapaxes(1, 2), 9.0)[0, :, 0] == pytest.approx(
        disc_blur(upright, 9.0)[0, :, 16], abs=1e-6
    )


def test_blur_by_depth_is_the_disc_where_the_depth_is_uniform():
    picture = np.random.default_rng(0).random((1, 30, 30)).astype(np.float32)
    assert blur_by_depth(picture, np.full((30, 30), 2.0)) == pytest.approx(
        disc_blur(picture, 2.0), abs=1e-6
    )


def test_blur_by_depth_between_levels_keeps_the_moment():
    light = point_of_light(65)
    spread = blur_by_depth(light, np.full((65, 65), 3.0))
    assert second_moment(spread) == pytest.approx(9 / 4, rel=0.05, abs=0.12)


def test_sharp_background_shows_through_the_soft_edge_of_a_near_layer():
    background = np.zeros((3, 40, 40), np.float32)
    background[:, :, ::2] = 1.0
    near = Layer(np.ones((4, 20, 20), np.float32) * 0.5, 10, 10, radius_px=0.0)
    near.planes[3] = 1.0
    opaque = composite(background, [near])
    assert (opaque[:, 12:28, 12:28] == 0.5).all()
    assert (opaque[:, :9] == background[:, :9]).all()
    assert (background[:, :, ::2] == 1.0).all()


def test_blurred_layer_spreads_its_coverage_and_keeps_its_amount():
    planes = np.zeros((4, 24, 24), np.float32)
    planes[:, 8:16, 8:16] = 1.0
    blurred = blur_layer(Layer(planes, 0, 0, radius_px=5.0))
    assert blurred.planes[3].sum() == pytest.approx(64, rel=1e-3)
    assert (blurred.top, blurred.left) == (-6, -6)
    assert blurred.planes[3].max() <= 1.0


def test_layer_outside_the_picture_changes_nothing():
    background = np.random.default_rng(0).random((3, 5, 5)).astype(np.float32)
    away = Layer(np.ones((4, 3, 3), np.float32), -3, 9)
    assert np.array_equal(composite(background, [away]), background)


def test_negative_radius_is_refused():
    with pytest.raises(ValueError, match="radius_px -1"):
        disc_kernel(-1.0)


def test_layers_are_laid_over_one_another_by_their_coverage():
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
def test_layers_that_miss_the_picture_change_nothing_and_hide_no_other(top, left):
    background = np.zeros((3, 6, 7), np.float32)
    missing, seen = (
        Layer(np.ones((4, 3, 4), np.float32), top, left),
        Layer(np.ones((4, 1, 1), np.float32), 5, 6),
    )
    picture = composite(background, [missing, seen])
    assert picture.sum() == 3
    assert (picture[:, 5, 6] == 1).all()


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.5])
def test_a_disc_within_a_pixel_is_a_point(radius):
    assert disc_kernel(radius).tolist() == [[1.0]]


@pytest.mark.parametrize(("radius", "width"), [(0.51, 3), (1.5, 3), (1.51, 5), (3.4, 7)])
def test_a_kernel_is_just_wide_enough_for_its_disc(radius, width):
    assert disc_kernel(radius).shape == (width, width)


@pytest.mark.parametrize("radius", [0.8, 1.5, 2.2, 3.4])
def test_each_row_of_a_disc_holds_the_area_of_its_strip(radius):
    """The strip between y − ½ and y + ½ has the area of its chord's integral."""
    kernel = disc_kernel(radius)
    reach = kernel.shape[0] // 2
    y = (np.arange(20_000 * kernel.shape[0]) + 0.5) / 20_000 - reach - 0.5
    strips = 2 * np.sqrt(np.maximum(radius**2 - y**2, 0)).reshape(kernel.shape[0], -1).mean(1)
    np.testing.assert_allclose(kernel.sum(1), strips / (math.pi * radius**2), atol=1e-5)


@pytest.mark.parametrize("radius", [0.6, 0.7, 1.2, 2.04, 2.98, 3.4])
def test_a_strip_is_spread_over_the_pixels_that_its_chord_covers(radius):
    """A chord of the strip's mean length, centred: its overlap with each pixel of the row."""
    kernel = disc_kernel(radius)
    left = np.arange(kernel.shape[1]) - kernel.shape[1] // 2 - 0.5
    half = 0.5 * kernel.sum(1, keepdims=True) * math.pi * radius**2
    overlap = np.minimum(half, left + 1) - np.maximum(-half, left)
    expected = np.maximum(overlap, 0) / (math.pi * radius**2)
    np.testing.assert_allclose(kernel, expected, atol=1e-6)


@pytest.mark.parametrize("radius", [-0.1, math.inf, math.nan])
def test_a_radius_that_is_none_is_refused(radius):
    with pytest.raises(ValueError, match="radius_px"):
        disc_kernel(radius)


def test_a_flat_layer_grows_by_its_radius_and_a_pixel():
    layer = Layer(np.ones((4, 5, 6), np.float32), 3, 4, radius_px=2.5)
    blurred = blur_layer(layer)
    assert (blurred.top, blurred.left) == (3 - 4, 4 - 4)
    assert blurred.planes.shape == (4, 5 + 8, 6 + 8)
    assert blurred.radius_px == 2.5
    sharp = Layer(np.ones((4, 5, 6), np.float32), 3, 4, radius_px=0.5)
    assert blur_layer(sharp) is sharp


def test_a_wide_blur_of_an_uneven_picture_keeps_its_size_and_a_ramp():
    ramp = np.broadcast_to(np.arange(61.0), (2, 45, 61)).astype(np.float32)
    for radius in (3.0, 4.5, 9.0):
        blurred = disc_blur(ramp, radius)
        assert blurred.shape == (2, 45, 61)
        inner = (slice(None), slice(20, 25), slice(25, 36))
        np.testing.assert_allclose(blurred[inner], ramp[inner], atol=1e-3)


def test_doubling_interpolates_and_holds_the_border():
    planes = np.array([[[0.0, 4.0, 8.0]]], np.float32)
    assert double(planes)[0].tolist() == [[0, 1, 3, 5, 7, 8]] * 2
    assert double(planes.swapaxes(1, 2))[0].T.tolist() == [[0, 1, 3, 5, 7, 8]] * 2


def test_halving_is_the_transpose_of_doubling():
    rng = np.random.default_rng(6)
    coarse, fine = rng.random((2, 3, 5)), rng.random((2, 6, 10))
    half = depth_of_field._halve(fine.astype(np.float32))
    there = (double(coarse.astype(np.float32)) * fine).sum()
    assert there == pytest.approx(4 * (coarse * half).sum(), rel=1e-6)
    assert depth_of_field._halve(np.zeros((2, 7, 8), np.float32)).shape == (2, 4, 4)
    assert depth_of_field._halve(np.zeros((2, 8, 7), np.float32)).shape == (2, 4, 4)


def test_each_place_is_blurred_by_the_two_levels_next_to_its_radius():
    """Halfway between the squares of 1 and 2: half of each level's blur."""
    picture = np.random.default_rng(3).random((1, 30, 34)).astype(np.float32)
    radius = np.full((30, 34), math.sqrt(2.5))
    expected = 0.5 * (disc_blur(picture, 1.0) + disc_blur(picture, 2.0))
    assert blur_by_depth(picture, radius) == pytest.approx(expected, abs=1e-6)
    split = np.where(np.arange(34) < 17, 0.0, 4.0) + np.zeros((30, 1))
    mixed = blur_by_depth(picture, split)
    assert mixed[..., :17] == pytest.approx(picture[..., :17], abs=1e-6)
    assert mixed[..., 17:] == pytest.approx(disc_blur(picture, 4.0)[..., 17:], abs=1e-6)


@pytest.mark.parametrize("radius", [-1.0, 1025.0, np.inf, np.nan])
def test_discs_that_no_picture_can_hold_are_refused(radius):
    planes = np.ones((4, 8, 8), np.float32)
    for call in (
        lambda: disc_kernel(radius),
        lambda: disc_blur(planes, radius),
        lambda: blur_layer(Layer(planes, 0, 0, radius)),
    ):
        with pytest.raises(ValueError, match=r"radius_px .*; legal: 0 to 1024"):
            call()
    if not radius < 0:
        with pytest.raises(ValueError, match="blur_by_depth: radius_px"):
            blur_by_depth(planes, np.full((8, 8), radius))


def test_the_widest_disc_is_drawn_without_a_grid_as_large():
    assert disc_blur(np.ones((1, 8, 8), np.float32), 1024.0) == pytest.approx(1.0, abs=1e-5)
