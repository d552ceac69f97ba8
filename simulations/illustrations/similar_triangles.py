"""Similar triangles: why the image place is f X / Z."""

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import dot, line, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.projection.pinhole import project

CENTRE = (34.0, 186.0)
UNITS_PER_M = 66.0
FOCAL, POINT = 2.0, (2.0, 5.0)
"""Drawn as metres: the place of the image plane, and X and Z of a point."""


def at(x: float, z: float) -> tuple[float, float]:
    """From above: depth to the right, sideways upwards."""
    return CENTRE[0] + UNITS_PER_M * z, CENTRE[1] - UNITS_PER_M * x


def image_of(x: float, z: float) -> float:
    """The image of the point on the image plane."""
    return float(project(np.array([x, 0.0, z]), np.diag([FOCAL, FOCAL, 1.0]))[0][0])


def draw() -> Illustration:
    x, z = POINT
    u = image_of(x, z)
    centre, foot, point = at(0, 0), at(0, z), at(x, z)
    marks = [
        polygon([centre, foot, point], "world fill thin"),
        polygon([centre, at(0, FOCAL), at(u, FOCAL)], "image fill thin"),
        line((12, CENTRE[1]), (392, CENTRE[1]), "muted thin dashed"),
        line(at(-0.62, FOCAL), at(2.2, FOCAL), "image bold"),
        line(at(u, FOCAL), at(0, FOCAL), "image bold"),
        line(foot, point, "world bold"),
        line(centre, point, "ray bold"),
        dot(point, "world", 5),
        dot(at(u, FOCAL), "image", 4.5),
        dot(centre, "camera", 5),
        dimension(at(-0.36, 0), at(-0.36, FOCAL), "camera"),
        dimension(at(-0.84, 0), at(-0.84, z), "world"),
        label((at(0, 1)[0], at(-0.36, 0)[1] + 16), "f", "camera italic", "middle"),
        label((at(0, z / 2)[0], at(-0.84, 0)[1] + 16), "Z", "world italic", "middle"),
        label((foot[0] + 10, at(x / 2, 0)[1] + 4), "X", "world italic"),
        label((at(u, FOCAL)[0] + 8, at(u / 2, 0)[1] + 6), "x = f X / Z", "image italic"),
        label((at(0, FOCAL)[0], at(2.2, 0)[1] - 8), "image plane", "image", "middle"),
        label((point[0] + 2, point[1] - 12), "point", "world", "middle"),
        label((centre[0] - 24, centre[1] - 12), "centre", "camera"),
    ]
    words = (
        f"Seen from above, a ray from the centre of projection to a point {x:g} to the side at "
        f"depth {z:g} crosses the image plane, at distance {FOCAL:g}, {u:g} to the side. The large "
        "triangle and the small one have the same angles."
    )
    panel = Panel("plan", "", 400.0, 262.0, overlay="".join(marks))
    return Illustration((panel,), words)
