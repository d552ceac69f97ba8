"""The controls of the wagon wheel."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider

FRAMES = 96
PLAYED_PER_S = 6.0
"""Film frames a second: a quarter of the cinema's."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    play: int = action(
        *("Play", "Pause"),
        drives="time",
        effect="play",
        seconds=FRAMES / PLAYED_PER_S,
        arrival=True,
    )
    speed: float = slider("Speed", 2.9, -6, 6, 0.05, unit="turns/s")
    shutter: float = slider("Shutter open for", 0.1, 0, 1, 0.05, unit="of a frame")
    frame_rate: float = slider("Frame rate", 24, 8, 60, 1, unit="frames/s")
    spokes: int = slider("Spokes", 8, 2, 16, 1)
    time: float = slider("Time", 4, 0, FRAMES, 0.05, unit="frames")
