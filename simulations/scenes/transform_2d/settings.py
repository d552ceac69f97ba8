"""The controls of the transform explorer."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, slider
from simulations.scenes.transform_2d.hierarchy import RUNGS


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    transform: str = choice("Transform", {name: rung.title for name, rung in RUNGS.items()})
    amount: float = slider("Amount", 30, 0, 100, 1)
    play: int = action("Play", "Pause", drives="amount", effect="play", seconds=8.0)
    point_x: float = slider("P, right (x)", 40, -60, 60, 1)
    point_y: float = slider("P, up (y)", 40, -60, 60, 1)
    pull_x: float = slider("Corner pulled right", 0, -150, 150, 1)
    pull_y: float = slider("Corner pulled up", 0, -150, 150, 1)
