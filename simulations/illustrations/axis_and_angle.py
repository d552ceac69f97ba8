"""A rotation about an axis: the part along it stays, the part across it moves on a circle."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, dot, line, polyline
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.space.view import View, axes_towards
from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import from_axis_angle

SPACE = View(axes_towards((1.0, -2.6, 1.25)), (196.0, 236.0), 112.0)
AXIS = (0.0, 0.0, 1.0)
VECTOR = np.array([1.15, -0.35, 1.45])
ANGLE_RAD = math.radians(145)


def turned(angle_rad: float) -> Floats:
    """`VECTOR` turned about `AXIS`."""
    return from_axis_angle(AXIS, angle_rad) @ VECTOR


def component_along_axis() -> Floats:
    """The part of `VECTOR` along the axis."""
    axis = np.array(AXIS)
    return (VECTOR @ axis) * axis


def draw() -> Illustration:
    at = SPACE.at
    origin, hub = at(0, 0, 0), at(*component_along_axis())
    circle = SPACE.all([turned(angle) for angle in np.radians(np.arange(0, 361, 4))])
    path = SPACE.all([turned(angle) for angle in np.linspace(0.0, ANGLE_RAD, 31)])
    sideways = component_along_axis() + np.cross(AXIS, VECTOR)
    angle = SPACE.all(
        [
            component_along_axis() + 0.34 * (turned(a) - component_along_axis())
            for a in np.linspace(0.0, ANGLE_RAD, 31)
        ]
    )
    marks = [
        polyline(circle, "muted thin dashed"),
        arrow(origin, at(0, 0, 2.15), "camera bold"),
        line(hub, at(*VECTOR), "world thin"),
        line(hub, at(*turned(ANGLE_RAD)), "image thin"),
        arrow(hub, at(*sideways), "light"),
        polyline(path[:-1], "ray bold"),
        arrow(path[-3], path[-1], "ray bold"),
        polyline(angle, "ray"),
        arrow(origin, at(*VECTOR), "world bold"),
        arrow(origin, at(*turned(ANGLE_RAD)), "image bold"),
        dot(hub, "muted", 3.5),
        dot(origin, "muted", 3.5),
        label(np.add(at(0, 0, 2.15), (8, 8)), "n", "camera italic"),
        label(np.add(at(*VECTOR), (8, 4)), "p", "world italic"),
        label(np.add(at(*turned(ANGLE_RAD)), (-10, 0)), "R p", "image italic", "end"),
        label(np.add(at(*sideways), (8, 0)), "n × p", "light italic"),
        label(np.add(angle[12], (4, -5)), "θ", "ray italic ground"),
        label(np.add(at(*(0.55 * component_along_axis())), (9, 4)), "stays", "muted small"),
    ]
    words = (
        f"A vector p is turned by {math.degrees(ANGLE_RAD):.0f}° about an upright axis n. Its part "
        "along the axis stays; its tip runs round a circle about it. The vector n × p is as long "
        "as the radius of that circle and stands at right angles to it."
    )
    return Illustration((Panel("space", "", 400.0, 254.0, overlay="".join(marks)),), words)
