"""The controls of the formation pipeline."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider

LAST_STATION = 7.0


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    station: float = slider("Step", 0.0, 0.0, LAST_STATION, 0.02)
    play: int = action("Play", "Pause", drives="station", effect="play", seconds=14.0)
    step: int = action("Next step", drives="station", effect="step")
    distance: float = slider("Camera distance", 4.0, 2.0, 8.0, 0.1, unit="m")
    albedo: float = slider("Albedo ρ", 0.6, 0.0, 1.0, 0.01)
    again: int = action(*("Take another photo",) * 8)
