"""The controls that the two figures on spectra share."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider, toggle
from simulations.scenes._spectra.choices import (
    COOLEST_K,
    HOTTEST_K,
    LIGHTS,
    NARROWEST_NM,
    STEP_K,
    SURFACES,
    WIDEST_NM,
)


@dataclass(frozen=True, slots=True)
class LitSurface:
    """A light and the surface that it falls on."""

    light: str = choice("Light", LIGHTS)
    temperature: float = slider("Colour temperature", 2850, COOLEST_K, HOTTEST_K, STEP_K, unit="K")
    surface: str = choice("Surface", SURFACES)
    band: float = slider("Cloth: band at", 605, 420, 660, 5, unit="nm")
    width: float = slider("Cloth: width σ", 45, NARROWEST_NM, WIDEST_NM, 5, unit="nm")
    twin: bool = toggle("Show the metameric twins")
