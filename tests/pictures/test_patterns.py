"""Antialiased patterns against the mean of many samples over the pixel."""

import numpy as np
import pytest

from simulations.pictures.patterns import (
    band,
    band_about,
    checker,
    pixel_width,
    siemens_star,
    stripes,
)


def test_a_band_covers_the_share_of_the_footprint_it_overlaps() -> None:
    u = np.array([-1.0, -0.5, 0.0, 0.5, 2.0])
    np.testing.assert_allclose(band(u, -0.5, 0.5, 0.4), [0.0, 0.5, 1.0, 0.5, 0.0])


@pytest.mark.parametrize("footprint", [0.03, 0.3, 1.7])
def test_stripes_agree_with_many_point_samples(footprint: float) -> None:
    u = np.linspace(-2, 2, 37)
    fine = u[:, None] + footprint * ((np.arange(4000) + 0.5) / 4000 - 0.5)
    sampled = (np.abs(fine - np.round(fine / 0.7) * 0.7) <= 0.1).mean(axis=1)
    np.testing.assert_allclose(stripes(u, 0.7, 0.2, footprint), sampled, atol=1e-3)


def test_tiles_far_below_a_pixel_blend_to_their_mean() -> None:
    u = np.linspace(0, 3, 50)
    np.testing.assert_allclose(checker(u, u, 0.001, 0.5, 0.5), 0.5, atol=1e-2)


def test_chequers_far_away_are_even_grey() -> None:
    u, v = np.meshgrid(np.arange(32) * 2.0, np.arange(32) * 2.0)
    assert checker(u, v, 1.0, pixel_width(u), pixel_width(v)) == pytest.approx(0.5, abs=1e-9)


def test_chequers_alternate_where_squares_are_many_pixels_wide() -> None:
    u, v = np.meshgrid((np.arange(40) - 9.5) / 20, (np.arange(40) - 9.5) / 20)
    squares = checker(u, v, 1.0, pixel_width(u), pixel_width(v))
    assert squares[[10, 30], [10, 30]] == pytest.approx(1.0)
    assert squares[[10, 30], [30, 10]] == pytest.approx(0.0, abs=1e-9)


def test_a_pattern_that_stands_still_across_a_pixel_is_taken_at_a_point() -> None:
    still = np.full((3, 3), 0.1)
    assert stripes(still, 2.0, 1.0, pixel_width(still)) == pytest.approx(1.0)


@pytest.mark.parametrize("shift", [0.0, 0.2, 0.45])
def test_a_band_has_the_same_area_wherever_it_falls_on_the_grid(shift: float) -> None:
    distance = np.tile(np.arange(-10.0, 11.0) + shift, (3, 1))
    assert band_about(distance, 1.3).sum(1) == pytest.approx(2.6)


def test_siemens_star_is_grey_at_its_centre_and_sharp_far_out() -> None:
    x, y = np.meshgrid(np.arange(-100.0, 101.0), np.arange(-100.0, 101.0))
    star = siemens_star(x, y, 18)
    radius = np.hypot(x, y)
    assert np.abs(star[(radius > 0) & (radius < 3)] - 0.5).max() < 0.25
    assert ((star < 0.01) | (star > 0.99))[radius > 90].mean() > 0.7
    assert star[radius > 20].mean() == pytest.approx(0.5, abs=0.01)
