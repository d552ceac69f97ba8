"""The plan of the camera simulator: camera, wedge of view, things, and what is in focus."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import polar, swatch_polygon
from simulations.engine.frame import format_number
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.raycasting import Box, Sphere
from simulations.pictures.still_life.things import THINGS, WALL_DISTANCE, Thing

PLAN_WIDTH, PLAN_HEIGHT = 400.0, 267.0
"""View box of both panels: the 3 : 2 of the sensor."""

type Point = tuple[float, float]

UNITS_PER_METRE = 27.0
CAMERA_ROW = PLAN_HEIGHT - 26.0
"""Row of the view box on which the lens stands; the floor recedes upwards."""
UNITS_BEHIND_THE_WALL = 10.0
"""View box units per metre of focus behind the wall."""
FOCUS_COLUMN = PLAN_WIDTH - 20.0
"""Column of the mark of the distance in focus."""
EDGE_DEPTH = 7.5
"""Depth of the mark of the edge of the field of view, metres: clear of all things."""
STILL_LIFE_MIDDLE = 3.9
"""Distance of the centre of the lamp's circle, metres ..."""
LAMP_DISTANCE = 3.5
"""... and radius of the circle."""


@dataclass(frozen=True, slots=True)
class PlanView:
    """The quantities in the plan."""

    focus: float
    """Metres from the camera's place before the step back."""
    light_angle: float
    focal_length: float
    """Focal length of the camera after the step, millimetres."""
    view_rad: float
    near: float
    """Nearest and farthest end of the depth of field, metres from the camera ..."""
    far: float
    """... which may be ∞."""
    back: float = 0.0
    """Step back of the camera, metres: the plan shrinks so that the wall stays in it."""


def units_per_metre(back: float) -> float:
    return UNITS_PER_METRE * WALL_DISTANCE / (WALL_DISTANCE + back)


def on_plan(x: float, y: float, back: float = 0.0) -> Point:
    """View box coordinates of a point ``x`` metres to the right, ``y`` metres away from the
    camera's place before it stepped ``back`` by so many metres."""
    units = units_per_metre(back)
    return PLAN_WIDTH / 2 + units * x, CAMERA_ROW - units * (y + back)


def seen_from(place: Point, back: float = 0.0) -> Point:
    """Metres to the right and away of a place of the view box: the inverse of `on_plan`."""
    across, up = place[0] - PLAN_WIDTH / 2, CAMERA_ROW - place[1]
    units = units_per_metre(back)
    return across / units, up / units - back


def focus_mark(focus: float, back: float = 0.0) -> Point:
    """Place of the mark of the distance in focus; metres are shorter behind the wall."""
    behind = max(focus - WALL_DISTANCE, 0.0)
    row = on_plan(0, focus - behind, back)[1] - UNITS_BEHIND_THE_WALL * behind
    return FOCUS_COLUMN, row


def focus_marked(place: Point, back: float = 0.0) -> float:
    """The distance in focus whose mark is in the row of ``place``, metres."""
    away = seen_from(place, back)[1]
    behind = max(away - WALL_DISTANCE, 0.0)
    return away + behind * (units_per_metre(back) / UNITS_BEHIND_THE_WALL - 1.0)


def edge_mark(half_tan: float, back: float = 0.0) -> Point:
    """Place of the mark on the left edge of the field of view."""
    return _slice(EDGE_DEPTH + back, half_tan, back)[0]


def edge_marked(place: Point, back: float = 0.0) -> float:
    """The tangent of half the field of view whose edge is in the column of ``place``."""
    return -seen_from(place, back)[0] / (EDGE_DEPTH + back)


def lamp_mark(light_angle: float, distance: float = LAMP_DISTANCE, back: float = 0.0) -> Point:
    """Place of the lamp, or of a point nearer to the middle of the still life."""
    angle = math.radians(light_angle)
    nearer = distance * math.cos(angle)
    return on_plan(distance * math.sin(angle), STILL_LIFE_MIDDLE - nearer, back)


def draw_plan(plan: PlanView) -> str:
    """SVG markup."""
    half_tan, back = math.tan(plan.view_rad / 2), plan.back
    return "".join(
        (
            _wedge(half_tan, back),
            _in_focus(plan, half_tan),
            _wall(back),
            *(_thing(thing, back) for thing in THINGS),
            _lamp(plan.light_angle, back),
            _camera(plan),
        )
    )


def _slice(depth: float, half_tan: float, back: float) -> tuple[Point, Point]:
    """Left and right end of the field of view at ``depth`` from the camera."""
    away, reach = depth - back, depth * half_tan
    return on_plan(-reach, away, back), on_plan(reach, away, back)


def _wedge(half_tan: float, back: float) -> str:
    left, right = _slice(WALL_DISTANCE + back, half_tan, back)
    lens = on_plan(0, 0)
    edges = (drawing.line(lens, end, "camera thin") for end in (left, right))
    return "".join(edges) + drawing.dot(edge_mark(half_tan, back), "camera")


def _in_focus(plan: PlanView, half_tan: float) -> str:
    focus, back = plan.focus, plan.back
    first, last = (min(limit, WALL_DISTANCE + back) for limit in (plan.near, plan.far))
    near_left, near_right = _slice(first, half_tan, back)
    far_left, far_right = _slice(last, half_tan, back)
    parts = []
    if last > first:
        band = (near_left, near_right, far_right, far_left)
        parts.append(drawing.polygon(band, "ray fill faint"))
    if focus <= WALL_DISTANCE:
        left, right = _slice(focus + back, half_tan, back)
        parts.append(drawing.line(left, right, "ray bold"))
    wall = on_plan(0, WALL_DISTANCE)[1]
    mark = focus_mark(focus, back)
    row, label = mark[1], f"focus {format_number(focus + back, 1)} m"
    baseline = row - 5 if row > wall + 20 else row + 15  # clear of the wall's line
    if focus <= WALL_DISTANCE:
        parts.append(drawing.line((4, row), (PLAN_WIDTH - 4, row), "ray thin dashed faint"))
    else:
        label, baseline = f"{label}, behind the wall", wall - 7
    parts.append(drawing.text((FOCUS_COLUMN - 16, baseline), label, "ray ground", "end"))
    parts.append(drawing.dot(mark, "ray"))
    return "".join(parts)


def _wall(back: float) -> str:
    left, right = (8.0, on_plan(0, WALL_DISTANCE)[1]), (PLAN_WIDTH - 8.0, 0.0)
    row = left[1]
    return drawing.line(left, (right[0], row), "world bold") + drawing.text(
        (10, row - 7), f"wall, {WALL_DISTANCE + back:.3g} m", "world small"
    )


def _thing(thing: Thing, back: float) -> str:
    """The thing in its own colour, which tells it from the others."""
    match thing.solid:
        case Sphere(centre=(x, y, _), radius=radius):
            reach, middle = radius * units_per_metre(back), on_plan(x, y, back)
            turns = np.linspace(0.0, 2.0 * math.pi, 36, endpoint=False)
            outline = [polar(middle, reach, float(turn)) for turn in turns]
        case Box() as box:
            outline = _corners(box, back)
    return swatch_polygon(outline, encode_srgb(thing.albedo).tolist())


def _corners(box: Box, back: float) -> list[Point]:
    half_x, half_y = box.size[0] / 2, box.size[1] / 2
    local = ((-half_x, -half_y), (half_x, -half_y), (half_x, half_y), (-half_x, half_y))
    corners = [np.array([x, y, 0.0]) @ box.world_to_box + box.centre for x, y in local]
    return [on_plan(float(corner[0]), float(corner[1]), back) for corner in corners]


def _lamp(light_angle: float, back: float) -> str:
    """The lamp's direction as an arrow to the middle of the still life, on a circle around it."""
    start, end = (lamp_mark(light_angle, distance, back) for distance in (LAMP_DISTANCE, 2.3))
    return drawing.arrow(start, end, "light bold") + drawing.circle(start, 5.0, "light solid")


def _camera(plan: PlanView) -> str:
    x, row = on_plan(0, 0)
    body = drawing.rectangle((x - 13, row + 5), 26, 15, "camera fill")
    lens = drawing.rectangle((x - 6, row - 1), 12, 6, "camera solid")
    seen = f"{math.degrees(plan.view_rad):.0f}°"
    caption = f"{seen} at {plan.focal_length:.0f} mm" if plan.back else seen
    label = drawing.text((x + 20, row + 17), caption, "camera strong")
    return body + lens + label
