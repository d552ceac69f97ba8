"""A perfect round lens and a hole: Airy’s disc, Fresnel’s integral and transfer functions."""

import math

import numpy as np
import pytest
import scipy.special
from scipy.integrate import quad
from scipy.special import j0, j1

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import (
    FIRST_ZERO,
    cutoff_per_mm,
    defocus_waves,
    lens_transfer,
    spot,
    spot_diameter_um,
)
from simulations.models.lens.pinhole import pinhole_transfer


def test_spot_in_focus_is_airys_disc() -> None:
    radius = np.linspace(0.01, 30, 301)
    v = np.pi * radius / (0.55 * 8)
    airy = (2 * scipy.special.j1(v) / v) ** 2
    np.testing.assert_allclose(spot(radius, 0.55, 8), airy, atol=1e-6)
    assert spot(0, 0.55, 8) == pytest.approx(1)


def test_first_dark_ring_is_where_j1_vanishes() -> None:
    assert pytest.approx(scipy.special.jn_zeros(1, 1)[0] / np.pi, rel=1e-12) == FIRST_ZERO
    assert spot_diameter_um(0.55, 8) == pytest.approx(10.73, abs=0.01)


@pytest.mark.parametrize("waves", [0.25, 0.5, 1.0, 3.5])
def test_defocus_darkens_the_middle_like_a_squared_sinc(waves: float) -> None:
    """The integral of exp(2πiwt) over the opening's area, t from 0 to 1."""
    defocus_um = waves * 8 * 0.5 * 4**2
    assert defocus_waves(defocus_um, 0.5, 4) == pytest.approx(waves)
    middle = spot(0, 0.5, 4, defocus_um)
    assert middle == pytest.approx(np.sinc(waves) ** 2, abs=1e-12)


@pytest.mark.parametrize("short", [0.9, 0.3, 1e-3, 1e-6, 2.0**-30])
def test_transfer_keeps_its_digits_near_the_cutoff(short: float) -> None:
    """Against the textbook's formula in long doubles, for λN = 1 mm."""
    share = np.longdouble(1.0 - short)
    expected = 2 * (np.arccos(share) - share * np.sqrt(1 - share * share)) / np.longdouble(math.pi)
    assert lens_transfer(1.0 - short, 1.0, 1000.0) == pytest.approx(float(expected), rel=1e-9)
    assert lens_transfer(1.0 - short, 1.0, 1000.0, 1e-3) == pytest.approx(float(expected), rel=1e-7)


def test_transfer_is_zero_beyond_the_cutoff() -> None:
    cutoff = cutoff_per_mm(0.55, 8)
    assert cutoff == pytest.approx(227.27, abs=0.01)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8), 0)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8, 100), 0)


DEPTH_MM, GREEN_UM = 100.0, 0.55


def fresnel_spot(radius_mm: float, hole_mm: float) -> float:
    """Light relative to the same hole with a lens: Fresnel's integral over the hole."""
    wave, half = GREEN_UM * 1e-3 * DEPTH_MM, hole_mm / 2.0

    def part(phase: float) -> float:
        def integrand(rho: float) -> float:
            swing = math.pi * rho * rho / wave - phase
            return float(j0(2.0 * math.pi * rho * radius_mm / wave)) * math.cos(swing) * rho

        return quad(integrand, 0.0, half, limit=400)[0] * 2.0 / half**2

    return part(0.0) ** 2 + part(math.pi / 2.0) ** 2


@pytest.mark.parametrize("hole", [0.1, 0.37, 1.0, 2.0])
def test_pinhole_spot_agrees_with_fresnels_integral(hole: float) -> None:
    radii = np.array([0.0, 0.2, 0.45, 0.8]) * hole
    ours = spot(1000.0 * radii, GREEN_UM, DEPTH_MM / hole, 1000.0 * DEPTH_MM)
    assert ours == pytest.approx([fresnel_spot(radius, hole) for radius in radii], abs=1e-6)


def disc(frequency: Floats, width_mm: float) -> Floats:
    """Transfer function of a uniform disc."""
    x = math.pi * width_mm * frequency
    return np.asarray(2.0 * j1(x) / x)


def test_wide_hole_blurs_like_a_disc_of_its_width() -> None:
    frequency = np.linspace(0.02, 1.2, 60)
    ours = pinhole_transfer(frequency, 2.0, DEPTH_MM, GREEN_UM)
    assert ours == pytest.approx(disc(frequency, 2.0), abs=0.03)
