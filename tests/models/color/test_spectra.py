"""Spectra, the eye's curves, lights and surfaces against SciPy and colour-science."""

import warnings

import numpy as np
import pytest
import scipy.constants
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from simulations.models.arrays import Floats
from simulations.models.color import illuminants, observer, spectra, surfaces
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import xyz_to_lab

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it misses packages for plotting
    import colour as oracle

GRID = spectra.WAVELENGTHS_NM
D65 = illuminants.daylight(illuminants.D65_K)


def sampled(distribution: object) -> NDArray[np.float64]:
    """A spectrum of colour-science on our grid."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it tells that it interpolates
        shape = oracle.SpectralShape(380, 780, 5)
        return np.asarray(distribution.copy().align(shape).values)  # type: ignore[attr-defined]


def illuminant(name: str) -> Floats:
    return sampled(oracle.SDS_ILLUMINANTS[name])


TABULATED = sampled(oracle.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"])


def tabulated_xy(light: Floats) -> Floats:
    """Chromaticity by the CIE's own tables."""
    xyz = light @ TABULATED
    return xyz[:2] / xyz.sum()


def fitted_xy(light: Floats) -> Floats:
    return xyz_to_xyy(observer.tristimulus(light, light))[:2]


def test_a_bell_is_half_as_high_at_the_root_of_2_ln_2_deviations() -> None:
    reach = np.sqrt(2 * np.log(2))
    heights = spectra.bell([500 - 20 * reach, 500.0, 500 + 40 * reach], 500.0, 20.0, 40.0)
    np.testing.assert_allclose(heights, [0.5, 1.0, 0.5])


def test_bells_add_up() -> None:
    one, other = (2.0, 450.0, 10.0, 20.0), (-0.5, 600.0, 30.0, 5.0)
    together = spectra.bells(GRID, (one, other))
    np.testing.assert_allclose(
        together, spectra.bells(GRID, (one,)) + spectra.bells(GRID, (other,))
    )


def test_the_curve_through_knots_is_scipys_natural_spline() -> None:
    values = np.random.default_rng(1).random((3, 17))
    knots = np.linspace(380, 780, 17)
    theirs = CubicSpline(knots, values, axis=-1, bc_type="natural")(GRID)
    np.testing.assert_allclose(spectra.through_knots(values), theirs, atol=1e-12)


def test_a_straight_line_of_three_knots_stays_straight() -> None:
    np.testing.assert_allclose(spectra.through_knots([0.0, 0.5, 1.0]), np.linspace(0, 1, 81))


def test_the_matching_functions_are_near_the_tables_of_the_cie() -> None:
    off = np.abs(observer.OBSERVER - TABULATED)
    assert off.max() < 0.075
    assert np.sqrt(np.mean(off**2)) < 0.012


@pytest.mark.parametrize("name", ["A", "D65", "FL2", "FL11", "LED-B3", "LED-B1"])
def test_whites_are_where_the_tables_put_them(name: str) -> None:
    light = illuminant(name)
    np.testing.assert_allclose(fitted_xy(light), tabulated_xy(light), atol=0.002)


def test_colours_of_the_chart_are_those_of_the_tables_within_two_delta_e() -> None:
    patches = np.stack([surfaces.chart_patch(name) for name in surfaces.CHART])
    ours = observer.tristimulus(patches * D65, D65)
    theirs = patches * D65 @ TABULATED / (D65 @ TABULATED[:, 1])
    assert lab_distance(xyz_to_lab(ours), xyz_to_lab(theirs)).max() < 2.0


@pytest.mark.parametrize("kelvin", [500.0, 2856.0, 6500.0, 1e5])
def test_a_glowing_body_follows_plancks_law(kelvin: float) -> None:
    metres = GRID * 1e-9
    reach = scipy.constants.h * scipy.constants.c / scipy.constants.k / kelvin
    law = 1 / (metres**5 * np.expm1(reach / metres))
    at_560 = 1 / (560e-9**5 * np.expm1(reach / 560e-9))
    np.testing.assert_allclose(illuminants.planck(kelvin), law / at_560, rtol=1e-8)


def test_illuminant_a_is_a_body_of_2856_kelvin() -> None:
    theirs = illuminant("A")
    found = illuminants.planck(2856.0)
    np.testing.assert_allclose(found, theirs / theirs[GRID == 560], rtol=2e-3)


@pytest.mark.parametrize("kelvin", [4000.0, 5003.0, 6504.0, 7000.0, 7001.0, 9500.0, 25000.0])
def test_daylight_is_the_cies(kelvin: float) -> None:
    xy = oracle.temperature.CCT_to_xy_CIE_D(kelvin)
    np.testing.assert_allclose(illuminants.daylight_xy(kelvin), xy, atol=1e-9)
    theirs = sampled(oracle.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False))
    at_560 = theirs[GRID == 560]
    np.testing.assert_allclose(illuminants.daylight(kelvin), theirs / at_560, atol=2e-3)


def test_d65_has_its_published_values() -> None:
    theirs = illuminant("D65")
    np.testing.assert_allclose(D65 * 100, theirs, atol=0.06)


@pytest.mark.parametrize(
    ("light", "name"), [(illuminants.fluorescent(), "FL11"), (illuminants.white_diode(), "LED-B3")]
)
def test_tube_and_diode_have_white_and_spectrum_of_the_cies(light: Floats, name: str) -> None:
    theirs = illuminant(name)
    np.testing.assert_allclose(fitted_xy(light), tabulated_xy(theirs), atol=0.004)
    scaled = theirs * (light @ theirs) / (theirs @ theirs)
    assert np.sqrt(np.mean((light - scaled) ** 2)) < 0.035 * light.max()


def test_the_chart_is_within_a_third_delta_e_of_its_measurements() -> None:
    names = {"sky": "blue sky", "white": "white 9.5 (.05 D)"}
    measured = oracle.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
    for name in surfaces.CHART:
        theirs = sampled(measured[names.get(name, name.replace("-", " "))])
        pair = observer.tristimulus(np.stack([surfaces.chart_patch(name), theirs]) * D65, D65)
        assert lab_distance(*xyz_to_lab(pair)) < 0.3, name


def test_a_cloth_has_half_of_its_band_at_half_the_width() -> None:
    cloth = surfaces.dyed_cloth(550.0, 30.0)
    right = 550.0 + 30.0 * np.sqrt(2 * np.log(2))
    middle = 0.5 * (surfaces.LEAST + surfaces.MOST)
    assert np.interp(right, GRID, cloth) == pytest.approx(middle, abs=0.005)
    assert cloth.max() == cloth[GRID == 550] == surfaces.MOST


@pytest.fixture
def patches() -> Floats:
    chart = [surfaces.chart_patch(name) for name in surfaces.CHART]
    return np.stack([*chart, surfaces.dyed_cloth(420.0, 10.0), np.zeros(81), np.ones(81)])


def test_twins_are_other_surfaces_of_the_same_colour(patches: Floats) -> None:
    twins = surfaces.metameric_twins(patches, D65)
    colours = observer.tristimulus(np.stack([patches, twins]) * D65, D65)
    np.testing.assert_allclose(colours[0], colours[1], atol=1e-12)
    assert (np.abs(twins - patches)[:11].max(axis=1) > 0.08).all()


def test_twins_are_surfaces_and_go_as_far_as_they_can(patches: Floats) -> None:
    twins = surfaces.metameric_twins(patches, D65)
    assert twins.min() >= 0.0
    assert twins.max() <= 1.0
    inks = np.stack([spectra.bell(GRID, peak, 25.0, 25.0) for peak in surfaces.INKS_NM])
    for twin in twins[:12]:
        at_a_limit = np.isclose(twin, 0.0, atol=1e-12).any() or np.isclose(twin, 1.0).any()
        amounts = np.linalg.lstsq(inks.T, twin, rcond=None)[0]
        of_inks_alone = np.allclose(inks.T @ amounts, twin)
        assert at_a_limit or of_inks_alone


def test_twins_part_in_another_light(patches: Floats) -> None:
    tube = illuminants.fluorescent()
    white = fitted_xy(tube)
    twins = surfaces.metameric_twins(patches, D65)
    ours, theirs = (
        xyz_to_lab(observer.tristimulus(each * tube, tube), white) for each in (patches, twins)
    )
    assert (lab_distance(ours, theirs)[:11] > 2.0).all()


def test_luminance_is_counted_from_the_white_of_the_light() -> None:
    for light in (D65, illuminants.planck(2000.0)):
        assert observer.tristimulus(0.25 * light, light)[1] == pytest.approx(0.25)
