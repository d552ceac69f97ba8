"""The controls of the still life."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    focus: float = slider("Focus", 3.2, 1.8, 8.0, 0.1, unit="m")
    aperture: float = slider("Aperture", 2.0, 1.4, 22.0, 0.1, prefix="f/")
    light_angle: float = slider("Light angle", 40.0, -80.0, 80.0, 1.0, unit="°")
