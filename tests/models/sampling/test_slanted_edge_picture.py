"""Exact pictures of edges."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.special import erf

from simulations.models.pixel_grid import centred
from simulations.models.sampling.slanted_edge_picture import edge_picture

ANGLE = math.radians(5.0)


def test_a_picture_of_an_edge_without_a_lens_holds_the_share_of_each_pixel_in_the_light() -> None:
    picture = edge_picture(3, 5, ANGLE, np.ones_like)

    def lit(y: float, x: float) -> float:
        return float(x * math.cos(ANGLE) + y * math.sin(ANGLE) > 0)

    share, _ = dblquad(lit, -0.5, 0.5, -0.5, 0.5, epsabs=2e-3)
    assert picture[1, 2] == pytest.approx(share, abs=5e-3)
    assert picture[1, 0] == pytest.approx(0.0, abs=0.01)
    assert picture[1, 4] == pytest.approx(1.0, abs=0.01)


def test_a_gaussian_spot_spreads_the_edge_as_its_integral() -> None:
    picture = edge_picture(3, 41, 0.0, lambda f: np.exp(-2 * (np.pi * f) ** 2))
    at = centred(41)
    fine = np.linspace(-0.5, 0.5, 101)
    expected = np.mean(0.5 * (1 + erf((at[:, None] + fine) / np.sqrt(2))), axis=1)
    assert np.abs(picture[1] - expected).max() < 1e-3
