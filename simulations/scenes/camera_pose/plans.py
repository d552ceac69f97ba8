"""The room from above, twice: in world coordinates, and in the camera's."""

from collections.abc import Callable, Iterator

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_half_plane
from simulations.scenes.camera_pose.room import AXIS_M, DOOR, LAMP, TABLE, WALLS, Standpoint

WIDTH, HEIGHT = 400.0, 350.0
UNITS_PER_M = 20.0
"""Scale of both panels, so that equal lengths look equal."""
WORLD_ORIGIN = np.array([80.0, 215.0])
CAMERA_ORIGIN = np.array([200.0, 242.0])
"""The two origins in the view boxes; right is right, ahead or forward is up. The camera's is moved
where the room would not fit."""
MARGIN = 4.0
"""Least distance of the room from the border of the second panel, in view box units."""
EDGES = ((1, 0, 0), (-1, 0, WIDTH), (0, 1, 0), (0, -1, HEIGHT))
"""The view box, as half planes a x + b y + c ≥ 0."""
CAMERA_OUTLINE = np.array(
    [(-0.45, 0, -0.3), (-0.45, 0, 0.25), (-0.2, 0, 0.25), (-0.2, 0, 0.6), (0.2, 0, 0.6),
     (0.2, 0, 0.25), (0.45, 0, 0.25), (0.45, 0, -0.3)]
)  # fmt: skip
"""In camera coordinates: body and lens, seen from above."""
DOOR_NAME = np.array([0.0, 0.0, 0.7])
"""Distance of the door's label from the door, in metres."""
NAME_M = (1.0, 0.5)
"""Distance of an axis's name back from its tip, and aside from the axis, in metres."""
HANDLE_NAMES = {"camera": 38.0, "direction": 45.0}
"""Names of the handles, and how far from its handle each is, in view box units: across ..."""
ABOVE = 24.0
"""... and up."""
BESIDE = 12.0
"""Distance of a label from the lamp, and from the middle of t, in view box units."""

type Place = Callable[[Floats], Floats]


def in_world(points: Floats) -> Floats:
    """World points (..., 3) in the first panel's view box (..., 2)."""
    return WORLD_ORIGIN + UNITS_PER_M * np.asarray(points)[..., [0, 2]] * [1.0, -1.0]


def metres_at(place: drawing.Point) -> tuple[float, float]:
    """X and Z of the world at a place of the first panel."""
    X, Z = (np.asarray(place, float) - WORLD_ORIGIN) / (UNITS_PER_M * np.array([1.0, -1.0]))
    return float(X), float(Z)


def in_camera(standpoint: Standpoint) -> Place:
    """Points (..., 3) in camera coordinates in the second panel's view box (..., 2), which shows
    the whole room."""

    def scaled(points: Floats) -> Floats:
        return UNITS_PER_M * np.asarray(points)[..., [0, 2]] * [1.0, -1.0]

    room = scaled(standpoint.seen(WALLS))
    size = np.array([WIDTH, HEIGHT])
    least, most = MARGIN - room.min(axis=0), size - MARGIN - room.max(axis=0)
    origin = np.clip(CAMERA_ORIGIN, least, most)
    return lambda points: origin + scaled(points)


def from_camera(standpoint: Standpoint) -> Place:
    """Camera coordinates to the first panel."""
    return lambda points: in_world((points - standpoint.t) @ standpoint.rotation)


def to_camera(standpoint: Standpoint) -> Place:
    """World coordinates to the second panel."""
    place = in_camera(standpoint)
    return lambda points: place(standpoint.seen(points))


def world_panel(standpoint: Standpoint) -> Panel:
    """The camera's place and its axes."""
    origin, centre = in_world(np.zeros(3)), in_world(standpoint.centre)
    apart = float(np.hypot(*(centre - origin))) > UNITS_PER_M
    away = -1.0 if standpoint.centre[2] < 0.0 else 1.0
    parts = (
        _furniture(in_world, standpoint),
        drawing.line(origin, centre, "muted thin dashed") if apart else "",
        _axes(in_world, "world", ("X", "Z"), away),
        _camera(from_camera(standpoint)),
        _axes(from_camera(standpoint), "camera", ("x", "z")),
        *_handle_names(from_camera(standpoint)),
        _lamp(in_world, 1.0),
    )
    return Panel("world", "The room in world coordinates", WIDTH, HEIGHT, overlay="".join(parts))


def camera_panel(standpoint: Standpoint) -> Panel:
    """The room in camera coordinates, and the arrow t to the world's origin."""
    place, own = to_camera(standpoint), in_camera(standpoint)
    centre, origin = own(np.zeros(3)), place(np.zeros(3))
    apart = float(np.hypot(*(origin - centre))) > UNITS_PER_M
    along = (origin - centre) / max(float(np.hypot(*(origin - centre))), 1.0)
    aside = np.array([-along[1], along[0]])
    to_lamp = float(aside @ (place(LAMP) - centre))
    away = -1.0 if standpoint.centre[2] < 0.0 else 1.0
    name = (centre + origin) / 2.0 - np.copysign(BESIDE, to_lamp) * aside
    parts = (
        _furniture(place, standpoint),
        _axes(place, "world", ("X", "Z"), away),
        _segment(np.stack([centre, origin]), "ray bold") if apart else "",
        _name(name, "t", "ray strong") if apart else "",
        _camera(own),
        _axes(own, "camera", ("x", "z")),
        _lamp(place, aside[0] * to_lamp if apart else 1.0),
    )
    return Panel(
        "camera", "The same room in camera coordinates", WIDTH, HEIGHT, overlay="".join(parts)
    )


def _furniture(place: Place, standpoint: Standpoint) -> str:
    """Floor, the part of it in the camera's field of view, walls, door and table, clipped to the
    panel."""
    walls = [np.stack([WALLS[i], WALLS[(i + 1) % 4]]) for i in range(4)]
    floor = _ground(place(WALLS), "world")
    field = _ground(place(standpoint.field), "camera")
    table = _cut(place(TABLE), closed=True)
    middle, door = place(np.stack([TABLE.mean(axis=0), DOOR.mean(axis=0) - DOOR_NAME]))
    return "".join(
        (
            floor,
            field,
            *(_segment(place(wall), "world thin") for wall in walls),
            _segment(place(DOOR), "world bold"),
            drawing.polygon(table, "world thin fill") if len(table) else "",
            _name(middle, "table", "world small"),
            _name(door, "door", "world small"),
        )
    )


def _ground(area: Floats, role: str) -> str:
    """A part of the floor as a faint area."""
    seen = _cut(area, closed=True)
    return (
        drawing.group([drawing.polygon(seen, f"{role} solid faint")], "faint") if len(seen) else ""
    )


def _axes(place: Place, role: str, names: tuple[str, str], away: float = 1.0) -> str:
    """Right and ahead, from the origin of their own coordinates. The first one's name is behind it,
    or ahead of it if ``away`` is −1."""
    start = place(np.zeros(3))
    parts = []
    right, ahead = np.eye(3)[[0, 2]]
    back, beside = NAME_M
    for name, axis, other in zip(names, (right, ahead), (away * ahead, right), strict=True):
        parts.append(drawing.arrow(start, place(AXIS_M * axis), role, 7))
        at = place((AXIS_M - back) * axis - beside * other)
        parts.append(_name(at, name, f"{role} italic"))
    return "".join(parts) + drawing.dot(start, role, 3.5)


def _camera(place: Place) -> str:
    return drawing.polygon(place(CAMERA_OUTLINE), "camera fill")


def _handle_names(place: Place) -> Iterator[str]:
    """What the two handles move: behind the camera, and beyond the tip of its forward axis."""
    centre, tip = place(np.zeros(3)), place(np.array([0.0, 0.0, AXIS_M]))
    along = (tip - centre) / (UNITS_PER_M * AXIS_M)
    for spot, side, (words, aside) in zip(
        (centre, tip), (-1.0, 1.0), HANDLE_NAMES.items(), strict=True
    ):
        x, y = spot + side * along * (aside, ABOVE)
        if 30.0 < x < WIDTH - 30.0:
            yield drawing.text((x, y + 4.0), words, "camera small ground", "middle")


def _lamp(place: Place, side: float) -> str:
    """The lamp, with its name on the right, or on the left if ``side`` is negative."""
    spot = place(LAMP)
    if not bool(np.all(spot > 0.0) and spot[0] < WIDTH and spot[1] < HEIGHT):
        return ""
    right = spot[0] < 50.0 or (side >= 0.0 and spot[0] < WIDTH - 50.0)
    at = (spot[0] + (BESIDE if right else -BESIDE), spot[1] + 4.0)
    return drawing.dot(spot, "light", 5.5) + drawing.text(
        at, "lamp", "light small ground", "start" if right else "end"
    )


def triple(values: Floats) -> str:
    """Three coordinates to the decimetre."""
    return f"({', '.join(format_number(float(value), 1) for value in values)})"


def _name(at: Floats, words: str, style: str) -> str:
    """A label centred at a place, if that is well inside the panel."""
    inside = 12.0 < at[0] < WIDTH - 12.0 and 12.0 < at[1] < HEIGHT - 4.0
    return drawing.text((at[0], at[1] + 4.0), words, f"{style} ground", "middle") if inside else ""


def _segment(ends: Floats, style: str) -> str:
    points = _cut(ends, closed=False)
    if len(points) < 2:
        return ""
    if style.startswith("ray"):
        return drawing.arrow(points[0], points[1], style, 9)
    return drawing.line(points[0], points[1], style)


def _cut(points: Floats, *, closed: bool) -> Floats:
    """A line or an area clipped to the view box."""
    for edge in EDGES:
        points = clip_half_plane(points, edge, closed)
    return points
