"""Why a straight rail ends in the picture: the rays to it approach its own direction."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, circle, dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.models.projection.pinhole import project
from simulations.models.projection.vanishing import vanishing_point

CENTRE, UNITS_PER_M = (128.0, 262.0), 36.0
FOCAL = 2.0  # distance of the image plane, in the metres of the drawing
START, ANGLE_RAD = (-2.0, 2.9), math.radians(32)
"""Start of the rail, X and Z, and its angle with the optical axis, to the right."""
STRIDE_M, STRIDES = 1.5, 11
K = np.diag([FOCAL, FOCAL, 1.0])


def at(x: float, z: float) -> tuple[float, float]:
    """From above: depth upwards, right to the right."""
    return CENTRE[0] + UNITS_PER_M * x, CENTRE[1] - UNITS_PER_M * z


def on_rail(metres: float) -> tuple[float, float]:
    """X and Z at a distance along the rail."""
    return START[0] + metres * math.sin(ANGLE_RAD), START[1] + metres * math.cos(ANGLE_RAD)


def image(metres: float) -> float:
    x, z = on_rail(metres)
    return float(project(np.array([x, 0.0, z]), K)[0][0])


def end() -> float:
    """The vanishing point of the rail."""
    return float(vanishing_point((math.sin(ANGLE_RAD), 0.0, math.cos(ANGLE_RAD)), K)[0][0])


def draw() -> Illustration:
    far = (7.6 * math.sin(ANGLE_RAD), 7.6 * math.cos(ANGLE_RAD))
    centre = at(0, 0)
    marks = [
        line(at(-3.0, FOCAL), at(4.4, FOCAL), "image bold"),
        arrow(at(*on_rail(-1.6)), at(*on_rail(4.9)), "world bold"),
        line(centre, at(*far), "light dashed"),
    ]
    for metres in STRIDE_M * np.arange(STRIDES):
        if on_rail(metres)[1] < 7.6:
            marks += [
                line(centre, at(*on_rail(metres)), "ray thin"),
                dot(at(*on_rail(metres)), "world", 4),
            ]
        marks.append(dot(at(image(metres), FOCAL), "image", 2.5))
    vanish = at(end(), FOCAL)
    marks += [
        circle(vanish, 7, "light bold"),
        dot(centre, "camera", 5),
        label((vanish[0] + 12, vanish[1] + 20), "vanishing point", "light ground"),
        label((centre[0] + 12, centre[1] + 6), "centre of projection", "camera"),
        label((at(4.4, FOCAL)[0] + 6, vanish[1] - 8), "image plane", "image", "end"),
        label(np.add(at(*on_rail(4.5)), (-14, 4)), "rail", "world", "end"),
        label(np.add(at(*far), (12, 20)), "parallel to the rail", "light"),
    ]
    words = (
        f"From above: a straight rail runs off at {math.degrees(ANGLE_RAD):.0f}° to the right of "
        "the optical axis. The images of equal strides along it become shorter and shorter towards "
        "the point in which the ray parallel to the rail meets the image plane, and never pass it."
    )
    return Illustration((Panel("plan", "", 400.0, 286.0, overlay="".join(marks)),), words)
