"""The polar diagram of the BRDF figure: brightness of a point by direction of the camera.

The normal points up; angles count from it, positive to the right.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, arrow, circle, dot, line, polygon, polyline, text
from simulations.models.arrays import Floats
from simulations.scenes._ball.marks import HEIGHT, WIDTH, lamp
from simulations.scenes.brdf.stages import AROUND_DEG

FOOT = (WIDTH / 2, 262.0)
LAMP, CAMERA = 186.0, 170.0
"""Drawn distances of lamp and camera from the foot; both are far away."""
LONGEST = 165.0
"""Largest length of the lobe, in units of the view box."""
UNIT = 140.0
"""Length of a brightness of 1, unless the lobe would be too long."""

APART_DEG = 14.0
"""Least angle between the camera and the mirror direction for the label of the latter."""


def towards(angle_deg: float, length: float) -> tuple[float, float]:
    """The place at an angle from the normal and a distance from the foot."""
    turn = math.radians(angle_deg)
    return FOOT[0] + length * math.sin(turn), FOOT[1] - length * math.cos(turn)


def lobe_plot(light_deg: float, view_deg: float, lobe: Floats, seen: float) -> str:
    """Light, camera, and the lobe: brightness (90,) by direction; ``seen`` is that of the
    camera."""
    unit = min(UNIT, LONGEST / max(float(lobe.max()), 1e-9))
    outline = [
        towards(a, unit * b) for a, b in zip(AROUND_DEG.tolist(), lobe.tolist(), strict=True)
    ]
    at = towards(view_deg, unit * seen)
    light, eye = towards(light_deg, LAMP), towards(view_deg, CAMERA)
    return "".join(
        (
            *_ground(unit),
            polygon([FOOT, *outline], "ray fill"),
            arrow(FOOT, towards(0, 150), "world"),
            text(towards(2.2, 157), "n", "world strong ground", "middle"),
            line(FOOT, towards(-light_deg, 160), "muted thin dashed"),
            _mirror(light_deg, view_deg),
            arrow(light, towards(light_deg, 5), "light bold"),
            *lamp(light),
            line(FOOT, eye, "camera bold"),
            *(circle(eye, 6, "casing"), dot(eye, "camera", 5.5)),
            *(circle(at, 5.5, "casing"), dot(at, "image", 5)),
            dot(FOOT, "world", 4.5),
        )
    )


def _mirror(light_deg: float, view_deg: float) -> str:
    """The label of the mirror direction, unless the camera is too near."""
    if abs(light_deg + view_deg) < APART_DEG:
        return ""
    return text(towards(-light_deg, 170), "mirror", "muted small ground", "middle")


def angle_at(place: Point) -> float:
    """Degrees from the normal, as seen from the foot; clamped below the surface."""
    across, up = float(place[0]) - FOOT[0], FOOT[1] - float(place[1])
    return math.degrees(math.atan2(across, up)) if across or up else 0.0


def _ground(unit: float) -> Iterator[str]:
    """The surface, and circles of the brightness ½, 1, 2 … that fit."""
    yield line((16, FOOT[1]), (WIDTH - 16, FOOT[1]), "world bold")
    yield text((18, FOOT[1] + 20), "surface", "world small")
    for level, name in ((0.5, "½"), (1.0, "1"), (2.0, "2"), (5.0, "5"), (10.0, "10")):
        radius = unit * level
        if 28.0 <= radius <= LONGEST + 6.0:
            around = np.linspace(-90.0, 90.0, 31)
            yield polyline([towards(float(a), radius) for a in around], "muted thin faint")
            place = (FOOT[0] + radius, FOOT[1] + 16)
            yield text(place, name, "muted small", "middle")
    yield text((FOOT[0] + 60, HEIGHT - 34), "circles: brightness", "muted small", "middle")
