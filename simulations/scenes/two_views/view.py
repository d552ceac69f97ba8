"""A lamp in the room and two cameras: its images, the error of its depth, and the photographs.

Places in the left camera's frame are metres: X right, Y down, Z along its axis, which points
straight at the wall with the chart.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine import drawing
from simulations.engine.frame import Panel, Raster, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.projection.pinhole import intrinsics, project, rigid_pose
from simulations.models.projection.two_views import (
    depth_of_match,
    epipolar_lines,
    fundamental_matrix,
)
from simulations.world.furniture import HIGH
from simulations.world.room import photograph

HALF_WIDTH_PX, HALF_HEIGHT_PX = 100.0, 75.0
"""Half of each photograph, in pixels from the principal point."""
EYE = np.array([-0.25, -1.2, 1.2])
"""The left camera in the room, metres."""
FROM_ROOM = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Rotation (3, 3) from the room's axes to the left camera's."""
CEILING_Y = float(EYE[2] - HIGH[2])

WIDTH, HEIGHT = 400.0, 300.0
MIDDLE, UNITS_PER_PX = np.array([200.0, 150.0]), 2.0
MARKED_DEPTHS = (2.0, 4.0, 8.0, math.inf)  # on the epipolar line, metres
BORDERS = (-HALF_WIDTH_PX, -HALF_HEIGHT_PX), (HALF_WIDTH_PX, HALF_HEIGHT_PX)
LABEL_WIDTH = 34.0  # of a depth's label, in units
SHIFT_BELOW = 26.0  # from the images down to the disparity's arrow, in units


@dataclass(frozen=True, slots=True)
class Pair:
    """Two equal cameras; the right one is rotated about its vertical axis, towards the left
    one's."""

    focal_px: float
    baseline: float
    """Metres."""
    toe_in_rad: float

    @property
    def K(self) -> Floats:  # noqa: N802
        """Focal length of both; pixels are relative to the principal point."""
        return intrinsics(self.focal_px, (0.0, 0.0))

    @property
    def R(self) -> Floats:  # noqa: N802
        """Rotation (3, 3) from the left camera's frame to the right one's."""
        cos, sin = math.cos(self.toe_in_rad), math.sin(self.toe_in_rad)
        return np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])

    @property
    def t(self) -> Floats:
        """Place of the left camera in the right one's frame, metres."""
        return self.R @ np.array([-self.baseline, 0.0, 0.0])

    def line(self, left: Floats) -> Floats:
        """The epipolar line (3,) of a pixel of the left picture, a² + b² = 1."""
        F = fundamental_matrix(self.K, self.K, self.R, self.t)
        return epipolar_lines(F, left)[0]

    def right(self, point: Floats) -> Floats:
        """Pixels (..., 2) of points (..., 3) of the left camera's frame; NaN behind the camera."""
        return project(point @ self.R.T + self.t, self.K)[0]

    def vanishing(self, left: Floats) -> Floats:
        """The right camera's image of the end of a left pixel's ray."""
        return project(self.R @ [*(left / self.focal_px), 1.0], self.K)[0]

    def depth(self, left: Floats, right: Floats) -> float:
        """Depth of a left pixel with its match; ∞ also if the match is beyond infinity."""
        depth, valid = depth_of_match(left, right, self.K, self.K, self.R, self.t)
        return float(depth) if valid else math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class LampView:
    """The lamp in both pictures."""

    pair: Pair
    depth: float
    """Depth in metres from the left camera."""
    left: Floats
    right: Floats
    line: Floats
    nearest: float
    """The least depth that a match with its error may mean, metres ..."""
    farthest: float
    """... and the largest, which may be ∞."""
    matches: Floats
    """(2, 2) the match at those depths: on the epipolar line, the error to either side."""

    @property
    def point(self) -> Floats:
        """Place in the left camera's frame, metres."""
        return self.at(self.depth)

    @property
    def disparity(self) -> float:
        return float(self.left[0] - self.right[0])

    def at(self, depth: float) -> Floats:
        """Point of the left pixel's ray at a depth."""
        return np.array([*(self.left / self.pair.focal_px), 1.0]) * depth


def lamp_view(pair: Pair, depth: float, left: Floats, error_px: float) -> LampView:
    """The view of a lamp at a pixel of the left picture, and with an error of its match."""
    right = pair.right(np.array([*(left / pair.focal_px), 1.0]) * depth)
    line = pair.line(left)
    towards_near = np.array([line[1], -line[0]])
    towards_near *= math.copysign(1.0, float(towards_near @ (right - pair.vanishing(left))))
    matches = np.array([right + error_px * towards_near, right - error_px * towards_near])
    near, far = (pair.depth(left, match) for match in matches)
    return LampView(
        pair=pair,
        depth=depth,
        left=left,
        right=right,
        line=line,
        nearest=near,
        farthest=far,
        matches=matches,
    )


def in_picture(pixel: Floats) -> bool:
    """Whether a pixel lies within the edges of a picture."""
    return bool(abs(pixel[0]) <= HALF_WIDTH_PX and abs(pixel[1]) <= HALF_HEIGHT_PX)


def place(pixel: ArrayLike) -> Floats:
    """Pixel to view box."""
    return MIDDLE + UNITS_PER_PX * np.asarray(pixel)


def pixel_at(spot: drawing.Point) -> Floats:
    """View box to pixel."""
    return (np.asarray(spot, float) - MIDDLE) / UNITS_PER_PX


def photo(pair: Pair, columns: int, right: bool) -> Raster:
    """The room through one of the cameras."""
    return photograph(pair.focal_px * columns / (2 * HALF_WIDTH_PX), pose_of(pair, right), columns)


def pose_of(pair: Pair, right: bool) -> Floats:
    """From the room to one of the cameras, (4, 4)."""
    left = rigid_pose(FROM_ROOM, -FROM_ROOM @ EYE)
    return rigid_pose(pair.R, pair.t) @ left if right else left


def by_turns_panel(view: LampView, photo: Raster, right: bool) -> Panel:
    """One photograph in the place of the other."""
    pixel = view.right if right else view.left
    title = f"What the {'right' if right else 'left'} camera sees"
    return Panel("turns", title, WIDTH, HEIGHT, photo, _lamp(view, pixel, right), lead=True)


def right_panel(view: LampView, photo: Raster) -> Panel:
    """The lamp, and the epipolar line: whole, and bold from 1 m to infinity; its row is that of the
    match for parallel cameras."""
    row = float(view.left[1])
    parts = [
        _clipped_polyline([(-HALF_WIDTH_PX, row), (HALF_WIDTH_PX, row)], "muted thin dashed"),
        _clipped_polyline(line_in_rectangle(view.line, *BORDERS), "ray thin faint"),
        _clipped_polyline([view.pair.right(view.at(1.0)), view.pair.vanishing(view.left)], "ray"),
        _depths(view),
        _disparity(view),
        _lamp(view, view.right, right=True),
    ]
    return Panel("right", "Where the right camera sees it", WIDTH, HEIGHT, photo, "".join(parts))


def _lamp(view: LampView, pixel: Floats, right: bool) -> str:
    """The lamp on its cord, or its direction if it is outside the picture."""
    hook = view.point * (1.0, 0.0, 1.0) + (0.0, min(CEILING_Y, view.point[1]), 0.0)
    above = view.pair.right(hook) if right else project(hook, view.pair.K)[0]
    return _clipped_polyline([above, pixel], "world thin") + _image(pixel)


def _clipped_polyline(ends: ArrayLike, style: str) -> str:
    """A polyline, in pixels, clipped to the picture."""
    points = clip_to_rectangle(ends, *BORDERS, closed=False)
    return drawing.polyline([place(point) for point in points], style) if len(points) > 1 else ""


def _image(pixel: Floats) -> str:
    """The lamp, or its direction if it is outside the picture."""
    if not in_picture(pixel):
        text = f"outside, to the {'left' if pixel[0] < 0 else 'right'}"
        return drawing.text((WIDTH / 2.0, 22.0), text, "image ground", "middle")
    return drawing.dot(place(pixel), "image", 5.0)


def _depths(view: LampView) -> str:
    """Marks on the line, with labels above it; those near one another or the lamp are left out."""
    parts, taken = [], [float(place(view.right)[0])]
    for depth in MARKED_DEPTHS:
        endless = math.isinf(depth)
        pixel = view.pair.vanishing(view.left) if endless else view.pair.right(view.at(depth))
        if not in_picture(pixel):
            continue
        x, y = place(pixel)
        if all(abs(x - other) >= LABEL_WIDTH for other in taken) and 20.0 < x < WIDTH - 20.0:
            taken.append(float(x))
            words = "∞" if endless else f"{depth:.0f} m"
            parts.append(drawing.dot((x, y), "ray", 3.0))
            above = (x, y - 12.0 if y > 30.0 else y + 20.0)
            parts.append(drawing.text(above, words, "ray small ground", "middle"))
    return "".join(parts)


def _disparity(view: LampView) -> str:
    """The shift from the lamp's place in the left picture to that in the right one, with the
    error."""
    parts = [_clipped_polyline(view.matches, "error bold")]
    if in_picture(view.left) and in_picture(view.right):
        start, end = place(view.left), place(view.right)
        row = max(start[1], end[1]) + SHIFT_BELOW
        ends = (start[0], row), (end[0], row)
        words = f"d = {format_number(view.disparity, 1)} px"
        left, right = sorted((float(start[0]), float(end[0])))
        fits = right < WIDTH - 90.0
        beside = (right + 10.0 if fits else left - 10.0, row + 4.0)
        parts += [
            drawing.line(start, ends[0], "image thin dashed"),
            drawing.line(end, ends[1], "image thin dashed"),
            drawing.arrow(*ends, "image"),
            drawing.circle(start, 5.0, "image"),
            drawing.text(beside, words, "image small ground", "start" if fits else "end"),
        ]
    return "".join(parts)
