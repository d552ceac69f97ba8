"""A hole without a lens: rays where it is wide, diffraction where it is narrow."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0, j1

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import spot
from simulations.models.lens.pinhole import pinhole_transfer, sharpest_hole_mm, spread_mm

DEPTH_MM, GREEN_UM = 100.0, 0.55


def fresnel_spot(radius_mm: float, hole_mm: float) -> float:
    """Light beside that of the same hole with a lens: Fresnel's integral over the hole."""
    wave, half = GREEN_UM * 1e-3 * DEPTH_MM, hole_mm / 2.0

    def part(phase: float) -> float:
        def integrand(rho: float) -> float:
            swing = math.pi * rho * rho / wave - phase
            return float(j0(2.0 * math.pi * rho * radius_mm / wave)) * math.cos(swing) * rho

        return quad(integrand, 0.0, half, limit=400)[0] * 2.0 / half**2

    return part(0.0) ** 2 + part(math.pi / 2.0) ** 2


@pytest.mark.parametrize("hole", [0.1, 0.37, 1.0, 2.0])
def test_the_spot_is_that_of_fresnel_s_integral(hole: float) -> None:
    radii = np.array([0.0, 0.2, 0.45, 0.8]) * hole
    ours = spot(1000.0 * radii, GREEN_UM, DEPTH_MM / hole, 1000.0 * DEPTH_MM)
    assert ours == pytest.approx([fresnel_spot(radius, hole) for radius in radii], abs=1e-6)


def disc(frequency: Floats, width_mm: float) -> Floats:
    """Transfer function of a uniform disc."""
    x = math.pi * width_mm * frequency
    return np.asarray(2.0 * j1(x) / x)


def test_a_wide_hole_blurs_like_a_disc_of_its_own_width() -> None:
    frequency = np.linspace(0.02, 1.2, 60)
    ours = pinhole_transfer(frequency, 2.0, DEPTH_MM, GREEN_UM)
    assert ours == pytest.approx(disc(frequency, 2.0), abs=0.03)


def test_of_all_holes_one_about_as_wide_as_its_spread_keeps_fine_waves_best() -> None:
    holes = np.geomspace(0.1, 2.0, 200)
    kept = [float(pinhole_transfer(1.5, hole, DEPTH_MM, GREEN_UM)) for hole in holes]
    best = holes[np.argmax(kept)]
    sharpest = sharpest_hole_mm(DEPTH_MM, GREEN_UM)
    assert spread_mm(sharpest, DEPTH_MM, GREEN_UM) == pytest.approx(sharpest)
    assert best == pytest.approx(sharpest, rel=0.2)
