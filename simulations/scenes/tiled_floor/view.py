"""The camera over the tiled floor, and the lines drawn over its photograph and image plane."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.engine.handles import Point
from simulations.engine.plotting.clipping import clipped
from simulations.models.arrays import Floats, Mask
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.projection.level_ground import height_by_horizon, pose_above_ground
from simulations.models.projection.pinhole import intrinsics, project, world_to_camera
from simulations.models.projection.vanishing import horizon, vanishing_point
from simulations.pictures.tiled_floor import Box

WIDTH_PX, HEIGHT_PX = 400, 300
WIDTH, HEIGHT = float(WIDTH_PX), float(HEIGHT_PX)  # of both view boxes
SIDES = (0.0, WIDTH), (0.0, HEIGHT)
MIDDLE = (200.0, 150.0)  # the principal point before its shift
AXES = np.array([(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
"""Directions of the tiles' rows, of those across, and of vertical lines, with the vanishing points
v₁, v₂, v₃."""
NAMES = ("v₁", "v₂", "v₃")
AT_INFINITY_PX = 1e5
"""Vanishing points farther off count as infinite, as rounding keeps them from being exactly so."""
NEAREST_M = 0.05  # parts nearer to the plane of the camera's centre are not drawn
ROOM = 14.0  # height of a line of text, in units
NAME_WIDTH = 70.0  # of the horizon's label, with a margin, in units


@dataclass(frozen=True)  # without slots, for cached properties
class Camera:
    """A camera above the floor."""

    K: Floats
    pose: Floats
    """World to camera, (4, 4)."""
    height: float
    """Metres."""

    @cached_property
    def directions(self) -> Floats:
        """The three axes of the floor (3, 3) in the camera frame, one a row."""
        return AXES @ self.pose[:3, :3].T

    @cached_property
    def vanishing(self) -> tuple[Floats, Mask]:
        """Their vanishing points (3, 2) in pixels, and which of them are not at infinity."""
        pixels, valid = vanishing_point(self.directions, self.K)
        valid &= (np.abs(np.where(valid[:, None], pixels, 0.0)) < AT_INFINITY_PX).all(axis=1)
        return np.where(valid[:, None], pixels, np.nan), valid

    @cached_property
    def horizon(self) -> Floats:
        """Its line (3,), a² + b² = 1, positive below it."""
        line, _ = horizon(-self.directions[2], self.K)
        return line

    def image(self, points: Floats) -> tuple[Floats, Mask]:
        """Pixels (..., 2) of points of the world, and which of them are in front."""
        return project(world_to_camera(points, self.pose), self.K)

    def pixel(self, point: Floats) -> Floats:
        """Pixel (2,) of a point in front of the camera, in its frame."""
        image = self.K @ point
        return np.asarray(image[:2] / image[2])

    def end(self, point: Floats, direction: Floats) -> Floats:
        """End of the image of a line: its vanishing point, or a pixel very far away."""
        vanishing, start = self.K @ direction, self.pixel(point)
        if vanishing[2] > 0.0 and np.abs(vanishing[:2] / vanishing[2]).max() < AT_INFINITY_PX:
            return np.asarray(vanishing[:2] / vanishing[2])
        towards = vanishing[:2] - vanishing[2] * start
        return np.asarray(start + towards * (AT_INFINITY_PX / np.hypot(*towards)))


@lru_cache(maxsize=4)  # handles, overlays and readouts call it several times a frame
def camera(
    pitch: float,
    yaw: float,
    height: float,
    focal_length: float,
    roll: float,
    principal_x: float,
    principal_y: float,
) -> Camera:
    """The camera of these settings."""
    return Camera(
        K=intrinsics(focal_length, (MIDDLE[0] + principal_x, MIDDLE[1] + principal_y)),
        pose=pose_above_ground(height, *(math.radians(angle) for angle in (yaw, pitch, roll))),
        height=height,
    )


@dataclass(frozen=True, slots=True)
class Window:
    """A panel with the picture in its middle, so many widths of the picture wide."""

    widths: int

    def place(self, pixel: Floats) -> Point:
        """Pixel to view box."""
        margin = (self.widths - 1) / 2.0
        x, y = float(pixel[0]) + 0.5, float(pixel[1]) + 0.5
        return (x + margin * WIDTH) / self.widths, (y + margin * HEIGHT) / self.widths

    def pixel(self, place: Point) -> Point:
        """View box to pixel."""
        margin, (x, y) = (self.widths - 1) / 2.0, place
        return self.widths * x - margin * WIDTH - 0.5, self.widths * y - margin * HEIGHT - 0.5


PICTURE, PLANE = Window(1), Window(3)


def inside(place: Point, margin: float = 0.0) -> bool:
    """Whether a place lies in the panel."""
    x, y = place
    return margin <= x <= WIDTH - margin and margin <= y <= HEIGHT - margin


def near_upright(box: Box) -> Floats:
    """Foot and top (2, 3) of the edge of the box that is nearest to the camera."""
    xs, ys, (low, top) = box.spans
    x, y = (min(ends, key=abs) for ends in (xs, ys))
    return np.array([(x, y, low), (x, y, top)])


def height_in_picture(view: Camera, box: Box) -> float | None:
    """Height of the box, metres, from its image and the height of the camera; None if
    undetermined."""
    (foot, top), visible = view.image(near_upright(box))
    ratio, valid = height_by_horizon(foot, top, view.horizon, view.K @ view.directions[2])
    return float(ratio) * view.height if visible.all() and valid else None


def visible_edges(box: Box, height: float, axis: int) -> Iterator[Floats]:
    """Edges (2, 3) along one of `AXES` of the sides that a camera at that height sees."""
    drawn = set()
    for name in box.seen_from((0.0, 0.0, height)):
        corners = box.side(name)
        for edge in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            start, end = sorted(tuple(corner) for corner in edge)
            if abs(np.subtract(end, start) @ AXES[axis]) > 0.0 and start not in drawn:
                drawn.add(start)
                yield np.array([start, end])


def picture_overlay(view: Camera, box: Box, lines: bool) -> str:
    """The horizon, the lines of the box that meet on it, and the measurement of the box by it."""
    parts = (
        _towards_vanishing(view, box, (0, 1), PICTURE) if lines else "",
        _horizon(view, PICTURE),
        _upright(view, box),
        _handle_names(view, box),
        _vanishing_points(view, PICTURE),
    )
    return "".join(parts)


def plane_overlay(view: Camera, box: Box, lines: bool) -> str:
    """The horizon and the lines beyond the borders of the picture, and the lines of the
    uprights."""
    (x, y), width, height = PLANE.place(np.array([-0.5, -0.5])), WIDTH / 3, HEIGHT / 3
    parts = (
        drawing.rectangle((x, y), width, height, "image"),
        drawing.text((x + 3.0, y + height - 5.0), "picture", "image small ground"),
        _towards_vanishing(view, box, (0, 1, 2), PLANE) if lines else "",
        _horizon(view, PLANE),
        drawing.dot(PLANE.place(view.K[:2, 2]), "camera", 3.0),
        _vanishing_points(view, PLANE),
    )
    return "".join(parts)


def _towards_vanishing(view: Camera, box: Box, axes: tuple[int, ...], window: Window) -> str:
    """The box's edges, each produced to its vanishing point."""
    edges, produced = [], []
    for axis in axes:
        direction = view.directions[axis]
        away = direction if direction[2] >= 0.0 else -direction
        for edge in visible_edges(box, view.height, axis):
            ends = world_to_camera(edge, view.pose)
            if ends[:, 2].min() < NEAREST_M:
                continue
            near, far = ends if (ends[1] - ends[0]) @ away > 0.0 else ends[::-1]
            pixels = view.pixel(near), view.pixel(far), view.end(far, away)
            start, middle, end = (window.place(pixel) for pixel in pixels)
            edges.append(clipped(start, middle, *SIDES))
            produced.append(clipped(middle, end, *SIDES))
    return drawing.path([line for line in produced if line], "ray thin dashed") + drawing.path(
        [line for line in edges if line], "world"
    )


def _horizon(view: Camera, window: Window) -> str:
    """The horizon's line and label; its direction if it is not in the panel.

    The label is above its right end, or above the left one if a vanishing point is near the right.
    """
    a, b, c = view.horizon
    corners = window.pixel((0.0, 0.0)), window.pixel((WIDTH, HEIGHT))
    found = line_in_rectangle(view.horizon, *corners)
    if not len(found):
        above = b * (HEIGHT / 2.0) + a * (WIDTH / 2.0) + c > 0.0
        words = f"the horizon is {'above' if above else 'below'} the picture"
        place = (WIDTH / 2.0, 22.0 if above else HEIGHT - 12.0)
        return drawing.text(place, words, "camera ground", "middle")
    ends = window.place(found[0]), window.place(found[1])
    points = [window.place(pixel)[0] for pixel in view.vanishing[0][:2]]
    (x, y), anchor = max(ends), "end"
    if any(abs(x - other) < NAME_WIDTH for other in points):
        (x, y), anchor = min(ends), "start"
    baseline = (min(max(x, 6.0), WIDTH - 6.0), max(y - 7.0, 13.0))
    name = drawing.text(baseline, "horizon", "camera small ground", anchor)
    return drawing.line(*ends, "camera bold") + (name if inside(baseline, 6.0) else "")


def _upright(view: Camera, box: Box) -> str:
    """The nearest edge of the box, extended to the horizon, which is as high as the camera."""
    foot = near_upright(box)[0]
    pixels, visible = view.image(np.array([foot, (foot[0], foot[1], view.height)]))
    start, crossing = (PICTURE.place(pixel) for pixel in pixels)
    line = clipped(start, crossing, *SIDES) if visible.all() else None
    if line is None:
        return ""
    parts = [drawing.line(*line, "camera thin dashed")]
    if inside(crossing):
        parts.append(drawing.dot(crossing, "camera", 3.5))
    # On the side away from the horizon's own mark in the middle.
    side, anchor = (-7.0, "end") if crossing[0] < view.K[0, 2] else (7.0, "start")
    label = (crossing[0] + side, crossing[1] + 16.0)
    if inside(label, 3.0 * ROOM):
        words = f"{format_number(view.height, 1)} m"
        parts.append(drawing.text(label, words, "camera small ground", anchor))
    return "".join(parts)


def _handle_names(view: Camera, box: Box) -> str:
    """Labels to the right of the two handles of the box, for the settings that they change."""
    places = np.array([(box.x, box.y, height) for height in (0.0, box.height)])
    named = zip(("place", "height"), *view.image(places), strict=True)
    spots = [(name, PICTURE.place(pixel)) for name, pixel, visible in named if visible]
    return "".join(
        drawing.text((x + 13.0, y + 4.0), name, "world small ground")
        for name, (x, y) in spots
        if inside((x, y), 3.0 * ROOM)
    )


def _vanishing_points(view: Camera, window: Window) -> str:
    """The vanishing points in the panel, with their labels."""
    parts = []
    for name, pixel, finite in zip(NAMES, *view.vanishing, strict=True):
        if not finite or not inside(window.place(pixel)):
            continue
        x, y = window.place(pixel)
        parts.append(drawing.dot((x, y), "image", 4.0))
        baseline = (min(max(x, 10.0), WIDTH - 10.0), y - 15.0 if y > 2.0 * ROOM else y + 25.0)
        parts.append(drawing.text(baseline, name, "image strong ground", "middle"))
    return "".join(parts)
