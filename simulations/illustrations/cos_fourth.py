"""The four cosines of natural vignetting, each where it arises."""

import math

import numpy as np

from simulations.engine.drafting import arc, dimension, label
from simulations.engine.drawing import dot, line, polygon
from simulations.engine.illustration import Illustration, Panel, in_steps
from simulations.models.lens.vignetting import vignetting_cos4

OPENING, SENSOR, AXIS = 96.0, 296.0, 210.0
ANGLE_RAD = math.radians(38)
HALF, PIXEL = 22.0, 13.0
"""Half the opening, and half a pixel drawn large."""


def draw() -> Illustration:
    run = SENSOR - OPENING
    rise = run * math.tan(ANGLE_RAD)
    spot, middle = (SENSOR, AXIS - rise), (OPENING, AXIS)
    share = float(vignetting_cos4(math.tan(ANGLE_RAD)))
    narrow = HALF * math.cos(ANGLE_RAD)
    slanted = (narrow * math.sin(ANGLE_RAD), narrow * math.cos(ANGLE_RAD))
    opening = (OPENING, AXIS - HALF), (OPENING, AXIS + HALF)
    upper, lower = (SENSOR, spot[1] - PIXEL), (SENSOR, spot[1] + PIXEL)
    first = [
        line((20, AXIS), (SENSOR + 14, AXIS), "muted thin dashed"),
        polygon([*opening, lower, upper], "ray fill thin"),
        line(middle, spot, "ray"),
        *(
            line((OPENING, AXIS + s * HALF), (OPENING, AXIS + s * (HALF + 26)), "camera bold")
            for s in (-1, 1)
        ),
        line((SENSOR, 24), (SENSOR, AXIS + 30), "image bold"),
        line(upper, lower, "image bold"),
        polygon([upper, (SENSOR + 8, upper[1]), (SENSOR + 8, lower[1]), lower], "image solid"),
        arc(middle, 58, 0, ANGLE_RAD, "ray"),
        dot(middle, "camera", 3.5),
        dimension((OPENING, AXIS + 34), (SENSOR, AXIS + 34), "muted"),
        label((OPENING + 66, AXIS - 16), "θ", "ray italic"),
        label(((OPENING + SENSOR) / 2, AXIS + 29), "z_s", "muted italic", "middle"),
    ]
    second = [
        line(np.subtract(middle, slanted), np.add(middle, slanted), "camera"),
        label((OPENING - 12, AXIS - 78), "opening, seen at a slant:", "camera small", "middle"),
        label((OPENING - 12, AXIS - 62), "cos θ", "camera", "middle"),
    ]
    third = [
        label((OPENING + 58, AXIS - 134), "path longer by 1/cos θ:", "ray small", "middle"),
        label((OPENING + 58, AXIS - 118), "cos^2 θ", "ray", "middle"),
    ]
    fourth = [
        label((SENSOR + 18, spot[1] - 2), "lit at a slant:", "image small"),
        label((SENSOR + 18, spot[1] + 14), "cos θ", "image"),
    ]
    words = (
        f"Light through an opening reaches the sensor at {math.degrees(ANGLE_RAD):.0f}° to the "
        f"axis, and {100 * share:.0f} % of what falls on the axis is left."
    )
    overlay = in_steps(first, second, third, fourth)
    return Illustration((Panel("section", "", 400.0, 258.0, overlay=overlay),), words)
