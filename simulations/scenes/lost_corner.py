"""A Corner at Infinity: a homography of a square, up to where it divides by zero and beyond."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square import family, plane

PLOT = Plot(Axis(0.0, 100.0, 46.0, 386.0), Axis(-1.0, 2.0, 290.0, 36.0))
SCALES = (Scale("amount", ticks=(0.0, 50.0, 100.0)), Scale("w", ticks=(0.0, 1.0)))


@dataclass(frozen=True, slots=True)
class Settings:
    amount: float = slider("Amount", 24, 0, 100, 1)
    play: int = action("Play", "Pause", drives="amount", effect="play", seconds=8.0)
    point_x: float = slider("P, right (x)", 40, -60, 60, 1)
    point_y: float = slider("P, up (y)", -40, -60, 60, 1)


def point_of(settings: Settings) -> Floats:
    return np.array([settings.point_x, settings.point_y])


def matrix(settings: Settings) -> Floats:
    return family.transformation("projective", settings.amount)


def w_at(settings: Settings) -> float:
    """The third coordinate of the image of P, before the division."""
    return float(matrix(settings)[2] @ [*point_of(settings), 1.0])


def divisor(settings: Settings) -> str:
    """w at P, by which the homography divides, against the amount."""
    along = family.way("projective")[:, 2] @ [*point_of(settings), 1.0]
    place = (PLOT.x.start + 10.0, PLOT.y.start - 10.0)
    return "".join(
        (
            PLOT.region(y=(PLOT.y.low, 0.0), style="error fill faint"),
            PLOT.frame(*SCALES),
            PLOT.level(0.0, "error dashed"),
            PLOT.drop(settings.amount, w_at(settings), "muted thin dashed"),
            label(place, "past infinity", "error small ground"),
            PLOT.curve(np.arange(101.0), along, "image bold"),
            PLOT.mark(settings.amount, w_at(settings), "image"),
        )
    )


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    H, point = matrix(settings), point_of(settings)
    w, area = w_at(settings), plane.area_ratio(H)
    square = (
        plane.axes(),
        plane.figure(np.eye(3), "world"),
        plane.lines_at_infinity(H),
        plane.figure(H, "image"),
        plane.point_and_image(H, family.way("projective")[::4], point),
    )
    size = (
        "is cut where it reaches the line that is sent to infinity"
        if math.isinf(area)
        else f"has {format_number(area, 2)} times its area"
    )
    size_of = plane.WIDTH, plane.HEIGHT
    drawn, title = "".join(square), "What the coordinates of P′ are divided by"
    return Frame(
        (
            Panel("plane", "A square and its image", *size_of, overlay=drawn, lead=True),
            Panel("divisor", title, 400.0, 340.0, overlay=divisor(settings)),
        ),
        (
            readout("w", "w at P", w, digits=3),
            readout("area", "Area, image : original", area, digits=3),
        ),
        f"The image of a square under a homography {size}. "
        f"{plane.describe_point(H, point)} There w is {format_number(w, 2)}.",
    )


def image_at(settings: Settings, _outputs: Outputs) -> Point | None:
    image, valid = apply_homography(matrix(settings), point_of(settings))
    return tuple(plane.to_view(image).tolist()) if valid else None


SCENE = Scene(
    "lost-corner",
    "A Corner at Infinity",
    Settings,
    draw,
    handles=(
        Handle("image", "plane", "Image of P", ("amount",), image_at, role="image"),
        Handle(
            "point",
            "plane",
            "Point P",
            ("point_x", "point_y"),
            lambda settings, _: tuple(plane.to_view(point_of(settings)).tolist()),
            lambda _, place: dict(
                zip(("point_x", "point_y"), plane.from_view(place).tolist(), strict=True)
            ),
            role="world",
        ),
        Handle(
            "amount",
            "divisor",
            "Mark on the curve",
            ("amount",),
            lambda settings, _: PLOT.clamped(settings.amount, w_at(settings)),
            lambda _, place: {"amount": PLOT.x.value(place[0])},
            "press",
            "image",
        ),
    ),
    formula=apply_homography,
)
