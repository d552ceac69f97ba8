"""The controls of the gimbal figure."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    pan: float = slider("Pan ψ", 60, -180, 180, 1, unit="°")
    tilt: float = slider("Tilt τ", 30, -90, 90, 1, unit="°")
    roll: float = slider("Roll ρ", -20, -180, 180, 1, unit="°")
    azimuth: float = slider("View azimuth", 51, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 28, -90, 90, 1, unit="°")
