"""A Corner at Infinity: a homography of a square, up to where it divides by zero and beyond."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography, clip_half_plane
from simulations.scenes._mapped_square import family, plane

TABLE = np.array([(1.35, 0.45, 72.0), (0.0, 0.62, 24.0), (0.0, 0.0, 1.0)])
"""The plane before the map as a table seen at a slant, in the plane of its own panel."""
RISE = 30.0  # of the sheet over the table, for w = 1
SHEET = np.array([(-48.0, -145.0), (48.0, -145.0), (48.0, 46.0), (-48.0, 46.0)])
"""Ground plan of the sheet."""
CORNERS = np.array([(0, 0), (plane.WIDTH, 0), (plane.WIDTH, plane.HEIGHT), (0, plane.HEIGHT)])
LABEL = 106.0  # least column at which the label of P ends
HANDLE_X = 75.0  # of the handle on the line w = 0


@dataclass(frozen=True, slots=True)
class Settings:
    amount: float = slider("Amount", 24, 0, 100, 1)
    play: int = action("Play", "Pause", drives="amount", effect="play", seconds=8.0)
    point_x: float = slider("P, right (x)", 40, -60, 60, 1)
    point_y: float = slider("P, up (y)", -40, -60, 60, 1)


def point_of(settings: Settings) -> Floats:
    return np.array([settings.point_x, settings.point_y])


def matrix(settings: Settings) -> Floats:
    return family.transformation("projective", settings.amount)


def w_at(settings: Settings) -> float:
    """The third coordinate of the image of P, before the division."""
    return float(matrix(settings)[2] @ [*point_of(settings), 1.0])


def at_height(points: ArrayLike, heights: ArrayLike) -> Floats:
    """View box places (n, 2) of points (n, 2) of the table, so high above it."""
    places = apply_homography(TABLE, points)[0]
    return plane.to_view(places + np.multiply.outer(heights, (0.0, RISE)))


def divisor_overlay(settings: Settings) -> str:
    """The card on a table under a sheet whose height is w, and the side that is past infinity."""
    row, point, w = matrix(settings)[2], point_of(settings), w_at(settings)
    past = clip_half_plane(plane.from_view(CORNERS), -row @ np.linalg.inv(TABLE))
    sheet = clip_half_plane(SHEET, row)
    corners = np.vstack([family.SQUARE, point])
    feet, tops = at_height(corners, np.zeros(5)), at_height(corners, heights(row, corners))
    foot, top = feet[-1], tops[-1]
    below = max(foot[0] - 8.0, LABEL), foot[1] + 18.0
    return "".join(
        (
            plane.figure(TABLE, "world"),
            drawing.polygon(plane.to_view(past), "error fill faint") if len(past) > 2 else "",
            plane.labelled_line(row @ np.linalg.inv(TABLE), "w = 0", "error", "start"),
            drawing.path(np.stack([feet, tops], axis=1), "ray thin"),
            drawing.polygon(at_height(sheet, heights(row, sheet)), "ray fill"),
            drawing.line(foot, top, "ray bold"),
            drawing.dot(foot, "world", 4.5),
            drawing.text(below, f"P: w = {format_number(w, 2)}", "ray small ground", "end"),
        )
    )


def heights(row: Floats, points: Floats) -> Floats:
    """The third coordinates (n,) of the images of points (n, 2), for the last row of the matrix."""
    return points @ row[:2] + row[2]


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    H, point = matrix(settings), point_of(settings)
    w, area = w_at(settings), plane.area_ratio(H)
    square = (
        plane.axes(),
        plane.original(),
        plane.lines_at_infinity(H),
        plane.figure(H, "image"),
        plane.point_and_image(H, family.matrices_of_amounts("projective")[::4], point),
    )
    area_phrase = (
        "is cut where it reaches the line that is sent to infinity"
        if math.isinf(area)
        else f"has {format_number(area, 2)} times its area"
    )
    panel_size = plane.WIDTH, plane.HEIGHT
    drawn, title = "".join(square), "Before: divide by the height w"
    return Frame(
        (
            Panel("plane", "The card and its image", *panel_size, overlay=drawn, lead=True),
            Panel("divisor", title, *panel_size, overlay=divisor_overlay(settings)),
        ),
        (
            readout("w", "w at P", w, digits=3),
            readout("area", "Area, image : original", area, digits=3),
        ),
        f"The image of a square under a homography {area_phrase}. "
        f"{plane.describe_point(H, point)} There w is {format_number(w, 2)}.",
    )


def line_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The place of the line w = 0 at `HANDLE_X`, or the border before it comes into view."""
    a, b, c = matrix(settings)[2]
    y = -(a * HANDLE_X + c) / b if b else -math.inf
    x, row = at_height([(HANDLE_X, max(y, -170.0))], (0.0,))[0].tolist()
    return x, min(row, plane.HEIGHT - 8.0)


def image_at(settings: Settings, _outputs: Outputs) -> Point | None:
    image, valid = apply_homography(matrix(settings), point_of(settings))
    return tuple(plane.to_view(image).tolist()) if valid else None


SCENE = Scene(
    "lost-corner",
    "A Corner at Infinity",
    Settings,
    draw,
    handles=(
        Handle("image", "plane", "Image of P", ("amount",), image_at, role="image"),
        Handle(
            "point",
            "plane",
            "Point P",
            drives=("point_x", "point_y"),
            at=lambda settings, _: tuple(plane.to_view(point_of(settings)).tolist()),
            pull=lambda _, place: dict(
                zip(("point_x", "point_y"), plane.from_view(place).tolist(), strict=True)
            ),
            role="world",
        ),
        Handle("amount", "divisor", "Line w = 0", ("amount",), line_at, role="error"),
    ),
    formula=apply_homography,
)
