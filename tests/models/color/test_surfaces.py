"""Surfaces against their measurements, and twins against what makes them twins."""

import numpy as np
import pytest
from support.oracle_spectra import oracle, sampled

from simulations.models.arrays import Floats
from simulations.models.color import illuminants, observer, spectra, surfaces
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import xyz_to_lab
from simulations.models.color.spectra import WAVELENGTHS_NM as GRID

D65 = illuminants.daylight(illuminants.D65_K)


def test_the_chart_is_within_a_third_delta_e_of_its_measurements() -> None:
    names = {"sky": "blue sky", "white": "white 9.5 (.05 D)"}
    measured = oracle.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
    for name in surfaces.CHART:
        theirs = sampled(measured[names.get(name, name.replace("-", " "))])
        np.testing.assert_allclose(surfaces.CHART[name], theirs[::5], atol=6e-4, err_msg=name)
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
    white = xyz_to_xyy(observer.tristimulus(tube, tube))[:2]
    twins = surfaces.metameric_twins(patches, D65)
    ours, theirs = (
        xyz_to_lab(observer.tristimulus(each * tube, tube), white) for each in (patches, twins)
    )
    assert (lab_distance(ours, theirs)[:11] > 2.0).all()
