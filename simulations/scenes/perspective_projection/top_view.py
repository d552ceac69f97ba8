"""The projection figure from above: camera centre, image plane, ray, two similar triangles."""

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.projection.pinhole import world_to_camera
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    METRES_PER_PX,
    REFERENCE_DEPTH_M,
    Projection,
    room_axes,
)
from simulations.world.plan import plan_markup

WIDTH, HEIGHT = 400.0, 324.0
FLOOR = 298.0  # lower edge of the drawing; the equation is below it
DRAWN = (4.0, 4.0), (WIDTH - 4.0, FLOOR)
AXIS = np.array([84.0, 142.0])
"""Centre of full perspective: depth to the right, X downwards."""
LARGEST, SPREAD_M = 36.0, 5.0
"""View box units per metre while the point is near, and how fast they become fewer beyond."""
LAST_TICK = 296.0  # view box units from the centre
LEAST_LEG = 20.0  # leg of a triangle, in view box units, from which it is named


def scale_of(depth: float) -> float:
    """View box units per metre: fewer for a far point, so that it stays in view."""
    near = REFERENCE_DEPTH_M
    return LARGEST * (near + SPREAD_M) / (max(depth, near) + SPREAD_M)


def depth_at(column: float) -> float:
    """The depth of a point that is seen in this column."""
    along = (column - AXIS[0]) / LARGEST
    near, whole = REFERENCE_DEPTH_M, REFERENCE_DEPTH_M + SPREAD_M
    return along if along < near else SPREAD_M * along / max(whole - along, 1e-3)


def above(view: Projection, Z: float, X: float) -> Floats:
    """Metres to the view box from above."""
    return AXIS + scale_of(view.Z) * np.array([Z, X])


def left_m(view: Projection) -> float:
    """Depth of the panel's left edge."""
    return (8.0 - float(AXIS[0])) / scale_of(view.Z)


def moved(spot: Floats, right: float, down: float) -> Floats:
    """A place next to ``spot``, in view box units."""
    return spot + np.array([right, down])


def panel(view: Projection) -> Panel:
    """Camera centre, image plane, ray, and two similar triangles."""
    parts = (
        plan(view),
        depth_axis(view),
        "" if view.full else reference_plane(view),
        triangles(view) if view.full and view.visible else "",
        image_plane(view),
        ray(view) if view.visible else ray_without_image(view),
        centre(view),
        drawing.dot(above(view, view.Z, view.X), "world", 5.5),
        equation(view),
    )
    return Panel("top", "From above", WIDTH, HEIGHT, overlay="".join(parts))


def depth_axis(view: Projection) -> str:
    """The optical axis, with its depths on the side away from the point."""
    row = -8.0 if view.X >= 0.0 else 17.0
    ticks = "".join(
        drawing.line(above(view, Z, -0.08), above(view, Z, 0.08), "muted thin")
        + drawing.text(
            moved(above(view, Z, 0.0), 0.0, row), f"{Z} m", "muted small ground", "middle"
        )
        for Z in (5, 10, 20)
        if (view.full or Z != REFERENCE_DEPTH_M) and Z * scale_of(view.Z) < LAST_TICK
    )
    return drawing.arrow((8.0, AXIS[1]), (396.0, AXIS[1]), "muted thin") + ticks


def reference_plane(view: Projection) -> str:
    """The plane whose image is the same in perspective and in orthography."""
    high, low = above(view, REFERENCE_DEPTH_M, -3.5), above(view, REFERENCE_DEPTH_M, 3.5)
    return drawing.line(high, low, "image dashed") + drawing.text(
        moved(high, 6.0, 8.0), f"Z₀ = {REFERENCE_DEPTH_M:.0f} m", "image small ground"
    )


def image_plane(view: Projection) -> str:
    """The plane at distance f in front of the centre, as wide as the picture."""
    half = HALF_WIDTH_PX * METRES_PER_PX
    if view.camera.plane_m < left_m(view):
        return ""
    left, right = (above(view, view.camera.plane_m, side) for side in (-half, half))
    spot = moved(left, 8.0, 10.0) if view.X >= 0.0 else moved(right, 18.0, 4.0)
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


def plan(view: Projection) -> str:
    """The room and what stands in it."""

    def place(flat: Floats) -> Floats:
        points = world_to_camera(np.insert(flat, 2, 0.0, axis=1), room_axes(view))
        return AXIS + points[:, [2, 0]] * scale_of(view.Z)

    return plan_markup(place, *DRAWN)


def in_room(points: Floats, *, closed: bool = True) -> Floats:
    """A line or an area clipped to the drawing."""
    return clip_to_rectangle(points, *DRAWN, closed)


def segment(start: Floats, end: Floats, style: str) -> str:
    """A segment clipped to the drawing."""
    line = in_room(np.array([start, end]), closed=False)
    return drawing.polyline(line, style) if len(line) > 1 else ""


def triangles(view: Projection) -> str:
    """The similar triangles: centre, axis and point; centre, principal point and image."""
    side = 1.0 if view.X >= 0.0 else -1.0
    parts = [
        drawing.polygon(
            [AXIS, above(view, view.Z, 0.0), above(view, view.Z, view.X)],
            "ray thin fill",
        )
    ]
    if scale_of(view.Z) * min(abs(view.X), view.Z) >= LEAST_LEG:
        middle = moved(above(view, view.Z, 0.35 * view.X), -7.0, 4.0)
        parts.append(drawing.text(middle, "X", "world italic ground", "end"))
    if abs(view.x) <= HALF_WIDTH_PX:
        distance, across = view.camera.plane_m, view.x * METRES_PER_PX
        hit = above(view, distance, across)
        parts += [
            drawing.line(above(view, distance, 0.0), hit, "image bold"),
            drawing.dot(hit, "image", 4.0),
            drawing.text(moved(hit, -7.0, 4.0 + 6.0 * side), "x", "image italic ground", "end"),
        ]
    return "".join(parts)


def on_ray(view: Projection, Z: float) -> Floats:
    """The place from above, at a depth, of the ray through the point."""
    return above(view, Z, view.X * view.camera.size_at(view.Z) / view.camera.size_at(Z))


def ray(view: Projection) -> str:
    """The ray through the point; before orthography, also where it and the ray of full perspective
    meet the reference plane."""
    reference = view.Z if view.full else REFERENCE_DEPTH_M
    start = max(view.camera.centre_m, min(left_m(view), view.Z))
    end = max(view.Z, view.camera.plane_m, reference)
    parts = [segment(on_ray(view, start), on_ray(view, end), "ray")]
    if view.full:
        return parts[0]
    if view.Z > 0.0:
        Z, X = max(reference, view.Z), view.X * reference / view.Z
        parts.append(segment(AXIS, above(view, Z, X * Z / reference), "error thin dashed"))
        if abs(X) < 3.5:
            parts.append(drawing.dot(above(view, reference, X), "error", 3.0))
    image = on_ray(view, reference)
    if abs(image[1] - AXIS[1]) < 3.5 * scale_of(view.Z):
        parts.append(drawing.dot(image, "image", 4.0))
    return "".join(parts)


def ray_without_image(view: Projection) -> str:
    """The line from the point through the centre, or along the plane of the centre."""
    away = view.Z - view.camera.centre_m
    if away == 0.0:
        return segment(above(view, view.Z, 0.0), above(view, view.Z, view.X), "error dashed")
    mirrored = view.X * (view.camera.plane_m - view.camera.centre_m) / away
    return segment(
        above(view, view.Z, view.X),
        above(view, view.camera.plane_m, mirrored),
        "error dashed",
    )


def centre(view: Projection) -> str:
    """The centre, or how far to the left it is."""
    if view.camera.parallel:
        words = "parallel rays: centre at infinity"
    elif view.camera.centre_m < left_m(view):
        words = f"centre: {-view.camera.centre_m:.0f} m farther back"
    else:
        spot = above(view, view.camera.centre_m, 0.0)
        name = max(spot[0], 26.0), spot[1] + (20.0 if view.X < 0.0 else -11.0)
        return drawing.dot(spot, "camera", 5.0) + drawing.text(
            name, "centre", "camera small ground", "middle"
        )
    return drawing.text((8.0, FLOOR - 8.0), words, "muted small ground")


def equation(view: Projection) -> str:
    """The division with its numbers; a length to the decimetre, or to the centimetre if needed."""
    decimetres = 10.0 * view.X
    X = format_number(view.X, 1 if abs(decimetres - round(decimetres)) < 1e-6 else 2)
    f, image = f"{view.camera.focal_px:.0f}", f"{format_number(view.x, 1)} px"
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
    role = "image" if view.visible else "error"
    return drawing.line((0.0, FLOOR), (WIDTH, FLOOR), "muted thin faint") + drawing.text(
        (WIDTH - 4.0, HEIGHT - 8.0), words, role, "end"
    )
