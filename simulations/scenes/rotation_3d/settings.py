"""The controls of the rotation figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, slider
from simulations.scenes.rotation_3d.sphere import LABELS


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    blend: str = choice("Blend", LABELS)
    t: float = slider("Progress s", 0.5, 0, 1, 0.01)
    play: int = action("Play", "Pause", drives="t", effect="play", seconds=6.0)
    pan: float = slider("Pan ψ at the end", 120, -180, 180, 1, unit="°")
    tilt: float = slider("Tilt τ at the end", 60, -90, 90, 1, unit="°")
    roll: float = slider("Roll ρ at the end", 75, -180, 180, 1, unit="°")
    azimuth: float = slider("View azimuth", 51, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 28, -90, 90, 1, unit="°")
