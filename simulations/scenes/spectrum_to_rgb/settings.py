"""The controls of the figure of a sensor's colours."""

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

SENSORS = {"camera": "A camera's", "eye": "The eye's, x̄ ȳ z̄"}
MATRICES = {"daylight": "Made for daylight", "own": "Made for this light"}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    light: str = choice("Light", LIGHTS)
    temperature: float = slider("Colour temperature", 2850, COOLEST_K, HOTTEST_K, STEP_K, unit="K")
    matrix: str = choice("Colour matrix", MATRICES)
    surface: str = choice("Surface", SURFACES)
    sensor: str = choice("Curves of the sensor", SENSORS)
    band: float = slider("Cloth: band at", 605, 420, 660, 5, unit="nm")
    width: float = slider("Cloth: width σ", 45, NARROWEST_NM, WIDEST_NM, 5, unit="nm")
    twin: bool = toggle("Show the metameric twins")
