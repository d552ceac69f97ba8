"""The plane w = 1: each of its points is a ray from the origin."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, dot, line, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.space.view import View, axes_towards

SPACE = View(axes_towards((1.1, -3.0, 1.35)), (64.0, 206.0), 59.0)
POINT = (2.0, 1.0)  # a point on the plane w = 1
ALONG = (0.5, 2.0)  # other values of w on its ray
FAR = (2.6, -0.9)  # a direction in the plane w = 0: a point at infinity


def on_ray(w: float) -> tuple[float, float, float]:
    """The triple of `POINT` with that last coordinate."""
    return w * POINT[0], w * POINT[1], w


def draw() -> Illustration:
    at = SPACE.at
    plane = [at(u, v, 1) for u, v in ((-0.5, -0.9), (3.1, -0.9), (3.1, 2.3), (-0.5, 2.3))]
    marks = [
        arrow(at(0, 0, 0), at(3.9, 0, 0), "muted"),
        arrow(at(0, 0, 0), at(0, 3.1, 0), "muted"),
        arrow(at(0, 0, 0), at(0, 0, 2.6), "muted"),
        arrow(at(0, 0, 0), at(*FAR, 0), "error dashed"),
        line(at(0, 0, 0), at(*on_ray(1)), "ray dashed"),
        polygon(plane, "image fill thin"),
        line(at(*on_ray(1)), at(*on_ray(2.25)), "ray"),
        dot(at(0, 0, 0), "camera", 4.5),
        dot(at(*on_ray(1)), "image", 5),
        *(dot(at(*on_ray(w)), "ray", 4) for w in ALONG),
        label(np.add(at(3.9, 0, 0), (4, 12)), "u", "muted italic"),
        label(np.add(at(0, 3.1, 0), (4, -6)), "v", "muted italic"),
        label(np.add(at(0, 0, 2.6), (-14, 6)), "w", "muted italic"),
        label(np.add(plane[0], (4, 16)), "w = 1", "image italic"),
        label(np.add(at(*on_ray(1)), (10, 4)), "(2, 1, 1)", "image ground"),
        label(np.add(at(*on_ray(2)), (10, 5)), "(4, 2, 2)", "ray ground"),
        label(np.add(at(*on_ray(0.5)), (10, 6)), "(1, 0.5, 0.5)", "ray ground"),
        label(np.add(at(*FAR, 0), (8, 4)), "w = 0", "error italic"),
        label(np.add(at(0, 0, 0), (-8, 16)), "(0, 0, 0)", "camera small", "middle"),
    ]
    words = (
        "Space with axes u, v and w, and in it the plane w = 1. One ray from the origin passes "
        "(1, 0.5, 0.5), pierces the plane in (2, 1, 1) and goes on to (4, 2, 2): all three stand "
        "for the point (2, 1). An arrow with w = 0 runs parallel to the plane and never meets it."
    )
    return Illustration((Panel("space", "", 400.0, 256.0, overlay="".join(marks)),), words)
