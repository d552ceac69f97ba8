"""Antialiased patterns against the mean of many samples over the pixel."""

import numpy as np
import pytest

from simulations.pictures.patterns import band, chequer, siemens_star, stripes


@pytest.mark.parametrize("width", [0.01, 0.3, 1.0, 2.0, 2.7])
def test_stripes_are_the_mean_of_a_square_wave_over_the_width(width: float) -> None:
    centres = np.linspace(-3, 3, 61)
    offsets = width * ((np.arange(4000) + 0.5) / 4000 - 0.5)
    samples = np.where(np.floor(centres[:, None] + offsets) % 2 == 0, 1.0, -1.0)
    mean = samples.mean(1)
    assert stripes(centres, np.full_like(centres, width)) == pytest.approx(mean, abs=2e-3)


def test_chequer_far_away_is_even_grey() -> None:
    u, v = np.meshgrid(np.arange(32) * 2.0, np.arange(32) * 2.0)
    assert chequer(u, v) == pytest.approx(0.5, abs=1e-9)


def test_chequer_alternates_where_squares_are_many_pixels_wide() -> None:
    u, v = np.meshgrid((np.arange(40) + 0.5) / 20, (np.arange(40) + 0.5) / 20)
    squares = chequer(u, v)
    assert squares[[10, 30], [10, 30]] == pytest.approx(1.0)
    assert squares[[10, 30], [30, 10]] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("shift", [0.0, 0.2, 0.45])
def test_a_band_has_the_same_area_wherever_it_falls_on_the_grid(shift: float) -> None:
    distance = np.tile(np.arange(-10.0, 11.0) + shift, (3, 1))
    assert band(distance, 1.3).sum(1) == pytest.approx(2.6)


def test_siemens_star_is_grey_at_its_centre_and_sharp_far_out() -> None:
    x, y = np.meshgrid(np.arange(-100.0, 101.0), np.arange(-100.0, 101.0))
    star = siemens_star(x, y, 18)
    radius = np.hypot(x, y)
    assert np.abs(star[(radius > 0) & (radius < 3)] - 0.5).max() < 0.25
    assert ((star < 0.01) | (star > 0.99))[radius > 90].mean() > 0.7
    assert star[radius > 20].mean() == pytest.approx(0.5, abs=0.01)
