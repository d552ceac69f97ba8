"""The spectra of the two figures: lights, surfaces, and what an eye in daylight sees of these."""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.color.illuminants import (
    D65_K,
    DAYLIGHT_K,
    daylight,
    fluorescent,
    planck,
    white_diode,
)
from simulations.models.color.spectra import WAVELENGTHS_NM
from simulations.models.color.surfaces import CHART, chart_patch, dyed_cloth, metameric_twins

DAYLIGHT = daylight(D65_K)
"""The light of the intended colours, in which the twins match."""
MEASURED = np.stack([chart_patch(name) for name in CHART])
"""(11, 81) the patches that do not change."""


def daylight_temperature(temperature_k: float) -> float:
    """The temperature, limited to the range of daylight."""
    return max(temperature_k, DAYLIGHT_K[0])


def light_of(light: str, temperature: float) -> Floats:
    """(81,) its power, with a mean of 1 over 400 to 700 nm."""
    match light:
        case "planck":
            power = planck(temperature)
        case "daylight":
            power = daylight(daylight_temperature(temperature))
        case "fluorescent":
            power = fluorescent()
        case _:
            power = white_diode()
    seen = (WAVELENGTHS_NM >= 400.0) & (WAVELENGTHS_NM <= 700.0)
    return power / power[seen].mean()


def surfaces_of(band: float, width: float) -> Floats:
    """(12, 81) reflectances, in the order of `choices.NAMES`."""
    return np.concatenate([dyed_cloth(band, width)[None], MEASURED])


def with_twins(surfaces: Floats) -> Floats:
    """(2, 12, 81) the surfaces, then others that match them in daylight."""
    return np.stack([surfaces, metameric_twins(surfaces, DAYLIGHT)])
