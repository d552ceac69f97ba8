"""Camera Pose: one room in world coordinates and, by p′ = R p + t, in a camera's.

A level camera at the height of the world's origin, dragged and panned in the book's room. The
world's axes are right, down and ahead, in metres.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, matrix_readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.space.orbit import turning
from simulations.engine.space.view import View
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import from_axis_angle
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.projection.pinhole import (
    intrinsics,
    invert_pose,
    project,
    rigid_pose,
    world_to_camera,
)
from simulations.scenes._turned_camera import draw_body, view_from
from simulations.world import plan
from simulations.world.furniture import HIGH
from simulations.world.room import LEVELS, photograph

LAMP = np.array([2.0, -1.0, 5.0])  # 1 m above the camera
ROOM_TO_WORLD = rigid_pose([(0, -1, 0), (0, 0, -1), (1, 0, 0)], (7.5, 1.5, 2.0))
"""From the axes of the room, right, ahead and up, to this scene's world."""
FIELD_RAD = math.radians(60.0)  # the camera's field of view
FLOOR_Y = float(ROOM_TO_WORLD[1, 3])  # metres below the camera
AXIS_M = 2.5  # drawn length of axes


def in_axes(places: Floats) -> Floats:
    """Places of the room's plan (n, 2) in this scene's world (n, 3), on the floor."""
    return world_to_camera(np.insert(places, 2, 0.0, axis=1), ROOM_TO_WORLD)


WALLS, DOOR = in_axes(plan.WALLS), in_axes(plan.DOOR)

WIDTH, HEIGHT = 400.0, 310.0
UNITS_PER_M, WORLD_UNITS = 19.0, 28.0
"""In camera coordinates, where the whole room turns in its panel, and in world coordinates."""
MIDDLE, MIDDLE_M = (200.0, 155.0), (6.0, 0.0, 2.0)
"""The world's place, metres, that stays in the middle of the first panel while it is turned. From
above, right is right, and ahead is up."""
CAMERA_ORIGIN = np.array([200.0, 214.0])
"""The camera in the second panel; it is moved where the room would not fit."""
BORDERS = (0.0, 0.0), (WIDTH, HEIGHT)
MARGIN = 4.0  # least distance of the room from the border of the second panel, in view box units
BODY = 1.5
"""Size of the drawn camera: larger than true."""
NAME_M = (1.0, 0.5)  # from an axis's name back from its tip, and aside from the axis
BESIDE = 12.0  # from a label to the lamp, and to the middle of t, in view box units

type ToPanel = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True)
class Settings:
    pan: float = slider("Pan ψ", -90, -180, 180, 1, unit="°")
    camera_x: float = slider("Camera, right (X)", 10.0, 0, 12, 0.1, unit="m")
    camera_z: float = slider("Camera, ahead (Z)", 2.0, -2, 6, 0.1, unit="m")
    azimuth: float = slider("View azimuth", 0, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 90, 0, 90, 1, unit="°")


@dataclass(frozen=True, slots=True)
class Standpoint:
    """A level camera in the room."""

    pose: Floats
    """World to camera, (4, 4)."""

    @property
    def rotation(self) -> Floats:
        """World to camera, (3, 3): the camera's axes as rows."""
        return self.pose[:3, :3]

    @property
    def t(self) -> Floats:
        """(3,) metres: the world's origin in camera coordinates."""
        return self.pose[:3, 3]

    @property
    def centre(self) -> Floats:
        """(3,) metres, in the world."""
        return invert_pose(self.pose)[:3, 3]

    @property
    def field(self) -> Floats:
        """(n, 3) metres, in the world: the part of the floor within a field of view of 60°."""
        depth = 20.0
        aside = depth * math.tan(FIELD_RAD / 2.0)
        wedge = np.array([(0.0, 0.0, 0.0), (-aside, 0.0, depth), (aside, 0.0, depth)])
        ahead = ((wedge - self.t) @ self.rotation)[:, [0, 2]]
        plan = clip_to_rectangle(ahead, *np.sort(WALLS[[0, 2]][:, [0, 2]], axis=0))
        return np.insert(plan, 1, FLOOR_Y, axis=1)

    def in_camera_axes(self, points: Floats) -> Floats:
        """World points (..., 3) in camera coordinates."""
        return world_to_camera(points, self.pose)


def standpoint(pan: float, camera_x: float, camera_z: float) -> Standpoint:
    """A camera at (camera_x, 0, camera_z), panned by so many degrees to the right."""
    R = from_axis_angle((0.0, 1.0, 0.0), math.radians(pan)).T
    return Standpoint(rigid_pose(R, -R @ np.array([camera_x, 0.0, camera_z])))


def space(azimuth: float, elevation: float) -> View:
    """The world in the first panel; at 0° from behind, so that right is right."""
    return View(view_from(azimuth + 180.0, elevation), MIDDLE, WORLD_UNITS, MIDDLE_M)


def camera_to_panel(here: Standpoint, look: View) -> ToPanel:
    """Points (..., 3) in camera coordinates in the second panel's view box (..., 2), which shows
    the whole room."""
    to_view = View(look.axes, unit=UNITS_PER_M)
    room = to_view.all(here.in_camera_axes(WALLS))
    least = MARGIN - room.min(axis=0)
    most = np.array([WIDTH, HEIGHT]) - MARGIN - room.max(axis=0)
    x, y = np.clip(CAMERA_ORIGIN, least, most).tolist()
    return View(look.axes, (x, y), UNITS_PER_M).all


def from_camera(here: Standpoint, look: View) -> ToPanel:
    """Camera coordinates to the first panel."""
    return lambda points: look.all((points - here.t) @ here.rotation)


def to_camera(here: Standpoint, look: View) -> ToPanel:
    """World coordinates to the second panel."""
    place = camera_to_panel(here, look)
    return lambda points: place(here.in_camera_axes(points))


def picture(standpoint: Standpoint, columns: int) -> Raster:
    """The room as the camera sees it."""
    return photograph(
        columns / 2 / math.tan(FIELD_RAD / 2), standpoint.pose @ ROOM_TO_WORLD, columns
    )


def picture_panel(here: Standpoint, raster: Raster) -> Panel:
    """What the camera sees, with the lamp if it is in view."""
    wide, high = 400.0, 300.0
    K = intrinsics(wide / 2 / math.tan(FIELD_RAD / 2), (wide / 2, high / 2))
    ends = here.in_camera_axes(np.stack([LAMP, LAMP * [1, 0, 1] + [0, FLOOR_Y - HIGH[2], 0]]))
    pixels, valid = project(ends, K)
    cord = clip_to_rectangle(pixels, (0.0, 0.0), (wide, high), False) if valid.all() else pixels[:0]
    overlay = drawing.polyline(cord, "light thin") if len(cord) else ""
    if len(cord) and np.array_equal(cord[0], pixels[0]):
        x, y = pixels[0]
        overlay += drawing.dot((x, y), "light", 6.0)
        overlay += drawing.text((x - BESIDE, y + 4.0), "lamp", "light small ground", "end")
    return Panel("picture", "What the camera sees", wide, high, raster, overlay, lead=True)


def world_panel(here: Standpoint, look: View) -> Panel:
    """The camera's place and its axes."""
    origin, centre, to_view = look.all(np.zeros(3)), look.all(here.centre), from_camera(here, look)
    apart = float(np.hypot(*(centre - origin))) > UNITS_PER_M
    parts = (
        _furniture(look.all, here),
        drawing.line(origin, centre, "muted thin dashed") if apart else "",
        _drop(look.all, here.centre, "camera thin dashed"),
        _axes(look.all, "world", ("X", "Y", "Z"), here),
        draw_body(here.rotation.T, look.axes, tuple(centre), BODY * WORLD_UNITS),
        _axes(to_view, "camera", ("x", "y", "z")),
        _lamp(look.all, -1.0),
    )
    title = "The room in world coordinates"
    return Panel("world", title, WIDTH, HEIGHT, overlay="".join(parts))


def camera_panel(here: Standpoint, look: View) -> Panel:
    """The room in camera coordinates, and the arrow t to the world's origin."""
    place, to_view = to_camera(here, look), camera_to_panel(here, look)
    centre, origin = to_view(np.zeros(3)), place(np.zeros(3))
    length = float(np.hypot(*(origin - centre)))
    apart = length > UNITS_PER_M
    along = (origin - centre) / max(length, 1.0)
    aside = np.array([-along[1], along[0]])
    to_lamp = float(aside @ (place(LAMP) - centre))
    name = (centre + origin) / 2.0 - np.copysign(BESIDE, to_lamp) * aside
    t = _clipped(np.stack([centre, origin]), closed=False) if apart else centre[:0]
    parts = (
        _furniture(place, here),
        _axes(place, "world", ("X", "Y", "Z"), here),
        drawing.arrow(t[0], t[1], "ray bold", 9) if len(t) == 2 else "",
        _name(name, "t", "ray strong") if apart else "",
        draw_body(np.eye(3), look.axes, tuple(centre), BODY * UNITS_PER_M),
        _axes(to_view, "camera", ("x", "y", "z")),
        _lamp(place, aside[0] * to_lamp if apart else 1.0),
    )
    title = "The same room in camera coordinates"
    return Panel("camera", title, WIDTH, HEIGHT, overlay="".join(parts))


def _furniture(place: ToPanel, here: Standpoint) -> str:
    """Floor, the part of it in the camera's field of view, what stands on it, walls and door,
    clipped to the panel."""
    lines = (WALLS[[0, 1]], "world thin"), (DOOR, "world bold")
    return "".join(
        (
            *(
                drawing.group([drawing.polygon(floor, f"{role} solid faint")], "faint")
                for area, role in ((WALLS, "world"), (here.field, "camera"))
                if len(floor := _clipped(place(area), closed=True))
            ),
            plan.plan_markup(lambda corners: place(in_axes(corners)), *BORDERS),
            *(
                drawing.line(ends[0], ends[1], style)
                for points, style in lines
                if len(ends := _clipped(place(points), closed=False)) == 2
            ),
        )
    )


def _axes(
    place: ToPanel, role: str, names: tuple[str, str, str], beside: Standpoint | None = None
) -> str:
    """The axes to the right, down and ahead, from their origin; not those seen end on. The first
    one's name is behind it, or ahead of it if the camera is behind the origin."""
    away = -1.0 if beside and beside.centre[2] < 0.0 else 1.0
    start = place(np.zeros(3))
    parts = []
    right, down, ahead = np.eye(3)
    back, aside = NAME_M
    others = (away * ahead, right, right)
    for name, axis, other in zip(names, (right, down, ahead), others, strict=True):
        tip = place(AXIS_M * axis)
        if float(np.hypot(*(tip - start))) < UNITS_PER_M:
            continue
        parts.append(drawing.arrow(start, tip, role, 7))
        at = place((AXIS_M - back) * axis - aside * other)
        parts.append(_name(at, name, f"{role} italic"))
    return "".join(parts) + drawing.dot(start, role, 3.5)


def _lamp(place: ToPanel, side: float) -> str:
    """The lamp, with its name on the right, or on the left if ``side`` is negative."""
    spot = place(LAMP)
    if not bool(np.all(spot > 0.0) and spot[0] < WIDTH and spot[1] < HEIGHT):
        return ""
    right = spot[0] < 50.0 or (side >= 0.0 and spot[0] < WIDTH - 50.0)
    at = (spot[0] + (BESIDE if right else -BESIDE), spot[1] + 4.0)
    name = drawing.text(at, "lamp", "light small ground", "start" if right else "end")
    return _drop(place, LAMP, "light thin") + drawing.dot(spot, "light", 5.5) + name


def _drop(place: ToPanel, point: Floats, style: str) -> str:
    """A line down to the floor."""
    foot = np.array([point[0], FLOOR_Y, point[2]])
    return drawing.polyline(_clipped(place(np.stack([point, foot])), closed=False), style)


def _name(at: Floats, words: str, style: str) -> str:
    """A label centred at a place, if that is well inside the panel."""
    inside = 12.0 < at[0] < WIDTH - 12.0 and 12.0 < at[1] < HEIGHT - 10.0
    return drawing.text((at[0], at[1] + 4.0), words, f"{style} ground", "middle") if inside else ""


def _clipped(points: Floats, *, closed: bool) -> Floats:
    """A line or an area clipped to the view box."""
    return clip_to_rectangle(points, *BORDERS, closed)


def triple(values: Floats) -> str:
    """Three coordinates to the decimetre."""
    return f"({', '.join(format_number(float(value), 1) for value in values)})"


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The room twice, the pose, and the lamp in camera coordinates."""
    here: Standpoint = outputs["standpoint"]
    t, lamp = triple(here.t), triple(here.in_camera_axes(LAMP))
    look = space(settings.azimuth, settings.elevation)
    drawn = world_panel(here, look), camera_panel(here, look)
    return Frame(
        (picture_panel(here, outputs["picture"]), *drawn),
        (
            matrix_readout("R", "R", here.rotation.tolist(), role="camera"),
            Readout("t", "t", t, "m", role="ray"),
            Readout("lamp", "Lamp p′ = R p + t", lamp, "m", role="light"),
        ),
        "A room as a camera sees it, and from above, in world and in camera coordinates. The "
        f"camera at {triple(here.centre)} m, panned by {format_number(settings.pan, 0)}°, has "
        f"the world’s origin at t = {t} m and the lamp, which is at {triple(LAMP)} m "
        f"in the world, at {lamp} m.",
    )


def on_axis(forward: float) -> Callable[[Settings, Outputs], Point]:
    """The place of a point so many metres ahead of the camera."""
    point = np.array([0.0, 0.0, forward])

    def at(settings: Settings, outputs: Outputs) -> Point:
        look = space(settings.azimuth, settings.elevation)
        return tuple(from_camera(outputs["standpoint"], look)(point).tolist())

    return at


def camera_pulled(settings: Settings, place: Point) -> dict[str, float]:
    look = space(settings.azimuth, settings.elevation)
    found = look.on_plane(place, (0, 0, 0), [(1, 0, 0), (0, 0, 1)])
    return dict(zip(MOVES, found, strict=True)) if found else {}


def tip_pulled(settings: Settings, place: Point) -> dict[str, float]:
    """The camera looks to the place."""
    at = camera_pulled(settings, place)
    if not at:
        return {}
    right, ahead = at["camera_x"] - settings.camera_x, at["camera_z"] - settings.camera_z
    return {"pan": math.degrees(math.atan2(right, ahead))}


MOVES = ("camera_x", "camera_z")
SCENE = Scene(
    "camera-pose",
    "Camera Pose",
    Settings,
    draw,
    (Stage("standpoint", standpoint), Stage("picture", picture, ("standpoint",))),
    handles=(
        Handle("camera", "world", "Camera", MOVES, on_axis(0.0), camera_pulled, role="camera"),
        Handle(
            "tip", "world", "Tip of axis z", ("pan",), on_axis(AXIS_M), tip_pulled, role="camera"
        ),
        turning("world"),
    ),
    accuracy=Accuracy(levels=(*columns(100), *LEVELS)),
    formula=world_to_camera,
)
