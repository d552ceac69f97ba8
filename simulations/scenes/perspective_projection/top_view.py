"""The projection figure from above: camera centre, image plane, ray, two similar triangles."""

import math

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.scenes.perspective_projection.house import footprint
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    METRES_PER_PX,
    REFERENCE_DEPTH_M,
    View,
    metres,
)

WIDTH, HEIGHT = 400.0, 324.0
FLOOR = 298.0
"""Lower edge of the drawing; the equation is below it."""
AXIS = np.array([58.0, 142.0])
"""Centre of full perspective in the view box: depth to the right, X downwards."""
DEPTH_SCALE = 16.0
"""View box units per metre of depth."""
SIDE_SCALE = 32.0
"""View box units per metre of X: stretched, so that the triangles open up."""
LIMITS = ((1, 0, -4), (-1, 0, WIDTH - 4), (0, 1, -4), (0, -1, FLOOR))
"""Where things may be drawn, as half planes a x + b y + c ≥ 0."""
LEFT_M = (8.0 - AXIS[0]) / DEPTH_SCALE
"""Depth of the panel's left edge."""
LEAST_LEG = 20.0
"""Leg of a triangle, in view box units, from which it is named."""


def above(Z: float, X: float) -> Floats:
    """Metres to view box."""
    return AXIS + np.array([DEPTH_SCALE * Z, SIDE_SCALE * X])


def _beside(spot: Floats, right: float, down: float) -> Floats:
    """A place next to ``spot``, in view box units."""
    return spot + np.array([right, down])


def metres_at(place: drawing.Point) -> Floats:
    """View box to metres: Z and X."""
    return (np.asarray(place, float) - AXIS) / [DEPTH_SCALE, SIDE_SCALE]


def top_view_panel(view: View) -> Panel:
    overlay = "".join(
        (
            house_plan(view),
            depth_axis(view),
            "" if view.full else reference_plane(),
            triangles(view) if view.full and view.visible else "",
            image_plane(view),
            ray(view),
            centre(view),
            drawing.dot(above(view.Z, view.X), "world", 5.5),
            equation(view),
        )
    )
    return Panel("top", "From above (X drawn stretched)", WIDTH, HEIGHT, overlay=overlay)


def depth_axis(view: View) -> str:
    """The optical axis, with its depths on the side away from the point."""
    row = -8.0 if view.X >= 0.0 else 17.0
    ticks = "".join(
        drawing.line(above(Z, -0.08), above(Z, 0.08), "muted thin")
        + drawing.text(_beside(above(Z, 0.0), 0.0, row), words, "muted small ground", "middle")
        for Z, words in ((5, "5 m"), (10, "10 m"), (20, "20 m"))
        if view.full or Z != REFERENCE_DEPTH_M
    )
    return drawing.arrow((8.0, AXIS[1]), (396.0, AXIS[1]), "muted thin") + ticks


def reference_plane() -> str:
    """The plane whose image is the same in perspective and in orthography."""
    high, low = above(REFERENCE_DEPTH_M, -4.0), above(REFERENCE_DEPTH_M, 3.5)
    return drawing.line(high, low, "image dashed") + drawing.text(
        _beside(high, 6.0, 8.0), f"Z₀ = {REFERENCE_DEPTH_M:.0f} m", "image small ground"
    )


def image_plane(view: View) -> str:
    """The plane at distance f in front of the centre, as wide as the picture."""
    half = HALF_WIDTH_PX * METRES_PER_PX
    if view.camera.plane_m < LEFT_M:
        return ""
    left, right = above(view.camera.plane_m, -half), above(view.camera.plane_m, half)
    spot = _beside(left, 8.0, 10.0) if view.X >= 0.0 else _beside(right, 18.0, 4.0)
    parts = [
        drawing.line(left, right, "image bold"),
        drawing.rectangle(right - 4.0, 8.0, 8.0, "image solid"),
        drawing.text(spot, "image plane", "image small ground"),
    ]
    if view.full:
        level = left[1] - 8.0
        parts += [
            drawing.path([[left, AXIS, right]], "camera thin faint dashed"),
            drawing.line((AXIS[0], level), (right[0], level), "camera"),
            drawing.text(((AXIS[0] + right[0]) / 2, level - 6.0), "f", "camera italic", "middle"),
        ]
    return "".join(parts)


def house_plan(view: View) -> str:
    """Walls and ridge of the house."""
    outline = np.array([above(Z, X) for Z, X in footprint(view)])
    ridge = (outline[:2] + outline[3:1:-1]) / 2.0
    walls, ridge = _in_room(outline, closed=True), _in_room(ridge, closed=False)
    return (drawing.polygon(walls, "world thin fill") * 2 if len(walls) else "") + (
        drawing.polyline(ridge, "world thin") if len(ridge) else ""
    )


def _in_room(points: Floats, *, closed: bool) -> Floats:
    """A line or an area clipped to the drawing."""
    for limit in LIMITS:
        points = clip_half_plane(points, limit, closed)
    return points


def triangles(view: View) -> str:
    """The similar triangles: centre, axis and point; centre, principal point and image."""
    side = 1.0 if view.X >= 0.0 else -1.0
    parts = [drawing.polygon([AXIS, above(view.Z, 0.0), above(view.Z, view.X)], "ray thin fill")]
    if SIDE_SCALE * abs(view.X) >= LEAST_LEG and DEPTH_SCALE * view.Z >= LEAST_LEG:
        middle = _beside(above(view.Z, 0.35 * view.X), -7.0, 4.0)
        parts.append(drawing.text(middle, "X", "world italic ground", "end"))
    if abs(view.x) <= HALF_WIDTH_PX:
        distance, across = view.camera.plane_m, view.x * METRES_PER_PX
        hit = above(distance, across)
        parts += [
            drawing.line(above(distance, 0.0), hit, "image bold"),
            drawing.dot(hit, "image", 4.0),
            drawing.text(_beside(hit, -7.0, 4.0 + 6.0 * side), "x", "image italic ground", "end"),
        ]
    return "".join(parts)


def ray(view: View) -> str:
    """The ray through the point; dashed if the point has no image."""
    camera = view.camera
    if not view.visible:
        return _ray_without_image(view)
    start = max(camera.centre_m, min(LEFT_M, view.Z))
    end = max(view.Z, camera.plane_m, REFERENCE_DEPTH_M if not view.full else view.Z)
    drawn = _in_room(
        np.array([above(start, _on_ray(view, start)), above(end, _on_ray(view, end))]), closed=False
    )
    parts = [drawing.polyline(drawn, "ray")] if len(drawn) > 1 else []
    if not view.full:
        parts.append(_seen_at_reference(view))
    return "".join(parts)


def _on_ray(view: View, Z: float) -> float:
    """X at a depth, of the ray through the point."""
    return view.X * view.camera.size_at(view.Z) / _size(view, Z)


def _size(view: View, Z: float) -> float:
    """Pixels per metre at a depth; infinite at the centre itself."""
    return math.inf if view.camera.centre_m == Z else view.camera.size_at(Z)


def _seen_at_reference(view: View) -> str:
    """Where the ray meets the reference plane, and where the ray of full perspective does."""
    parts = []
    if view.Z > 0.0:
        Z, X = REFERENCE_DEPTH_M, view.X * REFERENCE_DEPTH_M / view.Z
        ends = np.array([AXIS, above(max(Z, view.Z), X * max(Z, view.Z) / Z)])
        drawn = _in_room(ends, closed=False)
        if len(drawn) > 1:
            parts.append(drawing.polyline(drawn, "error thin dashed"))
        if abs(X) < 3.5:
            parts.append(drawing.dot(above(Z, X), "error", 3.0))
    own = _on_ray(view, REFERENCE_DEPTH_M)
    if abs(own) < 3.5:
        parts.append(drawing.dot(above(REFERENCE_DEPTH_M, own), "image", 4.0))
    return "".join(parts)


def _ray_without_image(view: View) -> str:
    """From the point through the centre, or along the plane of the centre."""
    camera = view.camera
    away = view.Z - camera.centre_m
    if away == 0.0:
        ends = above(view.Z, 0.0), above(view.Z, view.X)
    else:
        mirrored = view.X * (camera.plane_m - camera.centre_m) / away
        ends = above(view.Z, view.X), above(camera.plane_m, mirrored)
    drawn = _in_room(np.array(ends), closed=False)
    return drawing.polyline(drawn, "error dashed") if len(drawn) > 1 else ""


def centre(view: View) -> str:
    """The centre, or how far to the left it is."""
    if view.camera.parallel:
        words = "parallel rays: centre at infinity"
    elif view.camera.centre_m < LEFT_M:
        words = f"centre: {-view.camera.centre_m:.0f} m farther back"
    else:
        spot = above(view.camera.centre_m, 0.0)
        name = max(spot[0], 26.0), spot[1] + (20.0 if view.X < 0.0 else -11.0)
        return drawing.dot(spot, "camera", 5.0) + drawing.text(
            name, "centre", "camera small ground", "middle"
        )
    return drawing.text((8.0, FLOOR - 8.0), words, "muted small ground")


def equation(view: View) -> str:
    """The division with its numbers."""
    f, X = f"{view.camera.focal_px:.0f}", metres(view.X)
    role = "image" if view.visible else "error"
    image = f"{format_number(view.x, 1)} px" if view.visible else ""
    if view.camera.parallel:
        words = f"x = f X / Z₀ = {f} · {X} / {REFERENCE_DEPTH_M:.1f} = {image}"
    elif not view.full and view.visible:
        size = format_number(view.camera.size_at(view.Z), 1)
        words = f"x = a X / (1 + η (Z − Z₀)) = {size} px/m · {X} m = {image}"
    elif view.visible:
        words = f"x = f X / Z = {f} · {X} / {format_number(view.Z, 1)} = {image}"
    elif view.camera.centre_m == view.Z:
        words = f"x = f X / Z = {f} · {X} / 0: undefined"
    else:
        words = "behind the camera: no image"
    return drawing.line((0.0, FLOOR), (WIDTH, FLOOR), "muted thin faint") + drawing.text(
        (WIDTH - 4.0, HEIGHT - 8.0), words, role, "end"
    )
