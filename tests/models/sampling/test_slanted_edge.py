"""MTF from one slanted edge: against the formulae of lens and pixel, and where it cannot say."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import erf

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.slanted_edge import edge_picture, edge_transfer, read_edge

FREQUENCIES = np.linspace(0.0, 0.5, 26)
ANGLE = math.radians(5.0)


def sharp(frequency: Floats) -> Floats:
    return np.ones_like(frequency)


def gaussian(frequency: Floats) -> Floats:
    """Of a spot with a standard deviation of one pixel."""
    return np.asarray(np.exp(-2 * (np.pi * frequency) ** 2))


def diffraction(frequency: Floats) -> Floats:
    return np.asarray(lens_transfer(frequency / 0.004, 0.55, 8.0))


@pytest.mark.parametrize("lens", [gaussian, diffraction])
def test_the_edge_gives_the_transfer_of_lens_and_pixel(lens: object) -> None:
    assert callable(lens)
    found = read_edge(edge_picture(90, 60, ANGLE, lens)).transfer(FREQUENCIES)
    true = np.abs(lens(FREQUENCIES) * edge_transfer(FREQUENCIES, ANGLE))
    assert np.abs(found - true).max() < 0.02


def test_a_picture_of_an_edge_without_a_lens_holds_the_share_of_each_pixel_in_the_light() -> None:
    picture = edge_picture(3, 5, ANGLE, sharp)

    def lit(y: float, x: float) -> float:
        return float(x * math.cos(ANGLE) + y * math.sin(ANGLE) > 0)

    share, _ = dblquad(lit, -0.5, 0.5, -0.5, 0.5, epsabs=2e-3)
    assert picture[1, 2] == pytest.approx(share, abs=5e-3)
    assert picture[1, 0] == pytest.approx(0.0, abs=0.01)
    assert picture[1, 4] == pytest.approx(1.0, abs=0.01)


def test_a_gaussian_spot_spreads_the_edge_as_its_integral() -> None:
    reading = read_edge(edge_picture(90, 60, ANGLE, gaussian))
    expected = 0.5 * (1 + erf(reading.place / np.sqrt(2 * (1 + 1 / 12))))
    assert np.abs(reading.spread - expected).max() < 0.01


def test_an_upright_edge_meets_every_row_alike_and_says_nothing() -> None:
    reading = read_edge(edge_picture(45, 60, 0.0, gaussian))
    assert not reading.complete
    assert np.isnan(reading.transfer([0.1])).all()
