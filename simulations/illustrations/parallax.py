"""Parallax: points on one ray have one image, which a step aside separates by depth."""

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import arrow, dot, line, rectangle
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis
from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import intrinsics, project

WIDTH, HEIGHT = 320.0, 200.0
FOCAL_PX, STEP_M = 800.0, 0.1
PIXEL = 30.0  # column of the points in the first picture, from its middle to the right
DEPTHS_M = (2.0, 4.0, 8.0)
K = intrinsics(FOCAL_PX, (0.0, 0.0))
COLUMNS = Axis(-15.0, 35.0, 20, 300)
ROW = 96.0


def point(depth_m: float) -> Floats:
    """A point on the pixel's ray, in the first camera's axes."""
    return np.array([PIXEL / FOCAL_PX, 0.0, 1.0]) * depth_m


def column(depth_m: float) -> float:
    """Column of the point at a depth in the second picture."""
    return float(project(point(depth_m) - (STEP_M, 0.0, 0.0), K)[0][0])


def at(x: float, z: float) -> tuple[float, float]:
    """A place in the view from above, drawn some fifteen times too wide."""
    return 76 + 26 * z, 48 + 420 * x


def _plan() -> str:
    first, second = at(0, 0), at(STEP_M, 0)
    end = at(*point(8.6)[[0, 2]])
    star = np.add(second, 0.42 * np.subtract(end, first))
    marks = [
        line(first, end, "ray thin dashed"),
        arrow(second, star, "muted dashed"),
        *(line(second, at(*point(depth)[[0, 2]]), "ray thin") for depth in DEPTHS_M),
        dimension((first[0] - 14, first[1]), (second[0] - 14, second[1]), "camera"),
        dot(first, "camera", 5),
        dot(second, "camera", 5),
        label((first[0] - 24, first[1] + 4), "first", "camera", "end"),
        label((second[0] - 24, second[1] + 4), "second", "camera", "end"),
        label(np.add(star, (-2, 18)), "to the stars", "muted", "end"),
    ]
    for depth in DEPTHS_M:
        place = at(*point(depth)[[0, 2]])
        marks += [dot(place, "world", 5), label((place[0], place[1] - 12), f"{depth:g} m", "world")]
    return "".join(marks)


def _picture() -> str:
    places = {f"{depth:g} m": COLUMNS.place(column(depth)) for depth in DEPTHS_M}
    stars = COLUMNS.place(PIXEL)
    marks = [rectangle((8, 40), 304, 112, "image thin")]
    marks += [arrow((stars, ROW), (min(places.values()), ROW), "ray thin")]
    for name, place in {**places, "∞": stars}.items():
        role = "world" if name != "∞" else "muted"
        marks += [dot((place, ROW), role, 5), label((place, ROW - 14), name, role, "middle")]
    for depth, place in zip(DEPTHS_M, places.values(), strict=True):
        slide = f"−{PIXEL - column(depth):g} px"
        marks.append(label((place, ROW + 24), slide, "ray small", "middle"))
    return "".join(marks)


def draw() -> Illustration:
    slides = ", ".join(f"{PIXEL - column(depth):g} px at {depth:g} m" for depth in DEPTHS_M)
    words = (
        f"Three points on one ray of a camera. A second camera, {STEP_M:g} m to the right, sees "
        f"them side by side: to the left of where a star would be by {slides}."
    )
    panels = (
        Panel("plan", "From above", WIDTH, HEIGHT, overlay=_plan()),
        Panel("picture", "In the second picture", WIDTH, HEIGHT, overlay=_picture()),
    )
    return Illustration(panels, words)
