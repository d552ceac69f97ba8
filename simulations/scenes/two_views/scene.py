"""Two views of a lamp: its disparity, the epipolar line, and the error of the depth."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.frame import Frame, Raster, Readout, format_number, matrix_readout, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.space.orbit import turning
from simulations.engine.space.view import View
from simulations.engine.stages import Outputs, Stage
from simulations.models.projection.two_views import (
    depth_error,
    depth_from_disparity,
    essential_matrix,
)
from simulations.scenes.two_views.space import axis_end, space, space_panel
from simulations.scenes.two_views.view import (
    LampView,
    Pair,
    by_turns_panel,
    in_picture,
    lamp_view,
    photo,
    pixel_at,
    place,
    right_panel,
)
from simulations.world.room import LEVELS

NEAREST_M = 0.5  # least depth, for places nearer to the plane of the left camera or behind it


@dataclass(frozen=True, slots=True)
class Settings:
    depth: float = slider("Depth (Z)", 8.0, 1.5, 9.0, 0.1, unit="m")
    baseline: float = slider("Baseline", 0.5, 0.1, 1.0, 0.05, unit="m")
    wiggle: int = action("Wiggle", "Stop", drives="look", effect="play", seconds=5.0, arrival=True)
    toe_in: float = slider("Toe-in (right)", 0.0, 0.0, 30.0, 1.0, unit="°")
    matching_error: float = slider("Error of the match", 1.0, 0.0, 4.0, 0.1, unit="px")
    focal_length: float = slider("Focal length", 160.0, 100.0, 320.0, 5.0, unit="px")
    left_x: float = slider("Left picture, right", 30.0, -75.0, 75.0, 1.0, unit="px")
    left_up: float = slider("Left picture, up", 20.0, 0.0, 40.0, 1.0, unit="px")
    look: float = slider("Look (odd: left, even: right)", 1, 0, 13, 1)
    azimuth: float = slider("View azimuth", 112, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 44, -90, 90, 1, unit="°")


def pair_of(settings: Settings) -> Pair:
    return Pair(settings.focal_length, settings.baseline, math.radians(settings.toe_in))


def left_photograph(focal_length: float, columns: int) -> Raster:
    return photo(Pair(focal_length, 1.0, 0.0), columns, right=False)


def right_photograph(focal_length: float, baseline: float, toe_in: float, columns: int) -> Raster:
    return photo(Pair(focal_length, baseline, math.radians(toe_in)), columns, right=True)


@lru_cache(maxsize=4)  # drawing and handles ask for it several times a frame
def view_of(settings: Settings) -> LampView:
    left = np.array([settings.left_x, -settings.left_up])
    return lamp_view(pair_of(settings), settings.depth, left, settings.matching_error)


def space_of(settings: Settings) -> View:
    return space(settings.azimuth, settings.elevation)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The lamp from above, and as both cameras see it."""
    view = view_of(settings)
    pair, error, off = view.pair, settings.matching_error, float(view.right[1] - view.left[1])
    first_order = float(depth_error(view.depth, pair.focal_px, pair.baseline, error))
    parallel, valid = depth_from_disparity(view.disparity, pair.focal_px, pair.baseline)
    near, far = (format_number(depth, 2) for depth in (view.nearest, view.farthest))
    E = essential_matrix(pair.R, pair.t).tolist()
    return Frame(
        (
            by_turns_panel(
                view, outputs["right" if looks_right(settings) else "left"], looks_right(settings)
            ),
            right_panel(view, outputs["right"]),
            space_panel(view, space_of(settings)),
        ),
        (
            readout("d", "d, disparity", view.disparity, "px", digits=1, role="image"),
            readout("parallel", "f b / d", float(parallel), "m", digits=1, role="image")
            if valid
            else Readout("parallel", "f b / d", "none: d < 0", "", role="image"),
            Readout(
                "interval",
                "Z, with the error",
                near if near == far else f"{near} to {far}",
                "m",
                role="error",
            ),
            readout("first_order", "±Z²Δd / f b", first_order, "m", role="error"),
            readout("off_row", "y right − y left", off, "px", digits=1, role="ray"),
            matrix_readout("E", "E = [t]ₓ R", E, role="camera"),
        ),
        describe(settings, view, off),
    )


def describe(settings: Settings, view: LampView, off: float) -> str:
    turned, error = settings.toe_in, settings.matching_error
    position = f"{format_number(settings.baseline)} m apart, " + (
        f"the right one turned in by {turned:.0f}°" if turned else "looking the same way"
    )
    visibility = "" if in_picture(view.right) else ", outside the right picture"
    row = (
        "in the same row of both pictures"
        if abs(off) < 0.05
        else f"{format_number(abs(off), 1)} px {'lower' if off > 0 else 'higher'} in the right one"
    )
    doubt = (
        f"leaves its depth open from {format_number(view.nearest)} m on"
        if math.isinf(view.farthest)
        else f"leaves its depth between {format_number(view.nearest)} and "
        f"{format_number(view.farthest)} m"
    )
    return (
        f"Two cameras {position}, in a room with balls and boxes. A lamp "
        f"{format_number(view.depth, 1)} m away has a disparity of "
        f"{format_number(view.disparity, 1)} px and is {row}{visibility}"
        + (f"; a match good to {format_number(error, 1)} px {doubt}." if error else ".")
    )


def lamp_at(settings: Settings, _outputs: Outputs) -> Point:
    return space_of(settings).at(*view_of(settings).point)


def lamp_moved(settings: Settings, spot: Point) -> dict[str, float]:
    """Its height in the world changes with it; its height in the left picture does not."""
    rise = -settings.left_up / settings.focal_length  # the lamp moves on the plane Y = rise · Z
    found = space_of(settings).on_plane(spot, (0, 0, 0), [(1, 0, 0), (0, rise, 1)])
    if found is None:
        return {}
    depth = max(found[1], NEAREST_M)
    return {"depth": depth, "left_x": settings.focal_length * found[0] / depth}


def camera_at(settings: Settings, _outputs: Outputs) -> Point:
    return space_of(settings).at(settings.baseline, 0.0, 0.0)


def axis_at(settings: Settings, _outputs: Outputs) -> Point:
    return space_of(settings).at(*axis_end(pair_of(settings)))


def looks_right(settings: Settings) -> bool:
    return settings.look % 2 == 0.0


def left_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The lamp's left image; none while the right photograph is in its place."""
    if looks_right(settings):
        return None
    return tuple(place((settings.left_x, -settings.left_up)).tolist())


def left_pulled(_settings: Settings, spot: Point) -> dict[str, float]:
    x, y = pixel_at(spot).tolist()
    return {"left_x": x, "left_up": -y}


def right_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The lamp's right image; none if the right camera does not see it."""
    pixel = view_of(settings).right
    return tuple(place(pixel).tolist()) if in_picture(pixel) else None


def right_pulled(settings: Settings, spot: Point) -> dict[str, float]:
    """The depth at a place along the epipolar line."""
    view = view_of(settings)
    return {"depth": view.pair.depth(view.left, pixel_at(spot))}


SCENE = Scene(
    "two-views",
    "Two Views",
    Settings,
    draw,
    (Stage("left", left_photograph), Stage("right", right_photograph)),
    handles=(
        Handle("lamp", "plan", "Lamp", ("depth", "left_x"), lamp_at, lamp_moved, role="world"),
        Handle("camera", "plan", "Right camera", ("baseline",), camera_at, role="camera"),
        Handle("axis", "plan", "Axis of the right camera", ("toe_in",), axis_at, role="camera"),
        turning("plan"),
        Handle(
            "left",
            "turns",
            "Left image of the lamp",
            drives=("left_x", "left_up"),
            at=left_at,
            pull=left_pulled,
            role="image",
        ),
        Handle(
            "right",
            "right",
            "Right image of the lamp",
            drives=("depth",),
            at=right_at,
            pull=right_pulled,
            role="image",
        ),
    ),
    accuracy=Accuracy(levels=(*columns(120), *LEVELS)),
    formula=depth_from_disparity,
)
