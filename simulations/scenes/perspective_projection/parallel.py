"""The projection figure for cameras with parallel rays: the same two panels, without a centre.

The picture also shows the point's image in perspective.
"""

import math

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.scenes.perspective_projection import picture
from simulations.scenes.perspective_projection import top_view as top
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    METRES_PER_PX,
    REFERENCE_DEPTH_M,
    SCALED,
    View,
    in_picture,
    metres,
)

SAME_PX = 0.05
"""Distances below this are printed as 0.0 px."""


def top_view_panel(view: View) -> Panel:
    scaled = view.camera == SCALED
    overlay = "".join(
        (
            reference_plane(view) if scaled else "",
            top.depth_axis(),
            top.image_plane(view) if scaled else parallel_view(view),
            top.other_depths(view),
            top.house_plan(view),
            scaled_rays(view) if scaled else parallel_rays(view),
            top.point(view),
            equation(view),
        )
    )
    return Panel("top", top.TITLE, top.WIDTH, top.HEIGHT, overlay=overlay)


def parallel_view(view: View) -> str:
    """The image plane, and the edges of the field of view, parallel to the axis."""
    half = HALF_WIDTH_PX * METRES_PER_PX
    left, right = (top.above(view.focal_px * METRES_PER_PX, side) for side in (-half, half))
    edges = [[(4.0, end[1]), (top.WIDTH - 4.0, end[1])] for end in (left, right)]
    return (
        drawing.path(edges, "camera thin faint dashed")
        + drawing.line(left, right, "image bold")
        + top.plane_grip(right)
        + drawing.text(left + np.array([7.0, 13.0]), "image plane", "image small halo")
    )


def parallel_rays(view: View) -> str:
    """One ray parallel to the axis, from the point to the plane, which it meets at X."""
    hit = top.above(view.focal_px * METRES_PER_PX, view.X)
    return drawing.line(top.above(view.Z, view.X), hit, "ray") + drawing.dot(hit, "image", 4.0)


def reference_plane(view: View) -> str:
    """The plane at the depth by which scaled orthography divides, with its label away from the
    point."""
    half = top.HEIGHT / 2.0 / top.SIDE_SCALE - 0.4
    high, low = (top.above(REFERENCE_DEPTH_M, side) for side in (-half, half))
    place = high + np.array([6.0, 6.0]) if view.X >= 0.0 else low + np.array([6.0, -1.0])
    return drawing.line(high, low, "world thin dashed") + drawing.text(
        place, "Z₀ = 5 m", "world small halo"
    )


def scaled_rays(view: View) -> str:
    """Along the axis to the reference plane, and from there through the centre."""
    moved = top.above(REFERENCE_DEPTH_M, view.X)
    distance = view.focal_px * METRES_PER_PX
    end = moved if distance < REFERENCE_DEPTH_M else top.above(distance, _image_x_m(view))
    parts = [
        drawing.line(top.above(view.Z, view.X), moved, "ray"),
        _within(np.array([top.CAMERA, end]), "ray"),
        drawing.circle(moved, 4.0, "ray"),
        top.centre(),
    ]
    if abs(view.x) <= HALF_WIDTH_PX:
        parts.append(drawing.dot(top.above(distance, _image_x_m(view)), "image", 4.0))
    return "".join(parts)


def _image_x_m(view: View) -> float:
    """X of the image on the drawn image plane, metres."""
    return view.x * METRES_PER_PX


def _within(points: Floats, style: str) -> str:
    for limit in top.RAY_LIMITS:
        points = clip_half_plane(points, limit, closed=False)
    return drawing.polyline(points, style) if len(points) > 1 else ""


def equation(view: View) -> str:
    """The product with its numbers."""
    X, x = metres(view.X), format_number(view.x, 1)
    if view.camera == SCALED:
        words = f"x = f X / Z₀ = {view.focal_px:.0f} · {X} / {REFERENCE_DEPTH_M:.1f} = {x} px"
    else:
        words = f"x = a X = {format_number(view.scale, 1)} px/m · {X} m = {x} px"
    place = (top.WIDTH - 4.0, top.HEIGHT - 6.0)
    return drawing.text(place, words, "image halo", "end")


def image_panel(view: View) -> Panel:
    overlay = (
        picture.axes(view)
        + picture.house_of(view)
        + through_a_centre(view)
        + picture.point(view)
        + in_perspective(view)
    )
    return Panel("image", picture.TITLE, picture.WIDTH, picture.HEIGHT, overlay=overlay)


def through_a_centre(view: View) -> str:
    """The point's image in perspective, joined to that of this camera."""
    if view.Z <= 0.0 or off_px(view) < SAME_PX or not view.in_picture:
        return ""
    x, y = view.formula_only
    if not in_picture(x, y):
        return ""
    start, end = picture.place(view.x, view.y), picture.place(x, y)
    return drawing.line(start, end, "error dashed") + drawing.circle(end, 5.0, "error")


def in_perspective(view: View) -> str:
    """The same as text."""
    if view.Z <= 0.0:
        words = "in perspective it has no image"
    elif off_px(view) < SAME_PX:
        words = "in perspective at the same place"
    else:
        x, y = (format_number(value, 1) for value in view.formula_only)
        words = f"in perspective at ({x}, {y}) px"
    place = (picture.WIDTH / 2.0, picture.message_rows(view)[-1])
    return drawing.text(place, words, "error small halo", "middle")


def off_px(view: View) -> float:
    """Pixels between this camera's image and that of perspective; depth must be positive."""
    x, y = view.formula_only
    return math.hypot(view.x - x, view.y - y)


def describe(view: View) -> str:
    """One sentence for a reader who cannot see the picture."""
    how = (
        f"Scaled orthography takes the point to be {format_number(REFERENCE_DEPTH_M, 1)} m away"
        if view.camera == SCALED
        else "Orthography drops the depth of the point"
    )
    shown = f"x = {format_number(view.x, 1)} px, y = {format_number(view.y, 1)} px"
    outside = "" if view.in_picture else ", outside the picture"
    if view.Z <= 0.0:
        return f"{how} and projects it to {shown}{outside}; in perspective it has no image."
    if off_px(view) < SAME_PX:
        return f"{how} and projects it to {shown}{outside}, just where perspective has it."
    off = format_number(off_px(view), 1)
    return (
        f"{how} and projects it to {shown}{outside}; at its true depth of "
        f"{format_number(view.Z, 1)} m that is {off} px from where perspective has it."
    )
