"""The controls of the figure of a sensor's colours."""

from dataclasses import dataclass

from simulations.engine.settings import choice
from simulations.scenes._spectra.settings import LitSurface

SENSORS = {"camera": "A camera's", "eye": "The eye's, x̄ ȳ z̄"}
MATRICES = {"daylight": "Made for daylight", "own": "Made for this light"}


@dataclass(frozen=True, slots=True)
class Settings(LitSurface):
    """The settings of the figure."""

    matrix: str = choice("Colour matrix", MATRICES)
    sensor: str = choice("Curves of the sensor", SENSORS)
