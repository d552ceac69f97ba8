"""One lamp in two frames: the world's axes and a camera's, from above."""

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import arrow, dot, line, polygon
from simulations.engine.frame import Panel
from simulations.engine.illustration import Illustration
from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import invert_pose, look_at, world_to_camera

WIDTH, HEIGHT = 400.0, 224.0
ORIGIN, UNITS_PER_M = (48.0, 170.0), 30.0
CAMERA = (10.0, 0.0, 0.0)
LAMP = (2.0, -1.0, 3.0)
POSE = look_at(CAMERA, (0.0, 0.0, 0.0), (0.0, -1.0, 0.0))
"""World to camera; the world's axes are right, down and ahead."""


def above(point: Floats | tuple[float, float, float]) -> tuple[float, float]:
    """A world point from above: right to the right, ahead upwards."""
    return ORIGIN[0] + UNITS_PER_M * float(point[0]), ORIGIN[1] - UNITS_PER_M * float(point[2])


def from_camera(x: float, z: float) -> tuple[float, float]:
    """A place in the camera's frame, right and forward of it, from above."""
    return above((invert_pose(POSE) @ np.array([x, 0.0, z, 1.0]))[:3])


def draw() -> Illustration:
    x, _, z = (float(value) for value in world_to_camera(np.array(LAMP), POSE))
    lamp, camera, origin = above(LAMP), above(CAMERA), above((0.0, 0.0, 0.0))
    marks = [
        line(origin, camera, "muted thin dashed"),
        line(camera, lamp, "ray"),
        line(lamp, above((LAMP[0], 0.0, 0.0)), "camera thin dashed"),
        arrow(origin, above((1.6, 0.0, 0.0)), "world bold"),
        arrow(origin, above((0.0, 0.0, 1.6)), "world bold"),
        arrow(camera, from_camera(0, 1.6), "camera bold"),
        arrow(camera, from_camera(1.6, 0), "camera bold"),
        polygon([camera, from_camera(-0.35, -0.7), from_camera(0.35, -0.7)], "camera fill"),
        dimension(above((0.0, 0.0, 3.75)), above((LAMP[0], 0.0, 3.75)), "world"),
        dimension(above((-0.65, 0.0, 0.0)), above((-0.65, 0.0, LAMP[2])), "world"),
        dimension(above((CAMERA[0], 0.0, -0.95)), above((LAMP[0], 0.0, -0.95)), "camera"),
        dimension(above((11.1, 0.0, 0.0)), above((11.1, 0.0, LAMP[2])), "camera"),
        line(
            above((LAMP[0] + 0.5, 0.0, LAMP[2])), above((11.3, 0.0, LAMP[2])), "camera thin faint"
        ),
        dot(lamp, "light", 6),
        dot(origin, "world", 4.5),
        dot(camera, "camera", 4.5),
        label((lamp[0] + 10, lamp[1] - 8), "lamp", "light"),
        label(above((1.72, 0.0, -0.45)), "right", "world small", "middle"),
        label(above((0.2, 0.0, 1.35)), "ahead", "world small"),
        label((from_camera(0, 1.7)[0], camera[1] + 16), "forward", "camera small", "middle"),
        label((camera[0] - 8, from_camera(1.6, 0)[1] + 4), "right", "camera small", "end"),
        label(above((1.0, 0.0, 4.0)), f"{LAMP[0]:g} m", "world small", "middle"),
        label(above((-0.85, 0.0, 1.35)), f"{LAMP[2]:g} m", "world small", "end"),
        label(above((6.0, 0.0, -1.45)), f"{z:g} m", "camera small", "middle"),
        label(above((11.0, 0.0, 1.35)), f"{x:g} m", "camera small", "end"),
    ]
    words = (
        "From above: the world's origin, and a camera 10 m to its right that looks back at it. "
        f"The lamp is {LAMP[0]:g} m right and {LAMP[2]:g} m ahead in the world's frame, {x:g} m "
        f"right and {z:g} m forward in the camera's."
    )
    return Illustration((Panel("plan", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
