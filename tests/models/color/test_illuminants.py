"""Lights against Planck's law and the CIE's illuminants."""

import numpy as np
import pytest
import scipy.constants
from support.oracle_spectra import illuminant, oracle, sampled, tabulated_xy

from simulations.models.arrays import Floats
from simulations.models.color import illuminants, observer
from simulations.models.color.chromaticity import xyz_to_xyy
from simulations.models.color.spectra import WAVELENGTHS_NM as GRID


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


@pytest.mark.parametrize("kelvin", [4000.0, 6504.0, 7000.0, 7001.0, 25000.0])
def test_daylight_is_the_cies(kelvin: float) -> None:
    xy = oracle.temperature.CCT_to_xy_CIE_D(kelvin)
    np.testing.assert_allclose(illuminants.daylight_xy(kelvin), xy, atol=1e-9)
    theirs = sampled(oracle.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False))
    at_560 = theirs[GRID == 560]
    np.testing.assert_allclose(illuminants.daylight(kelvin), theirs / at_560, atol=2e-3)


@pytest.mark.parametrize(
    ("light", "name"), [(illuminants.fluorescent(), "FL11"), (illuminants.white_diode(), "LED-B3")]
)
def test_tube_and_diode_have_white_and_spectrum_of_the_cies(light: Floats, name: str) -> None:
    theirs = illuminant(name)
    np.testing.assert_allclose(
        xyz_to_xyy(observer.tristimulus(light, light))[:2], tabulated_xy(theirs), atol=0.004
    )
    scaled = theirs * (light @ theirs) / (theirs @ theirs)
    assert np.sqrt(np.mean((light - scaled) ** 2)) < 0.035 * light.max()
