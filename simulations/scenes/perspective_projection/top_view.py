"""The projection figure from above: camera centre, image plane, ray, two similar triangles."""

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.scenes.perspective_projection.house import footprint
from simulations.scenes.perspective_projection.picture import COMPARED_DEPTHS
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    METRES_PER_PX,
    REFERENCE_DEPTH_M,
    SCALED,
    View,
    metres,
)

TITLE = "From above (X drawn stretched)"
WIDTH, HEIGHT = 400.0, 300.0
CAMERA = np.array([58.0, 142.0])
"""Camera centre in the view box, seen from above: depth to the right, X downwards."""
DEPTH_SCALE = 16.0
"""View box units per metre of depth."""
SIDE_SCALE = 38.0
"""View box units per metre of X: stretched, so that the triangles open up."""
PLANE_LABEL_WIDTH, POINT_LABEL_HALF_WIDTH = 80.0, 72.0
"""Sizes of the labels of the image plane and of the point, in view box units."""
RAY_LIMITS = ((1, 0, 0), (-1, 0, WIDTH), (0, 1, -4), (0, -1, 280))
"""Where rays may be drawn, as half planes a x + b y + c ≥ 0."""


def above(Z: float, X: float) -> Floats:
    """Metres to view box."""
    return CAMERA + np.array([DEPTH_SCALE * Z, SIDE_SCALE * X])


def metres_at(place: drawing.Point) -> Floats:
    """View box to metres: Z and X."""
    return (np.asarray(place, float) - CAMERA) / [DEPTH_SCALE, SIDE_SCALE]


def top_view_panel(view: View) -> Panel:
    overlay = "".join(
        (
            depth_axis(),
            image_plane(view),
            other_depths(view),
            house_plan(view),
            triangles(view) if view.visible else "",
            ray(view),
            centre(),
            point(view),
            equation(view),
        )
    )
    return Panel("top", TITLE, WIDTH, HEIGHT, overlay=overlay)


def depth_axis() -> str:
    ticks = "".join(
        drawing.line(above(Z, -0.06), above(Z, 0.06), "muted thin")
        + drawing.text(above(Z, -0.14), f"{Z}", "muted small halo", "middle")
        for Z in (5, 10, 15, 20)
    )
    return (
        drawing.arrow((8.0, CAMERA[1]), (396.0, CAMERA[1]), "muted thin")
        + drawing.text((396.0, CAMERA[1] + 16.0), "Z, m", "muted small", "end")
        + ticks
    )


def image_plane(view: View) -> str:
    """The plane at distance f in front of the centre, as wide as the picture, and its f."""
    distance, half = view.focal_px * METRES_PER_PX, HALF_WIDTH_PX * METRES_PER_PX
    left, right = above(distance, -half), above(distance, half)
    level = HEIGHT - 10.0
    return (
        drawing.path([[left, CAMERA, right]], "camera thin faint dashed")
        + drawing.line(left, right, "image bold")
        + plane_grip(right)
        + plane_label(view, left)
        + drawing.line((CAMERA[0], level), (right[0], level), "camera")
        + drawing.text((CAMERA[0], level - 6.0), f"f = {view.focal_px:.0f} px", "camera small halo")
    )


def plane_grip(end: Floats) -> str:
    """The handle at the end of the image plane."""
    return drawing.rectangle(end - 4.0, 8.0, 8.0, "image solid")


def plane_label(view: View, edge: Floats) -> str:
    """The label on the right of the plane's edge, or on the left if another plane is near."""
    other, needed = above(REFERENCE_DEPTH_M, 0.0)[0], 7.0 + PLANE_LABEL_WIDTH
    crossed = view.camera == SCALED and needed < edge[0] < other < edge[0] + needed
    right, anchor = (-7.0, "end") if crossed else (7.0, "start")
    return drawing.text(edge + np.array([right, 13.0]), "image plane", "image small halo", anchor)


def other_depths(view: View) -> str:
    """The points that the picture compares, on a line parallel to the optical axis."""
    line = drawing.line(above(COMPARED_DEPTHS[0], view.X), above(20.0, view.X), "world thin faint")
    return line + "".join(
        drawing.dot(above(depth, view.X), "world faint", 3.0) for depth in COMPARED_DEPTHS
    )


def house_plan(view: View) -> str:
    """Walls and ridge of the house."""
    outline = np.array([above(Z, X) for Z, X in footprint(view)])
    ridge = (outline[:2] + outline[3:1:-1]) / 2.0
    walls, ridge = _in_room(outline, closed=True), _in_room(ridge, closed=False)
    return (drawing.polygon(walls, "world thin fill") if len(walls) else "") + (
        drawing.polyline(ridge, "world thin faint") if len(ridge) else ""
    )


def _in_room(points: Floats, *, closed: bool) -> Floats:
    """A line or an area clipped to the drawing."""
    for limit in RAY_LIMITS:
        points = clip_half_plane(points, limit, closed)
    return points


def triangles(view: View) -> str:
    """The similar triangles: centre, axis and point; centre, principal point and image."""
    large = drawing.polygon([CAMERA, above(view.Z, 0.0), above(view.Z, view.X)], "world thin fill")
    if abs(view.x) > HALF_WIDTH_PX:
        return large
    distance = view.focal_px * METRES_PER_PX
    hit = above(distance, view.x * METRES_PER_PX)
    small = drawing.polygon([CAMERA, above(distance, 0.0), hit], "image thin fill")
    return large + small + drawing.dot(hit, "image", 4.0)


def ray(view: View) -> str:
    """The ray through the point; dashed if the point has no image."""
    distance = view.focal_px * METRES_PER_PX
    if view.visible:
        reach = max(view.Z, distance)
        ends, style = (CAMERA, above(reach, view.X * (reach / view.Z))), "ray"
    elif view.Z == 0.0:
        ends, style = (CAMERA, above(0.0, view.X)), "error dashed"
    else:
        mirrored = distance * (view.X / view.Z)
        ends, style = (above(view.Z, view.X), above(distance, mirrored)), "error dashed"
    drawn = _in_room(np.array(ends), closed=False)
    return drawing.polyline(drawn, style) if len(drawn) > 1 else ""


def centre() -> str:
    return drawing.dot(CAMERA, "camera", 5.0) + drawing.text(
        CAMERA + np.array([-6.0, -9.0]), "centre", "camera small halo", "end"
    )


def point(view: View) -> str:
    """The point, with its label beyond the image plane, on the side away from the axis if there is
    space."""
    spot = above(view.Z, view.X)
    below = view.X >= 0.0 and spot[1] + 27.0 < HEIGHT - 22.0
    y = spot[1] + 27.0 if below else max(spot[1] - 17.0, 13.0)
    beyond = above(view.focal_px * METRES_PER_PX, 0.0)[0] + 7.0 if view.Z >= 0.0 else 4.0
    half = POINT_LABEL_HALF_WIDTH
    x = np.clip(spot[0], min(beyond, WIDTH / 2.0) + half, WIDTH - 4.0 - half)
    label = f"X = {metres(view.X)} m, Z = {format_number(view.Z, 1)} m"
    return drawing.dot(spot, "world", 5.5) + drawing.text(
        (x, y), label, "world strong halo", "middle"
    )


def equation(view: View) -> str:
    """The division with its numbers."""
    terms = f"x = f X / Z = {view.focal_px:.0f} · {metres(view.X)} / "
    if view.visible:
        words, role = f"{terms}{format_number(view.Z, 1)} = {format_number(view.x, 1)} px", "image"
    elif view.Z == 0.0:
        words, role = f"{terms}0: undefined", "error"
    else:
        words, role = "Z < 0: behind the camera, no image", "error"
    return drawing.text((WIDTH - 4.0, HEIGHT - 6.0), words, f"{role} halo", "end")
