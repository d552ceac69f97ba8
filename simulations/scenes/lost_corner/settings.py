"""The controls of the figure of a corner at infinity."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    amount: float = slider("Amount", 24, 0, 100, 1)
    play: int = action("Play", "Pause", drives="amount", effect="play", seconds=8.0)
    point_x: float = slider("P, right (x)", 40, -60, 60, 1)
    point_y: float = slider("P, up (y)", -40, -60, 60, 1)
