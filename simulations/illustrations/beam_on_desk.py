"""A beam and a slanting desk, from the side: the plane's normal, its distance, and the spot."""

import math

import numpy as np

from simulations.engine.drafting import arc, dimension, label
from simulations.engine.drawing import arrow, dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry.lines_and_planes import plane_through, signed_distance

SCALE = 74.0
CORNERS = np.array([(0.0, 1.0, 3.0), (2.0, 1.0, 3.0), (0.0, 0.0, 4.0)])
"""Corners of the desk, in the camera's axes, in metres, as in the chapter's example."""
PLANE = plane_through(*CORNERS)[0]
BEAM = np.array([0.0, 0.0, 1.0])


def at(y: float, z: float) -> tuple[float, float]:
    return 34 + SCALE * z, 62 + SCALE * y


def spot() -> float:
    """Distance along the beam to the desk, in metres."""
    normal, distance = PLANE[:3], PLANE[3]
    return float(-distance / (normal @ BEAM))


def foot() -> Floats:
    """The point of the plane that is nearest to the camera."""
    return -signed_distance(np.zeros(3), PLANE) * PLANE[:3]


def draw() -> Illustration:
    far = float(signed_distance(np.zeros(3), PLANE))
    y, z = foot()[1:]
    corner, raised = CORNERS[0][1:], CORNERS[2][1:]
    middle = 0.7 * corner + 0.3 * raised
    tip = middle + 0.6 * PLANE[1:3]
    marks = [
        line(at(*raised), at(*(raised + 0.36 * (raised - corner))), "world thin dashed"),
        line(at(*corner), at(y, z), "world thin dashed"),
        line(at(*corner), at(*raised), "world bold"),
        line(at(*corner), at(corner[0], 4.6), "muted thin"),
        arc(at(*corner), 34, 0.0, math.radians(45), "muted"),
        label((at(*corner)[0] + 40, at(*corner)[1] - 10), "45°", "muted small"),
        dimension(at(0, 0), at(y, z), "camera"),
        label(np.add(at(y / 2, z / 2), (-12, 14)), f"d = {far:.2f} m", "camera", "end"),
        arrow(at(0, 0), at(0, spot()), "ray bold"),
        arrow(at(*middle), at(*tip), "image bold"),
        label(np.add(at(*tip), (-7, 4)), "n", "image italic", "end"),
        dot(at(0, spot()), "light", 5),
        dot(at(0, 0), "camera", 5),
        label(np.add(at(0, 0), (0, -14)), "camera", "camera", "middle"),
        label(np.add(at(0, spot()), (10, 18)), "spot", "light"),
        label(np.add(at(0, spot() / 2), (0, -9)), f"λ = {spot():g} m", "ray", "middle"),
        label(np.add(at(*corner), (-10, 4)), "desk", "world", "end"),
    ]
    words = (
        f"From the side: a desk that slants by 45°, in a plane {far:.2f} m from a camera and with "
        f"its normal towards it. A beam from the camera straight ahead meets it after {spot():g} m."
    )
    return Illustration((Panel("side", "", 400.0, 226.0, overlay="".join(marks)),), words)
