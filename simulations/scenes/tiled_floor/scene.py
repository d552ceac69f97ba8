"""A tiled floor in perspective: vanishing points, the horizon, and measurements by them."""

import math
from dataclasses import fields

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.projection.vanishing import angle_between, vanishing_point
from simulations.scenes.tiled_floor.drawing import HEIGHT, WIDTH, picture_overlay, plane_overlay
from simulations.scenes.tiled_floor.handles import HANDLES
from simulations.scenes.tiled_floor.settings import Settings
from simulations.scenes.tiled_floor.stages import DRAFT, STAGES, parameters
from simulations.scenes.tiled_floor.view import (
    HEIGHT_PX,
    MIDDLE,
    WIDTH_PX,
    Camera,
    box_of,
    height_in_picture,
)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph, and the image plane around it."""
    view, box = outputs["camera"], box_of(settings)
    over, around = (draw(view, box, settings.lines) for draw in (picture_overlay, plane_overlay))
    return Frame(
        panels=(
            Panel(
                "picture",
                "What the camera sees",
                WIDTH,
                HEIGHT,
                outputs["picture"],
                over,
                lead=True,
            ),
            Panel(
                "plane",
                "The whole image plane",
                WIDTH,
                HEIGHT,
                outputs["wider"],
                around,
            ),
        ),
        readouts=_readouts(settings, view),
        description=_description(settings, view),
    )


def horizon_row(view: Camera) -> float:
    """The row in which the horizon crosses the picture's middle column."""
    a, b, c = view.horizon
    return float(-(a * MIDDLE[0] + c) / b)


def field_of_view_deg(view: Camera) -> float:
    """The angle between the ends of the row of the principal point, which may be outside it."""
    ends = np.array([-0.5, WIDTH_PX - 0.5]) - view.K[0, 2]
    left, right = np.arctan(ends / view.K[0, 0])
    return math.degrees(right - left)


def _angle_deg(view: Camera) -> float:
    """Angle between the two rows of tiles, from their vanishing points and K alone."""
    first, second = view.directions[:2] @ view.K.T
    return math.degrees(float(angle_between(first, second, view.K)))


def _place(pixel: np.ndarray, finite: bool) -> str:
    if not finite:
        return "at infinity"
    return f"({format_number(pixel[0], 0)}, {format_number(pixel[1], 0)})"


def _readouts(settings: Settings, view: Camera) -> tuple[Readout, ...]:
    measured = height_in_picture(view, box_of(settings))
    places = [
        Readout(name, label, _place(pixel, finite), "px" if finite else "", "image")
        for name, label, pixel, finite in zip(
            ("v1", "v2", "v3"),
            ("v₁, rows", "v₂, across", "v₃, uprights"),
            *view.vanishing,
            strict=True,
        )
    ]
    box = (
        Readout("box", "Box height by the horizon", "behind", "", "world")
        if measured is None
        else readout("box", "Box height by the horizon", measured, "m", role="world")
    )
    return (
        readout("horizon", "Horizon in row", horizon_row(view), "px", digits=1, role="camera"),
        *places,
        readout("angle", "Angle of K⁻¹v₁, K⁻¹v₂", _angle_deg(view), "°", digits=1, role="ray"),
        box,
        readout("view", "Field of view", field_of_view_deg(view), "°", digits=1, role="camera"),
    )


def _description(settings: Settings, view: Camera) -> str:
    pitch, yaw = settings.pitch, settings.yaw
    tilt = f"{abs(pitch):.0f}° {'down' if pitch > 0 else 'up'}" if pitch else "level"
    turn = f" and {abs(yaw):.0f}° to the {'right' if yaw > 0 else 'left'}" if yaw else ""
    row = horizon_row(view)
    where = "in" if 0 <= row < HEIGHT_PX else "above" if row < 0 else "below"
    horizon = f"row {format_number(row, 0)}" if where == "in" else f"{where} the picture"
    pixels, finite = view.vanishing
    first, second = (
        f"at {_place(pixel, True)} px" if near else "at infinity"
        for pixel, near in zip(pixels[:2], finite[:2], strict=True)
    )
    return (
        f"A camera {format_number(settings.height, 1)} m above a tiled floor looks {tilt}{turn}. "
        f"The horizon is {'in ' if where == 'in' else ''}{horizon}, the rows of tiles vanish "
        f"{first}, those across them {second}. {_box_words(settings, view)}"
    )


def _box_words(settings: Settings, view: Camera) -> str:
    box = box_of(settings)
    size = f"A box {format_number(box.height, 1)} m tall stands"
    (pixel, seen) = view.image(np.array([box.x, box.y, 0.0]))
    if not seen:
        return f"{size} behind the camera."
    away = f"{size} {format_number(math.hypot(box.x, box.y), 1)} m away"
    if not (0.0 <= pixel[0] < WIDTH_PX and 0.0 <= pixel[1] < HEIGHT_PX):
        return f"{away}, outside the picture."
    relation = box.height - settings.height
    top = "on" if abs(relation) < 1e-6 else "above" if relation > 0 else "below"
    return f"{away}, with its top {top} the horizon."


SCENE = Scene(
    id="tiled-floor",
    title="A Tiled Floor in Perspective",
    settings=Settings,
    draw=draw,
    formula=vanishing_point,
    stages=STAGES,
    handles=HANDLES,
    parameters=parameters,
    own_drafts={DRAFT: tuple(each.name for each in fields(Settings) if each.name != "lines")},
)
