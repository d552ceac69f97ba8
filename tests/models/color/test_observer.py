"""The fitted eye against the CIE's own tables."""

import numpy as np
import pytest
from support.oracle_spectra import TABULATED, illuminant, tabulated_xy

from simulations.models.color import illuminants, observer, surfaces
from simulations.models.color.chromaticity import lab_distance, xyz_to_xyy
from simulations.models.color.cie import xyz_to_lab

D65 = illuminants.daylight(illuminants.D65_K)


def test_the_matching_functions_are_near_the_tables_of_the_cie() -> None:
    """As near as the paper's own fits come: any other numbers would be farther off."""
    off = observer.OBSERVER - TABULATED
    assert (np.abs(off).max(axis=0) < [0.0147, 0.0071, 0.0239]).all()
    assert (np.sqrt(np.mean(off**2, axis=0)) < [0.0061, 0.0029, 0.0047]).all()


@pytest.mark.parametrize("name", ["A", "D65", "FL2", "FL11", "LED-B3", "LED-B1"])
def test_whites_are_where_the_tables_put_them(name: str) -> None:
    light = illuminant(name)
    xy = xyz_to_xyy(observer.tristimulus(light, light))[:2]
    np.testing.assert_allclose(xy, tabulated_xy(light), atol=0.002)


def test_colours_of_the_chart_are_those_of_the_tables_within_two_delta_e() -> None:
    patches = np.stack([surfaces.chart_patch(name) for name in surfaces.CHART])
    ours = observer.tristimulus(patches * D65, D65)
    theirs = patches * D65 @ TABULATED / (D65 @ TABULATED[:, 1])
    assert lab_distance(xyz_to_lab(ours), xyz_to_lab(theirs)).max() < 2.0


def test_luminance_is_counted_from_the_white_of_the_light() -> None:
    for light in (D65, illuminants.planck(2000.0)):
        assert observer.tristimulus(0.25 * light, light)[1] == pytest.approx(0.25)
