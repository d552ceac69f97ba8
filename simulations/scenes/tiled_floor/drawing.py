"""Drawings over the photograph of the floor, and over its image plane."""

from collections.abc import Callable

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.engine.plotting.clipping import clipped
from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.projection.pinhole import world_to_camera
from simulations.pictures.tiled_floor import Box
from simulations.scenes.tiled_floor.stages import WIDER
from simulations.scenes.tiled_floor.view import (
    AT_INFINITY_PX,
    HEIGHT_PX,
    WIDTH_PX,
    Camera,
    near_upright,
    visible_edges,
)

WIDTH, HEIGHT = float(WIDTH_PX), float(HEIGHT_PX)
PANEL = (0.0, WIDTH), (0.0, HEIGHT)
NAMES = ("v₁", "v₂", "v₃")
NEAREST_M = 0.05
"""Parts nearer to the plane of the camera's centre are not drawn."""
ROOM = 14.0
"""Height of a line of text, in units."""
NAME_WIDTH = 70.0
"""Width of the horizon's label, with a margin, in units."""

type Point = tuple[float, float]
type Place = Callable[[Floats], Point]
"""A map from a pixel to the view box of a panel."""


def in_picture(pixel: Floats) -> Point:
    """Pixel to the picture's view box, whose unit is a pixel."""
    return float(pixel[0]) + 0.5, float(pixel[1]) + 0.5


def in_plane(pixel: Floats) -> Point:
    """Pixel to the image plane's view box; the picture is in the middle third."""
    x, y = in_picture(pixel)
    return (x + WIDTH) / WIDER, (y + HEIGHT) / WIDER


def from_picture(place: Point) -> Point:
    """The pixel at a place of the picture: the inverse of `in_picture`."""
    return place[0] - 0.5, place[1] - 0.5


def from_plane(place: Point) -> Point:
    """The pixel at a place of the image plane: the inverse of `in_plane`."""
    return from_picture((WIDER * place[0] - WIDTH, WIDER * place[1] - HEIGHT))


def inside(place: Point, margin: float = 0.0) -> bool:
    """Whether a place lies in the panel."""
    x, y = place
    return margin <= x <= WIDTH - margin and margin <= y <= HEIGHT - margin


def picture_overlay(view: Camera, box: Box, lines: bool) -> str:
    """The horizon, the lines of the box that meet on it, and the measurement of the box by it."""
    return "".join(
        (
            towards_vanishing(view, box, (0, 1), in_picture) if lines else "",
            horizon(view, in_picture, from_picture),
            upright(view, box),
            handle_names(view, box),
            vanishing_points(view, in_picture),
        )
    )


def plane_overlay(view: Camera, box: Box, lines: bool) -> str:
    """The same beyond the borders of the picture, and the vanishing point of vertical lines."""
    corner, size = in_plane(np.array([-0.5, -0.5])), (WIDTH / WIDER, HEIGHT / WIDER)
    principal = in_plane(view.K[:2, 2])
    return "".join(
        (
            drawing.rectangle(corner, *size, "image"),
            drawing.text(
                (corner[0] + 3.0, corner[1] + size[1] - 5.0), "picture", "image small ground"
            ),
            towards_vanishing(view, box, (0, 1, 2), in_plane) if lines else "",
            horizon(view, in_plane, from_plane),
            drawing.dot(principal, "camera", 3.0),
            vanishing_points(view, in_plane),
        )
    )


def towards_vanishing(view: Camera, box: Box, axes: tuple[int, ...], place: Place) -> str:
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
            edges.append(clipped(place(_pixel(view, near)), place(_pixel(view, far)), *PANEL))
            produced.append(clipped(place(_pixel(view, far)), place(_end(view, far, away)), *PANEL))
    return drawing.path([line for line in produced if line], "ray thin dashed") + drawing.path(
        [line for line in edges if line], "world"
    )


def _pixel(view: Camera, point: Floats) -> Floats:
    image = view.K @ point
    return np.asarray(image[:2] / image[2])


def _end(view: Camera, point: Floats, direction: Floats) -> Floats:
    """End of the image of a line: its vanishing point, or a point very far away."""
    vanishing, start = view.K @ direction, _pixel(view, point)
    if vanishing[2] > 0.0 and np.abs(end := vanishing[:2] / vanishing[2]).max() < AT_INFINITY_PX:
        return np.asarray(end)
    towards = vanishing[:2] - vanishing[2] * start
    return np.asarray(start + towards * (AT_INFINITY_PX / np.hypot(*towards)))


def horizon(view: Camera, place: Place, back: Callable[[Point], Point]) -> str:
    """The horizon's line and label; its direction if it is not in the panel."""
    a, b, c = view.horizon
    found = line_in_rectangle(view.horizon, back((0.0, 0.0)), back((WIDTH, HEIGHT)))
    if not len(found):
        above = b * (HEIGHT / 2.0) + a * (WIDTH / 2.0) + c > 0.0
        return drawing.text(
            (WIDTH / 2.0, 22.0 if above else HEIGHT - 12.0),
            f"the horizon is {'above' if above else 'below'} the picture",
            "camera ground",
            "middle",
        )
    ends = place(found[0]), place(found[1])
    return drawing.line(*ends, "camera bold") + _horizon_name(view, place, ends)


def _horizon_name(view: Camera, place: Place, ends: tuple[Point, Point]) -> str:
    """Label above its right end, or above the left one if a vanishing point is near the right."""
    points = [place(pixel)[0] for pixel in view.vanishing[0][:2]]
    (x, y), anchor = max(ends), "end"
    if any(abs(x - other) < NAME_WIDTH for other in points):
        (x, y), anchor = min(ends), "start"
    baseline = (min(max(x, 6.0), WIDTH - 6.0), max(y - 7.0, 13.0))
    if not inside(baseline, 6.0):
        return ""
    return drawing.text(baseline, "horizon", "camera small ground", anchor)


def upright(view: Camera, box: Box) -> str:
    """The nearest edge of the box, extended to the horizon, which is as high as the camera."""
    foot = near_upright(box)[0]
    ends = np.array([foot, (foot[0], foot[1], view.height)])
    pixels, seen = view.image(ends)
    if not seen.all():
        return ""
    start, crossing = (in_picture(pixel) for pixel in pixels)
    line = clipped(start, crossing, *PANEL)
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


def handle_names(view: Camera, box: Box) -> str:
    """What the two handles of the box change, on their right."""
    places = np.array([(box.x, box.y, height) for height in (0.0, box.height)])
    pixels, seen = view.image(places)
    named = zip(("place", "height"), pixels, seen, strict=True)
    spots = [(name, in_picture(pixel)) for name, pixel, visible in named if visible]
    return "".join(
        drawing.text((x + 13.0, y + 4.0), name, "world small ground")
        for name, (x, y) in spots
        if inside((x, y), 3.0 * ROOM)
    )


def vanishing_points(view: Camera, place: Place) -> str:
    """The vanishing points in the panel, with their labels."""
    parts = []
    for name, pixel, finite in zip(NAMES, *view.vanishing, strict=True):
        if not finite or not inside(place(pixel)):
            continue
        x, y = place(pixel)
        parts.append(drawing.dot((x, y), "image", 4.0))
        baseline = (min(max(x, 10.0), WIDTH - 10.0), y - 15.0 if y > 2.0 * ROOM else y + 25.0)
        parts.append(drawing.text(baseline, name, "image strong ground", "middle"))
    return "".join(parts)
