"""Two views of a lamp: its disparity, the epipolar line, and the error of the depth."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_number,
    matrix_readout,
    readout,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.projection.two_views import (
    depth_error,
    depth_from_disparity,
    essential_matrix,
)
from simulations.scenes.two_views.view import (
    COLUMNS,
    DRAFT_COLUMNS,
    EYE,
    FROM_ROOM,
    HALF_WIDTH_PX,
    LampView,
    Pair,
    by_turns_panel,
    in_picture,
    lamp_view,
    photograph,
    pixel_at,
    place,
    right_panel,
)
from simulations.world import plan

DRAFT = "draft"  # the photographs while a camera moves
NEAREST_M = 0.5  # least depth, for places nearer to the plane of the left camera or behind it

WIDTH, HEIGHT = 400.0, 300.0  # of the view from above
CENTRE = np.array([28.0, 133.0])
"""The left camera, seen from above: depth to the right, X downwards."""
UNITS_PER_M = 28.0
AXIS_ROW = HEIGHT - 24.0  # of the axis of depths, whose ticks are named below it
LIMIT_ROW = AXIS_ROW - 8.0  # lower border of the drawing
FAR_M = 60.0  # length of drawn rays, beyond the panel
INSIDE = Rectangle(4.0, 4.0, WIDTH - 4.0, AXIS_ROW - 4.0)  # room for labels
AXIS_M = 3.0  # distance of the handle on the right camera's axis


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


def pair_of(settings: Settings) -> Pair:
    return Pair(settings.focal_length, settings.baseline, math.radians(settings.toe_in))


def left_photograph(focal_length: float, columns: int) -> Raster:
    return photograph(Pair(focal_length, 1.0, 0.0), columns, right=False)


def right_photograph(focal_length: float, baseline: float, toe_in: float, columns: int) -> Raster:
    return photograph(Pair(focal_length, baseline, math.radians(toe_in)), columns, right=True)


def view_of(settings: Settings) -> LampView:
    left = np.array([settings.left_x, -settings.left_up])
    return lamp_view(pair_of(settings), settings.depth, left, settings.matching_error)


def above(Z: float, X: float) -> Floats:
    """Metres to the view box from above."""
    return CENTRE + UNITS_PER_M * np.array([Z, X])


def metres_at(spot: Point) -> Floats:
    """Z and X at a place of the view from above."""
    return (np.asarray(spot, float) - CENTRE) / UNITS_PER_M


def axis_end(baseline: float, toe_in_rad: float) -> Floats:
    """The handle on the right camera's axis, in the view box."""
    return above(AXIS_M * math.cos(toe_in_rad), baseline - AXIS_M * math.sin(toe_in_rad))


def within(points: Floats, *, closed: bool = True) -> Floats:
    """A line or an area clipped to the panel."""
    return clip_to_rectangle(points, (0.0, 0.0), (WIDTH, LIMIT_ROW), closed)


def segment(start: Floats, end: Floats, style: str) -> str:
    points = within(np.array([start, end]), closed=False)
    return drawing.line(points[0], points[1], style) if len(points) > 1 else ""


def plan_panel(view: LampView) -> Panel:
    """The views from above: centres, baseline, the rays that meet in the lamp, and the uncertainty
    of the depth."""
    origin, right, far = above(0.0, 0.0), above(0.0, view.pair.baseline), view.at(FAR_M)
    parts = (
        plan.drawn(from_above, (0.0, 0.0), (WIDTH, LIMIT_ROW)),
        depth_axis(),
        cameras(view),
        doubt(view),
        segment(origin, above(far[2], far[0]), "ray"),
        segment(right, above(view.point[2], view.point[0]), "ray"),
        drawing.dot(above(view.depth, float(view.point[0])), "world", 5.0),
        names(view),
    )
    return Panel("plan", "From above", WIDTH, HEIGHT, overlay="".join(parts))


def from_above(corners: Floats) -> Floats:
    """Places (n, 2) of the room's plan in the view box."""
    X, _, Z = ((np.insert(corners, 2, EYE[2], axis=1) - EYE) @ FROM_ROOM.T).T
    return CENTRE + UNITS_PER_M * np.stack([Z, X], axis=-1)


def depth_axis() -> str:
    columns = [(Z, above(Z, 0.0)[0]) for Z in (2, 4, 6, 8, 10, 12)]
    ticks = "".join(
        drawing.line((x, AXIS_ROW - 3), (x, AXIS_ROW + 3), "muted")
        + drawing.text((x, AXIS_ROW + 18.0), f"{Z}", "muted small", "middle")
        for Z, x in columns
    )
    start, end = (CENTRE[0], AXIS_ROW), (WIDTH - 4.0, AXIS_ROW)
    name = drawing.text((CENTRE[0], AXIS_ROW + 18.0), "Z, m", "muted small")
    return drawing.arrow(start, end, "muted thin") + name + ticks


def cameras(view: LampView) -> str:
    """Both centres, the baseline, and the fields of view."""
    pair = view.pair
    slope = HALF_WIDTH_PX / pair.focal_px
    left, right = above(0.0, 0.0), above(0.0, pair.baseline)
    parts = []
    for X, turn in ((0.0, 0.0), (pair.baseline, pair.toe_in_rad)):
        for side in (-slope, slope):
            angle = math.atan(side) - turn
            end = above(FAR_M * math.cos(angle), X + FAR_M * math.sin(angle))
            parts.append(segment(above(0.0, X), end, "camera thin faint dashed"))
    low = min(right[1] + 24.0, HEIGHT - 40.0)
    parts += [
        segment(right, axis_end(pair.baseline, pair.toe_in_rad), "camera thin"),
        drawing.line(left, right, "camera bold"),
        drawing.dot(left, "camera", 4.5),
        drawing.dot(right, "camera", 4.5),
        drawing.text((4.0, left[1] - 12.0), "left", "camera small ground"),
        drawing.text((4.0, low), "right", "camera small ground"),
    ]
    return "".join(parts)


def doubt(view: LampView) -> str:
    """The part of the left ray that is consistent with the match and its error, with the
    directions of the right camera that lead to it, and its depths on the axis."""
    if view.nearest == view.farthest:
        return ""
    near, far = view.at(view.nearest), view.at(min(view.farthest, FAR_M))
    ends = np.array([above(near[2], near[0]), above(far[2], far[0])])
    wedge = within(np.array([above(0.0, view.pair.baseline), *ends]))
    parts = [drawing.polygon(wedge, "error thin fill")] if len(wedge) > 2 else []
    parts.append(segment(ends[0], ends[1], "error bold"))
    for x, y in ends[ends[:, 0] <= WIDTH]:
        start = min(max(y, 0.0), LIMIT_ROW)
        parts.append(drawing.line((x, start), (x, AXIS_ROW), "error thin dashed"))
    left, right = np.minimum(ends[:, 0], WIDTH)
    if left < right:
        parts.append(drawing.line((left, AXIS_ROW), (right, AXIS_ROW), "error bold"))
    return "".join(parts)


def names(view: LampView) -> str:
    """The names of the lamp, of the handle on the right camera's axis and of the range of depths,
    clear of the rays."""
    right = above(0.0, view.pair.baseline)
    axis = axis_end(view.pair.baseline, view.pair.toe_in_rad)
    spot = above(view.depth, float(view.point[0]))
    labels = [
        Label(spot, "lamp", "world small ground", "above", 14.0),
        Label(axis, "turn", "camera small ground", "below", 14.0),
    ]
    if view.nearest < view.farthest:
        depths = (view.nearest, view.farthest)
        near, far = (min(float(above(depth, 0.0)[0]), WIDTH) for depth in depths)
        bar, others = (far, AXIS_ROW - 10.0), [(near, AXIS_ROW - 10.0)]
        labels.append(Label(bar, "depths that fit", "error small ground", "right", others=others))
    below = spot + np.array([0.0, 30.0])
    rays = [(above(0.0, 0.0), spot), (right, spot), (right, axis), (spot, below)]
    curves: list[list[drawing.Point]] = [list(ends) for ends in rays]
    return place_labels(labels, INSIDE, curves)


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
            plan_panel(view),
        ),
        (
            readout("d", "d, disparity", view.disparity, "px", digits=1, role="image"),
            readout("parallel", "f b / d", float(parallel), "m", digits=1, role="image")
            if valid
            else Readout("parallel", "f b / d", "none: d < 0", "", "image"),
            Readout(
                "interval",
                "Z, with the error",
                near if near == far else f"{near} to {far}",
                "m",
                "error",
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
    seen = "" if in_picture(view.right) else ", outside the right picture"
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
        f"{format_number(view.disparity, 1)} px and is {row}{seen}"
        + (f"; a match good to {format_number(error, 1)} px {doubt}." if error else ".")
    )


def lamp_at(settings: Settings, _outputs: Outputs) -> Point:
    X = settings.left_x / settings.focal_length * settings.depth
    return tuple(above(settings.depth, X).tolist())


def lamp_pulled(settings: Settings, spot: Point) -> dict[str, float]:
    """Its height in the world changes with it; its height in the left picture does not."""
    Z, X = metres_at(spot).tolist()
    depth = max(Z, NEAREST_M)
    return {"depth": depth, "left_x": settings.focal_length * X / depth}


def axis_at(settings: Settings, _outputs: Outputs) -> Point:
    return tuple(axis_end(settings.baseline, math.radians(settings.toe_in)).tolist())


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
        Handle(
            "lamp",
            "plan",
            "Lamp",
            ("depth", "left_x"),
            lamp_at,
            lamp_pulled,
            role="world",
            reversed=("left_x",),
        ),
        Handle(
            "camera",
            "plan",
            "Right camera",
            ("baseline",),
            lambda settings, _: tuple(above(0.0, settings.baseline).tolist()),
            role="camera",
            reversed=("baseline",),
        ),
        Handle("axis", "plan", "Axis of the right camera", ("toe_in",), axis_at, role="camera"),
        Handle(
            "left",
            "turns",
            "Left image of the lamp",
            ("left_x", "left_up"),
            left_at,
            left_pulled,
            role="image",
        ),
        Handle(
            "right",
            "right",
            "Right image of the lamp",
            ("depth",),
            right_at,
            right_pulled,
            role="image",
        ),
    ),
    parameters=lambda _, tier: {"columns": DRAFT_COLUMNS if tier == DRAFT else COLUMNS},
    own_drafts={DRAFT: ("focal_length", "baseline", "toe_in")},
    formula=depth_from_disparity,
)
