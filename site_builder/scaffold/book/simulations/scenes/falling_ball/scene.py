"""A falling ball: its speed over time, with air and without."""

from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.falling import GRAVITY_M_S2, Floats, speed

LAST_S = 10.0
PLOT = Plot(Axis(0.0, LAST_S, 40.0, 388.0), Axis(0.0, 60.0, 240.0, 30.0))
TIMES = np.linspace(0.0, LAST_S, 201)


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    play: int = action("Drop it", "Pause", drives="time", effect="play", seconds=LAST_S)
    time: float = slider("Time", 2.0, 0.0, LAST_S, 0.1, unit="s")
    terminal: float = slider("Terminal speed", 30.0, 10.0, 60.0, 1.0, unit="m/s")


def fall(terminal: float) -> Floats:
    """Speeds (201,) at `TIMES`. A stage runs again only when what it reads has changed."""
    return speed(TIMES, terminal)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    now = float(speed(settings.time, settings.terminal))
    free = GRAVITY_M_S2 * settings.time
    marks = [
        PLOT.frame(Scale("time", "s"), Scale("speed", "m/s")),
        PLOT.level(settings.terminal, "error dashed thin"),
        PLOT.curve(TIMES, GRAVITY_M_S2 * TIMES, "muted dashed"),
        PLOT.curve(TIMES, outputs["fall"], "ray bold"),
        PLOT.mark(settings.time, now, "world"),
    ]
    return Frame(
        panels=(Panel("speed", "Speed over time", 400, 290, overlay="".join(marks)),),
        readouts=(
            readout("speed", "Speed", now, "m/s", role="ray"),
            readout("free", "Without air", free, "m/s"),
        ),
        description=(
            f"After {format_number(settings.time, 1)} s the ball falls at "
            f"{format_number(now)} m/s; without air it would fall at {format_number(free)} m/s."
        ),
    )


SCENE = Scene("falling-ball", "A Falling Ball", Settings, draw, (Stage("fall", fall),))
