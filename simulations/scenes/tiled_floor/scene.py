"""A tiled floor in perspective: vanishing points, the horizon, and measurements by them."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.settings import slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.projection.level_ground import ground_to_image
from simulations.models.projection.vanishing import angle_between, vanishing_point
from simulations.pictures.tiled_floor import Box, tiled_floor, with_box
from simulations.scenes.tiled_floor.view import (
    HEIGHT,
    HEIGHT_PX,
    MIDDLE,
    PICTURE,
    PLANE,
    WIDTH,
    WIDTH_PX,
    Camera,
    Window,
    camera,
    height_in_picture,
    inside,
    picture_overlay,
    plane_overlay,
)

SMALL_COLUMNS = 160  # its width in the image plane
BOX_WIDTH_M = 1.0
ASIDE_PX = 80.0
"""Distance along the horizon of its handle from the box's, which start in the middle."""


@dataclass(frozen=True, slots=True)
class Settings:
    pitch: float = slider("Look down (pitch)", 12.0, -20.0, 60.0, 1.0, unit="°")
    yaw: float = slider("Turn right (yaw)", 30.0, -60.0, 60.0, 1.0, unit="°")
    height: float = slider("Camera height", 1.6, 0.4, 4.0, 0.1, unit="m")
    focal_length: float = slider("Focal length", 320.0, 150.0, 800.0, 10.0, unit="px")
    box_height: float = slider("Box height", 1.0, 0.2, 3.0, 0.1, unit="m")
    box_x: float = slider("Box offset", 2.2, -6.0, 8.0, 0.1, unit="m")
    box_y: float = slider("Box distance", 4.2, 2.0, 12.0, 0.1, unit="m")
    roll: float = slider("Lean right (roll)", 0.0, -30.0, 30.0, 1.0, unit="°")
    principal_x: float = slider("Principal point, right", 0.0, -150.0, 150.0, 1.0, unit="px")
    principal_y: float = slider("Principal point, down", 0.0, -150.0, 150.0, 1.0, unit="px")
    lines: bool = toggle("Lines to the vanishing points", default=True)


def camera_of(settings: Settings) -> Camera:
    return camera(
        settings.pitch,
        settings.yaw,
        settings.height,
        settings.focal_length,
        settings.roll,
        settings.principal_x,
        settings.principal_y,
    )


def box_of(settings: Settings) -> Box:
    return Box(settings.box_x, settings.box_y, BOX_WIDTH_M, settings.box_height)


def drawn_intrinsics(view: Camera, columns: int) -> Floats:
    """K (3, 3) for the drawn pixels x', from the camera's x: x' + ½ = s (x + ½)."""
    s = columns / WIDTH_PX
    shift = 0.5 * (s - 1.0)
    return np.array([[s, 0.0, shift], [0.0, s, shift], [0.0, 0.0, 1.0]]) @ view.K


def floor(view: Camera, columns: int) -> NDArray[np.float32]:
    rows = columns * HEIGHT_PX // WIDTH_PX
    return tiled_floor(view.pose, drawn_intrinsics(view, columns), columns, rows)


def photograph(
    floor: NDArray[np.float32],
    view: Camera,
    box_x: float,
    box_y: float,
    box_height: float,
    columns: int,
) -> Raster:
    box = Box(box_x, box_y, BOX_WIDTH_M, box_height)
    K = drawn_intrinsics(view, columns)
    return opaque(encode_srgb_codes(with_box(floor, view.pose, K, box)))


def wider(photograph: Raster) -> Raster:
    """The photograph, reduced, in the middle of an otherwise empty image plane."""
    rows, columns, _ = photograph.shape
    step = columns // SMALL_COLUMNS
    height, width = rows // step, SMALL_COLUMNS
    lines = photograph[::step].astype(np.uint16)
    for line in range(1, step):
        lines += photograph[line::step]
    total = sum(lines[:, column::step] for column in range(step))
    plane = np.zeros((PLANE.widths * height, PLANE.widths * width, 4), np.uint8)
    plane[height : 2 * height, width : 2 * width] = (total + step * step // 2) // (step * step)
    return plane


def horizon_row(view: Camera) -> float:
    """The row in which the horizon crosses the picture's middle column."""
    a, b, c = view.horizon
    return float(-(a * MIDDLE[0] + c) / b)


def field_of_view_deg(view: Camera) -> float:
    """The angle between the ends of the row of the principal point, which may be outside it."""
    ends = np.array([-0.5, WIDTH_PX - 0.5]) - view.K[0, 2]
    left, right = np.arctan(ends / view.K[0, 0])
    return math.degrees(right - left)


def pixel_words(pixel: Floats, finite: bool) -> str:
    if not finite:
        return "at infinity"
    return f"({format_number(pixel[0], 0)}, {format_number(pixel[1], 0)})"


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph, and the image plane around it."""
    view, box = outputs["camera"], box_of(settings)
    over, around = (draw(view, box, settings.lines) for draw in (picture_overlay, plane_overlay))
    photograph, wide = outputs["picture"], outputs["wider"]
    return Frame(
        (
            Panel("picture", "What the camera sees", WIDTH, HEIGHT, photograph, over, lead=True),
            Panel("plane", "The whole image plane", WIDTH, HEIGHT, wide, around),
        ),
        readouts(view, box),
        describe(settings, view),
    )


def readouts(view: Camera, box: Box) -> tuple[Readout, ...]:
    first, second = view.directions[:2] @ view.K.T
    angle = math.degrees(float(angle_between(first, second, view.K)))
    names = (("v1", "v₁, rows"), ("v2", "v₂, across"), ("v3", "v₃, uprights"))
    measured, label = height_in_picture(view, box), "Box height by the horizon"
    return (
        readout("horizon", "Horizon in row", horizon_row(view), "px", digits=1, role="camera"),
        *(
            Readout(*name, pixel_words(pixel, finite), "px" if finite else "", role="image")
            for name, pixel, finite in zip(names, *view.vanishing, strict=True)
        ),
        readout("angle", "Angle of K⁻¹v₁, K⁻¹v₂", angle, "°", digits=1, role="ray"),
        Readout("box", label, "behind", "", role="world")
        if measured is None
        else readout("box", label, measured, "m", role="world"),
        readout("view", "Field of view", field_of_view_deg(view), "°", digits=1, role="camera"),
    )


def describe(settings: Settings, view: Camera) -> str:
    pitch, yaw = settings.pitch, settings.yaw
    tilt = f"{abs(pitch):.0f}° {'down' if pitch > 0 else 'up'}" if pitch else "level"
    turn = f" and {abs(yaw):.0f}° to the {'right' if yaw > 0 else 'left'}" if yaw else ""
    row = horizon_row(view)
    horizon = (
        f"in row {format_number(row, 0)}"
        if 0 <= row < HEIGHT_PX
        else f"{'above' if row < 0 else 'below'} the picture"
    )
    pixels, finite = view.vanishing
    first, second = (
        f"at {pixel_words(pixel, True)} px" if near else "at infinity"
        for pixel, near in zip(pixels[:2], finite[:2], strict=True)
    )
    return (
        f"A camera {format_number(settings.height, 1)} m above a tiled floor by the sea looks "
        f"{tilt}{turn}. The horizon is {horizon}, the rows of tiles vanish {first}, those across "
        f"them {second}. {box_words(settings, view)}"
    )


def box_words(settings: Settings, view: Camera) -> str:
    box = box_of(settings)
    size = f"A box {format_number(box.height, 1)} m tall stands"
    (pixel, visible) = view.image(np.array([box.x, box.y, 0.0]))
    if not visible:
        return f"{size} behind the camera."
    away = f"{size} {format_number(math.hypot(box.x, box.y), 1)} m away"
    if not (0.0 <= pixel[0] < WIDTH_PX and 0.0 <= pixel[1] < HEIGHT_PX):
        return f"{away}, outside the picture."
    relation = box.height - settings.height
    top = "on" if abs(relation) < 1e-6 else "above" if relation > 0 else "below"
    return f"{away}, with its top {top} the horizon."


def foot(settings: Settings, _outputs: Outputs) -> Point | None:
    """The middle of the box's base."""
    pixel, visible = camera_of(settings).image(np.array([settings.box_x, settings.box_y, 0.0]))
    return PICTURE.place(pixel) if visible else None


def foot_pulled(settings: Settings, place: Point) -> Mapping[str, float]:
    """Move the box to the floor at a place; not available in the sky."""
    view = camera_of(settings)
    on_floor = np.linalg.solve(ground_to_image(view.pose, view.K), [*PICTURE.pixel(place), 1.0])
    x, y, nearness = on_floor
    return {"box_x": float(x / nearness), "box_y": float(y / nearness)} if nearness > 0.0 else {}


def top(settings: Settings, _outputs: Outputs) -> Point | None:
    """The middle of the box's top."""
    box = box_of(settings)
    pixel, visible = camera_of(settings).image(np.array([box.x, box.y, box.height]))
    return PICTURE.place(pixel) if visible else None


def level(settings: Settings, _outputs: Outputs) -> Point:
    """A point of the horizon, aside from the one nearest to the principal point."""
    view = camera_of(settings)
    middle, line = view.K[:2, 2], view.horizon
    nearest = middle - (line[:2] @ middle + line[2]) * line[:2]
    aside = ASIDE_PX if settings.principal_x <= 0.0 else -ASIDE_PX
    return PICTURE.place(nearest + aside * np.array([line[1], -line[0]]))


def level_pulled(settings: Settings, place: Point) -> Mapping[str, float]:
    """The horizon is f tan(pitch) from the principal point, upwards in the camera's world."""
    view, roll = camera_of(settings), math.radians(settings.roll)
    x, y = np.array(PICTURE.pixel(place)) - view.K[:2, 2]
    rise = -float(x * math.sin(roll) + y * math.cos(roll))
    return {"pitch": math.degrees(math.atan2(rise, settings.focal_length))}


def vanishing(index: int, window: Window) -> Callable[[Settings, Outputs], Point | None]:
    def at(settings: Settings, _outputs: Outputs) -> Point | None:
        pixels, finite = camera_of(settings).vanishing
        place = window.place(pixels[index])
        return place if finite[index] and inside(place) else None

    return at


def turned(index: int, window: Window) -> Callable[[Settings, Point], Mapping[str, float]]:
    """The yaw at which the rows vanish at a place; the rows across, which have two directions,
    90° to its right or left."""

    def pulled(settings: Settings, place: Point) -> Mapping[str, float]:
        view = camera_of(settings)
        ray = view.pose[:3, :3].T @ np.linalg.solve(view.K, [*window.pixel(place), 1.0])
        forward = view.pose[2, :2]  # on the floor
        right = np.array([forward[1], -forward[0]])
        azimuth = math.degrees(math.atan2(right @ ray[:2], forward @ ray[:2]))
        return {"yaw": (math.copysign(90.0, azimuth) if index else 0.0) - azimuth}

    return pulled


def vanishing_handle(name: str, panel: str, index: int, window: Window) -> Handle[Settings]:
    return Handle(
        name,
        panel,
        f"Vanishing point {'v₁v₂'[2 * index : 2 * index + 2]}",
        drives=("yaw",),
        at=vanishing(index, window),
        pull=turned(index, window),
        role="image",
        reversed=("yaw",),
    )


def principal_pulled(_settings: Settings, place: Point) -> Mapping[str, float]:
    x, y = PLANE.pixel(place)
    return {"principal_x": x - MIDDLE[0], "principal_y": y - MIDDLE[1]}


SCENE = Scene(
    "tiled-floor",
    "A Tiled Floor in Perspective",
    Settings,
    draw,
    (
        Stage("camera", camera),
        Stage("floor", floor, ("camera",)),
        Stage("picture", photograph, ("floor", "camera")),
        Stage("wider", wider, ("picture",)),
    ),
    handles=(
        Handle("level", "picture", "Horizon", ("pitch",), level, level_pulled, role="camera"),
        Handle("box", "picture", "Box", ("box_x", "box_y"), foot, foot_pulled, role="world"),
        Handle("top", "picture", "Top of the box", ("box_height",), top, role="world"),
        vanishing_handle("first", "picture", 0, PICTURE),
        vanishing_handle("first-wide", "plane", 0, PLANE),
        vanishing_handle("second-wide", "plane", 1, PLANE),
        Handle(
            "principal",
            "plane",
            "Principal point",
            drives=("principal_x", "principal_y"),
            at=lambda settings, _: PLANE.place(camera_of(settings).K[:2, 2]),
            pull=principal_pulled,
            role="camera",
            reversed=("principal_y",),
        ),
    ),
    accuracy=Accuracy(levels=columns(160, 320, 640)),
    formula=vanishing_point,
)
