"""A camera's curves and its colour matrix against measurements and SciPy."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize
from support.oracle_spectra import oracle, sampled

from simulations.models.arrays import Floats
from simulations.models.color.illuminants import D65_K, daylight, planck
from simulations.models.color.observer import OBSERVER, tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.surfaces import CHART, chart_patch
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix

D65 = daylight(D65_K)
CURVES = camera_curves(WAVELENGTHS_NM)
PATCHES = np.stack([chart_patch(name) for name in CHART])


def test_the_curves_are_those_that_were_measured() -> None:
    measured = sampled(oracle.MSDS_CAMERA_SENSITIVITIES["Nikon 5100 (NPL)"])
    off = CURVES - measured
    assert np.abs(off).max() < 0.05
    assert (np.sqrt(np.mean(off**2, axis=0)) < [0.021, 0.0137, 0.0071]).all()


def test_a_raw_value_is_the_sum_over_the_spectrum() -> None:
    light, patch = planck(3000.0), PATCHES[3]
    by_hand = [sum(light * patch * CURVES[:, k]) / sum(light * CURVES[:, 1]) for k in range(3)]
    np.testing.assert_allclose(exposed(patch * light, CURVES, light), by_hand)
    assert exposed(light, CURVES, light)[1] == pytest.approx(1)


def chart() -> tuple[Floats, Floats, Floats]:
    """Balanced raw values, XYZ, and the white's XYZ."""
    white = exposed(D65, CURVES, D65)
    balanced = exposed(PATCHES * D65, CURVES, D65) / white
    return balanced, tristimulus(PATCHES * D65, D65), tristimulus(D65, D65)


def test_no_other_matrix_that_keeps_white_errs_less() -> None:
    balanced, xyz, white = chart()

    def matrix_of(free: NDArray[np.float64]) -> NDArray[np.float64]:
        two = free.reshape(3, 2)
        return np.column_stack([two, white - two.sum(axis=1)])

    def error(free: NDArray[np.float64]) -> float:
        return float(np.sum((balanced @ matrix_of(free).T - xyz) ** 2))

    best = minimize(error, np.full(6, 0.3), tol=1e-14).x
    np.testing.assert_allclose(fit_colour_matrix(balanced, xyz, white), matrix_of(best), atol=1e-4)


def test_curves_that_are_mixtures_of_the_eyes_make_no_error() -> None:
    """Luther's condition: then one matrix serves every colour, exactly."""
    mixed = OBSERVER @ np.array([[0.9, 0.2, 0.0], [0.3, 0.7, 0.1], [0.0, 0.1, 1.1]]).T
    white = exposed(D65, mixed, D65)
    balanced = exposed(PATCHES * D65, mixed, D65) / white
    _, xyz, white_xyz = chart()
    matrix = fit_colour_matrix(balanced, xyz, white_xyz)
    np.testing.assert_allclose(balanced @ matrix.T, xyz, atol=1e-10)
