"""The controls of the slanted edge."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    angle: float = slider("Slant of the edge", 5, 0, 20, 0.5, unit="°")
    aperture: float = slider("Aperture", 8, 2.8, 22, 0.1, prefix="f/")
    pitch: float = slider("Pixel pitch p", 4, 2, 8, 0.1, unit="µm")
