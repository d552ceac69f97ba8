"""A perfect round lens: Airy's disc, and transfer functions against pupils shifted here."""

import numpy as np
import pytest
import scipy.special

from simulations.models.arrays import Floats
from simulations.models.lens.bessel import bessel_j0
from simulations.models.lens.diffraction import (
    FIRST_ZERO,
    cutoff_per_mm,
    defocus_waves,
    lens_transfer,
    spot,
    spot_diameter_um,
)


def test_j0_is_scipy_s() -> None:
    x = np.linspace(-200, 200, 40001)
    np.testing.assert_allclose(bessel_j0(x), scipy.special.j0(x), atol=1e-7)


def test_the_spot_in_focus_is_airy_s() -> None:
    radius = np.linspace(0.01, 30, 301)
    v = np.pi * radius / (0.55 * 8)
    airy = (2 * scipy.special.j1(v) / v) ** 2
    np.testing.assert_allclose(spot(radius, 0.55, 8), airy, atol=1e-6)
    assert spot(0, 0.55, 8) == pytest.approx(1)


def test_the_first_dark_ring_is_where_j1_vanishes() -> None:
    assert pytest.approx(scipy.special.jn_zeros(1, 1)[0] / np.pi, rel=1e-12) == FIRST_ZERO
    assert spot_diameter_um(0.55, 8) == pytest.approx(10.73, abs=0.01)


@pytest.mark.parametrize("waves", [0.25, 0.5, 1.0, 3.5])
def test_defocus_darkens_the_middle_like_a_squared_sinc(waves: float) -> None:
    """The integral of exp(2πiwt) over the opening's area, t from 0 to 1."""
    middle = spot(0, 0.5, 4, waves * 8 * 0.5 * 4**2)
    assert middle == pytest.approx(np.sinc(waves) ** 2, abs=1e-12)


def by_shifted_pupils(share: Floats, waves: float) -> Floats:
    """The overlap of a pupil with itself, shifted by a share of its diameter, on a grid."""
    along = (np.arange(1500) + 0.5) / 750 - 1
    x, y = np.meshgrid(along, along[:750] + 1)
    answers = []
    for nu in share:
        left, right = (x + nu) ** 2 + y**2, (x - nu) ** 2 + y**2
        both = (left <= 1) & (right <= 1)
        phase = 2 * np.pi * waves * (left - right)
        answers.append(2 * np.cos(phase[both]).sum() / 750**2 / np.pi)
    return np.array(answers)


@pytest.mark.parametrize("waves", [0.0, 0.3, 1.0, 4.0])
def test_transfer_is_the_overlap_of_the_opening_with_itself(waves: float) -> None:
    share = np.linspace(0.02, 0.98, 13)
    cutoff = cutoff_per_mm(0.55, 4)
    defocus = waves * 8 * 0.55 * 4**2
    ours = lens_transfer(share * cutoff, 0.55, 4, defocus)
    np.testing.assert_allclose(ours, by_shifted_pupils(share, waves), atol=2e-3)


def test_transfer_is_continuous_where_defocus_begins() -> None:
    f = np.linspace(0, 500, 101)
    np.testing.assert_allclose(
        lens_transfer(f, 0.55, 4, 1e-6), lens_transfer(f, 0.55, 4), atol=1e-9
    )


def test_a_wide_disc_of_defocus_is_that_of_geometry() -> None:
    """2 J₁(πfd)/(πfd) for a disc of d = δ/N, at frequencies far below the cut-off."""
    defocus, f_number = 60.0, 1.4
    v = np.pi * np.linspace(1, 45, 30) * defocus / f_number / 1000
    ours = lens_transfer(np.linspace(1, 45, 30), 0.4, f_number, defocus)
    np.testing.assert_allclose(ours, 2 * scipy.special.j1(v) / v, atol=0.04)


def test_the_spectrum_of_the_spot_is_the_transfer_function() -> None:
    """Two formulas of their own: joined by a Hankel transform, done as a sum."""
    radius = np.arange(0.005, 60, 0.01)
    light = spot(radius, 0.5, 4, 40.0)
    for f in (0, 50, 120, 250, 480):
        wave = scipy.special.j0(2 * np.pi * f * radius / 1000)
        total = np.sum(light * wave * radius) / np.sum(light * radius)
        assert total == pytest.approx(float(lens_transfer(f, 0.5, 4, 40.0)), abs=0.02)


def test_nothing_passes_beyond_the_cut_off() -> None:
    cutoff = cutoff_per_mm(0.55, 8)
    assert cutoff == pytest.approx(227.27, abs=0.01)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8), 0)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8, 100), 0)


def test_what_makes_no_sense_is_refused() -> None:
    with pytest.raises(ValueError, match=r"f_number 0"):
        cutoff_per_mm(0.55, 0)
    with pytest.raises(ValueError, match="defocus in waves"):
        lens_transfer(100, 0.4, 1.4, 1000)
    with pytest.raises(ValueError, match="frequency_per_mm"):
        lens_transfer(np.nan, 0.4, 1.4)
    with pytest.raises(ValueError, match="radius_um"):
        spot(1000, 0.4, 1.4)
    with pytest.raises(ValueError, match=r"^defocus_um inf; legal: finite"):
        defocus_waves(np.inf, 0.5, 2)
    with pytest.raises(ValueError, match=r"^x .*at most 1e6"):
        bessel_j0([1.0, -2e6])
    with pytest.raises(ValueError, match=r"^wavelength_um 0"):
        spot_diameter_um(0, 2)
    assert defocus_waves(8, 0.5, 2) == 0.5
