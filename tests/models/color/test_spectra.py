"""Lights, surfaces and the eye against Planck’s law, SciPy and the CIE’s tables."""

import numpy as np
import pytest
import scipy.constants
from scipy.interpolate import CubicSpline
from support.oracle_spectra import TABULATED, illuminant, on_grid, oracle, tabulated_xy

from simulations.models.arrays import Floats
from simulations.models.color import illuminants, observer, spectra, surfaces
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import xyz_to_lab
from simulations.models.color.spectra import WAVELENGTHS_NM as GRID


def test_curve_through_knots_is_scipys_natural_spline() -> None:
    values = np.random.default_rng(1).random((3, 17))
    knots = np.linspace(380, 780, 17)
    theirs = CubicSpline(knots, values, axis=-1, bc_type="natural")(GRID)
    np.testing.assert_allclose(spectra.through_knots(values), theirs, atol=1e-12)


@pytest.mark.parametrize("kelvin", [500.0, 2856.0, 6500.0, 1e5])
def test_glowing_body_follows_plancks_law(kelvin: float) -> None:
    metres = GRID * 1e-9
    reach = scipy.constants.h * scipy.constants.c / scipy.constants.k / kelvin
    law = 1 / (metres**5 * np.expm1(reach / metres))
    at_560 = 1 / (560e-9**5 * np.expm1(reach / 560e-9))
    np.testing.assert_allclose(illuminants.planck(kelvin), law / at_560, rtol=1e-8)


@pytest.mark.parametrize("kelvin", [4000.0, 6504.0, 7000.0, 7001.0, 25000.0])
def test_daylight_agrees_with_the_cie(kelvin: float) -> None:
    xy = oracle.temperature.CCT_to_xy_CIE_D(kelvin)
    np.testing.assert_allclose(illuminants.daylight_xy(kelvin), xy, atol=1e-9)
    theirs = on_grid(oracle.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False))
    at_560 = theirs[GRID == 560]
    np.testing.assert_allclose(illuminants.daylight(kelvin), theirs / at_560, atol=2e-3)


@pytest.mark.parametrize(
    ("light", "name"), [(illuminants.fluorescent(), "FL11"), (illuminants.white_diode(), "LED-B3")]
)
def test_tube_and_diode_have_the_cies_white_and_spectrum(light: Floats, name: str) -> None:
    theirs = illuminant(name)
    np.testing.assert_allclose(
        xyz_to_xyy(observer.tristimulus(light, light))[:2], tabulated_xy(theirs), atol=0.004
    )
    scaled = theirs * (light @ theirs) / (theirs @ theirs)
    assert np.sqrt(np.mean((light - scaled) ** 2)) < 0.035 * light.max()


D65 = illuminants.daylight(illuminants.D65_K)


def test_matching_functions_are_near_the_cies_tables() -> None:
    """The bounds are the errors of the paper's own fits."""
    off = observer.OBSERVER - TABULATED
    assert (np.abs(off).max(axis=0) < [0.0147, 0.0071, 0.0239]).all()
    assert (np.sqrt(np.mean(off**2, axis=0)) < [0.0061, 0.0029, 0.0047]).all()


def test_chart_is_within_a_third_delta_e_of_its_measurements() -> None:
    names = {"sky": "blue sky", "white": "white 9.5 (.05 D)"}
    measured = oracle.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
    for name in surfaces.CHART:
        theirs = on_grid(measured[names.get(name, name.replace("-", " "))])
        np.testing.assert_allclose(surfaces.CHART[name], theirs[::5], atol=6e-4, err_msg=name)
        pair = observer.tristimulus(np.stack([surfaces.chart_patch(name), theirs]) * D65, D65)
        assert lab_distance(*xyz_to_lab(pair)) < 0.3, name


@pytest.fixture
def patches() -> Floats:
    chart = [surfaces.chart_patch(name) for name in surfaces.CHART]
    return np.stack([*chart, surfaces.dyed_cloth(420.0, 10.0), np.zeros(81), np.ones(81)])


def test_metamers_are_different_surfaces_of_the_same_colour(patches: Floats) -> None:
    twins = surfaces.metameric_twins(patches, D65)
    colours = observer.tristimulus(np.stack([patches, twins]) * D65, D65)
    np.testing.assert_allclose(colours[0], colours[1], atol=1e-12)
    assert (np.abs(twins - patches)[:11].max(axis=1) > 0.08).all()


def test_metamers_are_physical_and_differ_as_much_as_possible(patches: Floats) -> None:
    twins = surfaces.metameric_twins(patches, D65)
    assert twins.min() >= 0.0
    assert twins.max() <= 1.0
    inks = np.stack([spectra.bell(GRID, peak, 25.0, 25.0) for peak in surfaces.INKS_NM])
    for twin in twins[:12]:
        at_a_limit = np.isclose(twin, 0.0, atol=1e-12).any() or np.isclose(twin, 1.0).any()
        amounts = np.linalg.lstsq(inks.T, twin, rcond=None)[0]
        of_inks_alone = np.allclose(inks.T @ amounts, twin)
        assert at_a_limit or of_inks_alone
