"""A pendulum and its period, in German."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import circle, line
from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage

G = 9.81
PIVOT = (200.0, 20.0)
UNITS_A_METRE = 60.0


@dataclass(frozen=True, slots=True)
class Settings:
    length: float = slider("Fadenlänge", 2.0, 0.5, 4.0, 0.05, unit="m")
    angle: float = slider("Ausschlag", 20, 0, 80, 1, unit="°")


def period(length: float, angle: float, tier: str) -> float:
    """Period in seconds; small angles, or by the arithmetic-geometric mean."""
    small = 2 * math.pi * math.sqrt(length / G)
    if tier == "small":
        return small
    one, other = 1.0, math.cos(math.radians(angle) / 2)
    for _ in range(5):
        one, other = (one + other) / 2, math.sqrt(one * other)
    return small / one


def draw(settings: Settings, outputs: Outputs) -> Frame:
    seconds = outputs["period"]
    angle, reach = math.radians(settings.angle), UNITS_A_METRE * settings.length
    weight = (PIVOT[0] + reach * math.sin(angle), PIVOT[1] + reach * math.cos(angle))
    marks = line(PIVOT, weight, "ray") + circle(weight, 8, "world solid")
    wall = np.full((28, 40, 4), 240, np.uint8)
    wall[..., 3] = 255
    said = f"{seconds:.2f}".replace(".", ",")
    return Frame(
        panels=(
            Panel("seite", "Von der Seite", 400, 280, overlay=marks),
            Panel("wand", "Die Wand dahinter", 400, 280, raster=wall),
        ),
        readouts=(readout("dauer", "Schwingungsdauer", seconds, "s", digits=2),),
        description=f"Ein Pendel, das {said} Sekunden braucht.",
    )


SCENE = Scene(
    id="fadenpendel",
    title="Fadenpendel",
    settings=Settings,
    draw=draw,
    stages=(Stage("period", period),),
    tiers=("small", "exact"),
    default_tier="exact",
    draft_tier="small",
    tier_labels={"small": "Kleine Winkel", "exact": "Genau"},
)
