"""A child nearby and an adult farther off: two people, one picture."""

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import circle, dot, line, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.projection.pinhole import project

CENTRE = (24.0, 150.0)
UNITS_PER_M = 60.0
FOCAL_M = 1.2  # focal length of a camera drawn many times too large
PEOPLE = ((1.2, 3.2, "child"), (1.8, 4.8, "adult"))  # height and distance in metres


def at(height: float, distance: float) -> tuple[float, float]:
    return CENTRE[0] + UNITS_PER_M * distance, CENTRE[1] - UNITS_PER_M * height


def image_height(height: float, distance: float) -> float:
    """Height of the image on a plane at the distance `FOCAL_M`."""
    K = np.diag([FOCAL_M, FOCAL_M, 1.0])
    return float(project(np.array([0.0, height, distance]), K)[0][1])


def person(height: float, distance: float) -> str:
    """A figure whose crown and soles are where the model has them."""
    x, top = at(height, distance)
    unit = UNITS_PER_M * height
    foot, shoulder, head = CENTRE[1], top + 0.24 * unit, 0.095 * unit
    sides = ((-0.13, shoulder), (0.13, shoulder), (0.09, foot), (-0.09, foot))
    body = [(x + across * unit, y) for across, y in sides]
    return circle((x, top + head), head, "world fill") + polygon(body, "world fill")


def draw() -> Illustration:
    x, z = PEOPLE[-1][0], PEOPLE[-1][1]
    crown = image_height(x, z)
    plane = at(0, FOCAL_M)
    marks = [
        line((6, CENTRE[1]), (394, CENTRE[1]), "muted thin"),
        *(person(height, distance) for height, distance, _ in PEOPLE),
        line(CENTRE, at(x * 1.1, z * 1.1), "ray"),
        line((plane[0], CENTRE[1] + 8), at(1.15, FOCAL_M), "image bold"),
        dot(at(crown, FOCAL_M), "image", 4.5),
        dot(plane, "image", 4.5),
        dot(CENTRE, "camera", 5),
        label((plane[0], at(1.15, FOCAL_M)[1] - 9), "image plane", "image", "middle"),
    ]
    for row, (height, distance, name) in enumerate(PEOPLE):
        beside = at(0.5 * height, distance)[0] + 0.2 * UNITS_PER_M * height
        marks.append(label((beside, at(0.42 * height, 0)[1]), name, "world"))
        marks.append(label((beside, at(0.42 * height, 0)[1] + 16), f"{height:g} m", "world small"))
        y = CENTRE[1] + 26 + 30 * row
        marks.append(dimension((CENTRE[0], y), (at(0, distance)[0], y), "muted"))
        middle = (CENTRE[0] + at(0, distance)[0]) / 2
        marks.append(label((middle, y - 6), f"{distance:g} m", "muted", "middle"))
    words = (
        f"A camera on the floor. A child {PEOPLE[0][0]:g} m tall at {PEOPLE[0][1]:g} m and an "
        f"adult {x:g} m tall at {z:g} m have their crowns on one ray, which meets the image plane "
        "in one point: both have the same height in the picture."
    )
    return Illustration((Panel("side", "", 400.0, 214.0, overlay="".join(marks)),), words)
