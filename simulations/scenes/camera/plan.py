"""The plan of the camera simulator: camera, wedge of view, things, and what is in focus."""

import math

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import format_number
from simulations.models.light.raycasting import Box, Sphere
from simulations.pictures.still_life.things import THINGS, WALL_DISTANCE, Thing

PLAN_WIDTH, PLAN_HEIGHT = 400.0, 267.0
"""View box of both panels: the 3 : 2 of the sensor."""

type Point = tuple[float, float]

UNITS_PER_METRE = 27.0
CAMERA_ROW = PLAN_HEIGHT - 26.0
"""Row of the view box on which the lens stands; the floor recedes upwards."""
UNITS_BEHIND_THE_WALL = 10.0
"""A metre of focus there, where nothing is to be seen: enough to show that it moves."""
FOCUS_COLUMN = PLAN_WIDTH - 20.0
"""Where the distance in focus is marked."""
EDGE_DEPTH = 7.5
"""How far away the edge of the field of view is marked, metres: clear of all things."""
STILL_LIFE_MIDDLE = 3.9
"""What the lamp circles, metres away ..."""
LAMP_DISTANCE = 3.5
"""... and how far from it."""


def on_plan(x: float, y: float) -> Point:
    """View box coordinates of a point ``x`` metres to the right, ``y`` metres away."""
    return PLAN_WIDTH / 2 + UNITS_PER_METRE * x, CAMERA_ROW - UNITS_PER_METRE * y


def seen_from(place: Point) -> Point:
    """Metres to the right and away of a place of the view box: the inverse of `on_plan`."""
    across, up = place[0] - PLAN_WIDTH / 2, CAMERA_ROW - place[1]
    return across / UNITS_PER_METRE, up / UNITS_PER_METRE


def focus_mark(focus: float) -> Point:
    """Where the distance in focus is marked; behind the wall metres are drawn short."""
    behind = max(focus - WALL_DISTANCE, 0.0)
    row = on_plan(0, focus - behind)[1] - UNITS_BEHIND_THE_WALL * behind
    return FOCUS_COLUMN, row


def focus_marked(place: Point) -> float:
    """The distance in focus whose mark is in the row of ``place``, metres."""
    away = seen_from(place)[1]
    behind = max(away - WALL_DISTANCE, 0.0)
    return away + behind * (UNITS_PER_METRE / UNITS_BEHIND_THE_WALL - 1.0)


def edge_mark(half_tan: float) -> Point:
    """On the left edge of the field of view."""
    return _slice(EDGE_DEPTH, half_tan)[0]


def edge_marked(place: Point) -> float:
    """The tangent of half the field of view whose edge is in the column of ``place``."""
    return -seen_from(place)[0] / EDGE_DEPTH


def lamp_mark(light_angle: float, distance: float = LAMP_DISTANCE) -> Point:
    """The lamp, or a point nearer to the middle of the still life."""
    angle = math.radians(light_angle)
    return on_plan(distance * math.sin(angle), STILL_LIFE_MIDDLE - distance * math.cos(angle))


def draw_plan(focus: float, light_angle: float, view_rad: float, near: float, far: float) -> str:
    """SVG markup. ``near`` and ``far`` bound the depth of field, metres; ``far`` may be ∞."""
    half_tan = math.tan(view_rad / 2)
    return "".join(
        (
            _wedge(half_tan),
            _in_focus(focus, near, far, half_tan),
            _wall(),
            *(_thing(thing) for thing in THINGS),
            _lamp(light_angle),
            _camera(view_rad),
        )
    )


def _slice(depth: float, half_tan: float) -> tuple[Point, Point]:
    """Left and right end of the field of view at ``depth``."""
    return on_plan(-depth * half_tan, depth), on_plan(depth * half_tan, depth)


def _wedge(half_tan: float) -> str:
    left, right = _slice(WALL_DISTANCE, half_tan)
    lens = on_plan(0, 0)
    edges = (drawing.line(lens, end, "camera thin") for end in (left, right))
    return "".join(edges) + drawing.dot(edge_mark(half_tan), "camera")


def _in_focus(focus: float, near: float, far: float, half_tan: float) -> str:
    front, back = min(near, WALL_DISTANCE), min(far, WALL_DISTANCE)
    near_left, near_right = _slice(front, half_tan)
    far_left, far_right = _slice(back, half_tan)
    parts = []
    if back > front:
        band = (near_left, near_right, far_right, far_left)
        parts.append(drawing.polygon(band, "ray fill faint"))
    if focus <= WALL_DISTANCE:
        left, right = _slice(focus, half_tan)
        parts.append(drawing.line(left, right, "ray bold"))
    wall = on_plan(0, WALL_DISTANCE)[1]
    row, label = on_plan(0, focus)[1], f"focus {format_number(focus, 1)} m"
    baseline = row - 5 if row > wall + 20 else row + 15  # clear of the wall's line
    if focus <= WALL_DISTANCE:
        parts.append(drawing.line((4, row), (PLAN_WIDTH - 4, row), "ray thin dashed faint"))
    else:
        label, baseline = f"{label}, behind the wall", wall - 7
    parts.append(drawing.text((FOCUS_COLUMN - 16, baseline), label, "ray halo", "end"))
    parts.append(drawing.dot(focus_mark(focus), "ray"))
    return "".join(parts)


def _wall() -> str:
    left, right = (8.0, on_plan(0, WALL_DISTANCE)[1]), (PLAN_WIDTH - 8.0, 0.0)
    row = left[1]
    return drawing.line(left, (right[0], row), "world bold") + drawing.text(
        (10, row - 7), f"wall with test chart, {WALL_DISTANCE:.0f} m", "world small"
    )


def _thing(thing: Thing) -> str:
    x, y, _ = thing.solid.centre
    centre = on_plan(x, y)
    match thing.solid:
        case Sphere(radius=radius):
            reach = radius * UNITS_PER_METRE
            shape = drawing.circle(centre, reach, "world fill")
        case Box() as box:
            shape = drawing.polygon(_corners(box), "world fill")
            reach = box.size[0] * UNITS_PER_METRE / 2
    side = -1 if x < 0 else 1
    label = (centre[0] + side * (reach + 6), centre[1] + 4)
    return shape + drawing.text(label, thing.name, "world small halo", "end" if x < 0 else "start")


def _corners(box: Box) -> list[Point]:
    half_x, half_y = box.size[0] / 2, box.size[1] / 2
    local = ((-half_x, -half_y), (half_x, -half_y), (half_x, half_y), (-half_x, half_y))
    corners = [np.array([x, y, 0.0]) @ box.world_to_box + box.centre for x, y in local]
    return [on_plan(float(corner[0]), float(corner[1])) for corner in corners]


def _lamp(light_angle: float) -> str:
    """The lamp's direction as an arrow to the middle of the still life, on a circle around it."""
    start, end = lamp_mark(light_angle), lamp_mark(light_angle, 2.3)
    return drawing.arrow(start, end, "light bold") + drawing.circle(start, 5.0, "light solid")


def _camera(view_rad: float) -> str:
    x, row = on_plan(0, 0)
    body = drawing.rectangle((x - 13, row + 5), 26, 15, "camera fill")
    lens = drawing.rectangle((x - 6, row - 1), 12, 6, "camera solid")
    label = drawing.text((x + 20, row + 17), f"{math.degrees(view_rad):.0f}°", "camera strong")
    return body + lens + label
