"""The two shapes that spectra are made of, against SciPy."""

import numpy as np
from scipy.interpolate import CubicSpline

from simulations.models.color import spectra

GRID = spectra.WAVELENGTHS_NM


def test_a_bell_is_half_as_high_at_the_root_of_2_ln_2_deviations() -> None:
    reach = np.sqrt(2 * np.log(2))
    heights = spectra.bell([500 - 20 * reach, 500.0, 500 + 40 * reach], 500.0, 20.0, 40.0)
    np.testing.assert_allclose(heights, [0.5, 1.0, 0.5])


def test_the_curve_through_knots_is_scipys_natural_spline() -> None:
    values = np.random.default_rng(1).random((3, 17))
    knots = np.linspace(380, 780, 17)
    theirs = CubicSpline(knots, values, axis=-1, bc_type="natural")(GRID)
    np.testing.assert_allclose(spectra.through_knots(values), theirs, atol=1e-12)


def test_a_straight_line_of_three_knots_stays_straight() -> None:
    np.testing.assert_allclose(spectra.through_knots([0.0, 0.5, 1.0]), np.linspace(0, 1, 81))
