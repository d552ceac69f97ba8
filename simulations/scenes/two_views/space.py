"""Cameras, lamp and room in space, to be turned: the plane of both rays, and the depths that the
match leaves possible."""

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.space.view import View
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.scenes._turned_camera import view_from
from simulations.scenes.two_views.view import (
    EYE,
    FROM_ROOM,
    HALF_HEIGHT_PX,
    HALF_WIDTH_PX,
    LampView,
    Pair,
)
from simulations.world import plan

WIDTH, HEIGHT = 400.0, 300.0
BORDERS = (0.0, 0.0), (WIDTH, HEIGHT)
INSIDE = Rectangle(4.0, 4.0, WIDTH - 4.0, HEIGHT - 4.0)  # room for labels
MIDDLE_M = (0.5, 0.3, 4.3)  # centre of the view
FLOOR_M = float(EYE[2])  # Y of the floor
FAR_M = 60.0  # length of drawn rays, beyond the panel
AXIS_M = 2.2  # distance of the handle on the right camera's axis
SCREEN_M = 1.1  # distance of the drawn picture from its camera
TICKS_M = (4.0, 6.0)
PICTURE: Floats = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (HALF_WIDTH_PX, HALF_HEIGHT_PX)


def space(azimuth: float, elevation: float) -> View:
    """The left camera's frame, from a distant eye: 0° is ahead of the cameras, 180° behind them."""
    return View(view_from(azimuth, elevation), (WIDTH / 2, HEIGHT / 2), 37.0, MIDDLE_M)


def axis_end(pair: Pair) -> Floats:
    """The handle on the right camera's axis."""
    return right_to_left_frame(pair, np.array([0.0, 0.0, AXIS_M]))


def right_to_left_frame(pair: Pair, points: Floats) -> Floats:
    """Points (..., 3) of the right camera's frame in the left one's."""
    return np.asarray((points - pair.t) @ pair.R)


def on_screen(pair: Pair, pixels: Floats) -> Floats:
    """Pixels (n, 2) of a picture that is drawn before its camera, in that camera's frame."""
    return SCREEN_M * np.insert(np.asarray(pixels) / pair.focal_px, 2, 1.0, axis=-1)


def space_panel(view: LampView, look: View) -> Panel:
    pair = view.pair
    left, right, lamp = np.zeros(3), np.array([pair.baseline, 0.0, 0.0]), view.point
    under = np.array([lamp[0], FLOOR_M, lamp[2]])
    parts = (
        plan.plan_markup(lambda corners: look.all(on_floor(corners)), *BORDERS),
        depths(look),
        *cameras(view, look),
        drawing.polygon(clipped_to_panel(look, [left, right, lamp], closed=True), "ray fill thin"),
        match_interval(view, look),
        segment(look, [left, view.at(FAR_M)], "ray"),
        segment(look, [right, lamp], "ray"),
        segment(look, [left, right], "camera bold"),
        segment(look, [right, axis_end(pair)], "camera thin"),
        segment(look, [lamp, under], "world thin dashed"),
        *(drawing.dot(look.at(*centre), "camera", 4.5) for centre in (left, right)),
        drawing.dot(look.at(*lamp), "world", 5.0),
        names(view, look),
    )
    return Panel("plan", "In space", WIDTH, HEIGHT, overlay="".join(parts))


def on_floor(corners: Floats) -> Floats:
    """Places (n, 2) of the room's plan in the left camera's frame."""
    return np.asarray((np.insert(corners, 2, 0.0, axis=1) - EYE) @ FROM_ROOM.T)


def clipped_to_panel(look: View, points: list[Floats], *, closed: bool = False) -> Floats:
    """A line or an area clipped to the panel."""
    return clip_to_rectangle(look.all(np.stack(points)), *BORDERS, closed)


def segment(look: View, points: list[Floats], style: str) -> str:
    places = clipped_to_panel(look, points)
    return drawing.polyline(places, style) if len(places) > 1 else ""


def depths(look: View) -> str:
    """The depth along the floor, ahead of the left camera."""
    along = np.array([(0.0, FLOOR_M, Z) for Z in (0.0, *TICKS_M, 9.0)])
    dots = (drawing.dot(place, "muted", 2.0) for place in look.all(along[1:-1]).tolist())
    return "".join((segment(look, [along[0], along[-1]], "muted thin"), *dots))


def cameras(view: LampView, look: View) -> list[str]:
    """Each camera's picture before its centre, with the line of the epipolar plane in it."""
    pair, parts = view.pair, []
    ends = np.stack([pair.right(view.at(1.0)), pair.vanishing(view.left)])
    lines = (
        np.stack([view.left, view.left]),
        clip_to_rectangle(ends, PICTURE[0], PICTURE[2], False),
    )
    for right, line in zip((False, True), lines, strict=True):
        points = on_screen(pair, np.concatenate([PICTURE, line]))
        centre = np.array([pair.baseline if right else 0.0, 0.0, 0.0])
        places = look.all(right_to_left_frame(pair, points) if right else points)
        apex = look.at(*centre)
        parts += [drawing.line(apex, corner, "camera thin faint") for corner in places[:4]]
        parts.append(drawing.polygon(places[:4], "camera thin"))
        parts.append(drawing.polyline(places[4:], "ray bold") if len(line) > 1 else "")
    return parts


def match_interval(view: LampView, look: View) -> str:
    """The part of the left ray that is consistent with the match and its error, with the
    directions of the right camera that lead to it."""
    if view.nearest == view.farthest:
        return ""
    ends = [view.at(view.nearest), view.at(min(view.farthest, FAR_M))]
    wedge = clipped_to_panel(look, [np.array([view.pair.baseline, 0.0, 0.0]), *ends], closed=True)
    filled = drawing.polygon(wedge, "error thin fill") if len(wedge) > 2 else ""
    return filled + segment(look, ends, "error bold")


def names(view: LampView, look: View) -> str:
    """The names of the cameras, the lamp, the handle on the right camera's axis and the range of
    depths, clear of the rays."""
    right = np.array([view.pair.baseline, 0.0, 0.0])
    middle = view.at(0.5 * (view.nearest + min(view.farthest, 9.0)))
    spots = [
        look.at(*each) for each in (view.point, axis_end(view.pair), right, np.zeros(3), middle)
    ]
    lamp, axis, other, origin, range_ = spots
    labels = [
        Label(lamp, "lamp", "world small ground", prefer="above", distance=14.0),
        Label(axis, "turn", "camera small ground", prefer="below", distance=14.0),
        Label(origin, "left", "camera small ground", prefer="left", distance=12.0),
        Label(other, "right", "camera small ground", prefer="right", distance=12.0),
    ]
    if view.nearest < view.farthest:
        labels.append(
            Label(range_, "depths that fit", "error small ground", prefer="below", distance=14.0)
        )
    labels += [
        Label(look.at(0.0, FLOOR_M, Z), f"{Z:.0f} m", "muted small", prefer="below", distance=6.0)
        for Z in TICKS_M
    ]
    rays = [(origin, lamp), (other, lamp), (other, axis)]
    curves: list[list[drawing.Point]] = [list(ends) for ends in rays]
    return place_labels(labels, INSIDE, curves)
