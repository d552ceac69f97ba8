"""Pan and tilt in both orders: the same two turns, and two pictures."""

import math

import numpy as np

from simulations.engine.drafting import box, label
from simulations.engine.drawing import line, path
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import from_axis_angle
from simulations.models.projection.pinhole import project
from simulations.models.projection.vanishing import horizon

WIDTH, HEIGHT, FOCAL_PX = 320.0, 250.0, 250.0
K = np.array([[FOCAL_PX, 0.0, WIDTH / 2], [0.0, FOCAL_PX, HEIGHT / 2], [0.0, 0.0, 1.0]])
PAN = from_axis_angle((0.0, 1.0, 0.0), math.radians(30))
TILT = from_axis_angle((1.0, 0.0, 0.0), math.radians(20))
ORDERS = (
    ("hinge", "Pan below the hinge that tilts", PAN @ TILT),
    ("mast", "Tilt first, pan on the slanted mast", TILT @ PAN),
)
"""The camera's axes as columns. The last turn written is the first about the camera's own axes."""
DOWN = np.array([0.0, 1.0, 0.0])
POSTS_RAD = np.radians(np.arange(-20, 81, 10))
"""Directions of posts round the camera, from the world's straight ahead."""


def elevation_deg(axes: Floats) -> float:
    """Elevation of the camera's view above the horizon; y points down."""
    return math.degrees(math.asin(-axes[1, 2]))


def slant_deg(axes: Floats) -> float:
    """Slant of the horizon."""
    a, b, _ = horizon(axes.T @ DOWN, K)[0]
    return math.degrees(math.atan(-a / b))


def _picture(axes: Floats) -> list[str]:
    a, b, c = horizon(axes.T @ DOWN, K)[0]
    ends = [(x, -(a * x + c) / b) for x in (0.0, WIDTH)]
    posts = []
    for angle in POSTS_RAD:
        foot = np.array([10 * math.sin(angle), 0.0, 10 * math.cos(angle)])
        post, visible = project(np.stack([foot, foot - 3.2 * DOWN]) @ axes, K)
        if visible.all() and (post >= 0).all() and (post <= [WIDTH, HEIGHT]).all():
            posts.append(post)
    return [line(ends[0], ends[1], "world bold"), path(posts, "world")]


def draw() -> Illustration:
    panels, sentences = [], []
    for name, title, axes in ORDERS:
        up, slant = elevation_deg(axes), abs(slant_deg(axes))
        marks = [
            *_picture(axes),
            box((0.5, 0.5), WIDTH - 1, HEIGHT - 1, 2, "image thin"),
            line((WIDTH / 2 - 7, HEIGHT / 2), (WIDTH / 2 + 7, HEIGHT / 2), "camera"),
            line((WIDTH / 2, HEIGHT / 2 - 7), (WIDTH / 2, HEIGHT / 2 + 7), "camera"),
            label((12, 24), f"looks up by {up:.1f}°, horizon slants by {slant:.1f}°", "small"),
        ]
        panels.append(Panel(name, title, WIDTH, HEIGHT, overlay="".join(marks)))
        sentences.append(
            f"{title}: the camera looks up by {up:.1f}° and its horizon slants by {slant:.1f}°"
        )
    words = f"Two viewfinders after 30° of pan and 20° of tilt. {'; '.join(sentences)}."
    return Illustration(tuple(panels), words)
