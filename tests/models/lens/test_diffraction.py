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
    defocus_um = waves * 8 * 0.5 * 4**2
    assert defocus_waves(defocus_um, 0.5, 4) == pytest.approx(waves)
    middle = spot(0, 0.5, 4, defocus_um)
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


def test_nothing_passes_beyond_the_cut_off() -> None:
    cutoff = cutoff_per_mm(0.55, 8)
    assert cutoff == pytest.approx(227.27, abs=0.01)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8), 0)
    np.testing.assert_array_equal(lens_transfer([cutoff, 300, np.inf], 0.55, 8, 100), 0)
