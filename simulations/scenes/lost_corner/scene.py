"""A Corner at Infinity: a homography of a square, up to where it divides by zero and beyond."""

import math

import numpy as np

from simulations.engine.frame import Frame, Panel, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square import family, marks, plane
from simulations.scenes._mapped_square.measures import area_ratio, describe_point
from simulations.scenes.lost_corner import divisor
from simulations.scenes.lost_corner.handles import HANDLES, matrix, point_of
from simulations.scenes.lost_corner.settings import Settings


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The square and its image, and w at P against the amount."""
    H, point = matrix(settings), point_of(settings)
    w, area = divisor.w_at(H, point), area_ratio(H)
    overlay = "".join(
        (
            plane.axes(),
            plane.figure(np.eye(3), "world"),
            plane.lines_at_infinity(H),
            plane.figure(H, "image"),
            marks.point_and_image(H, family.way("projective")[::4], point),
        )
    )
    return Frame(
        panels=(
            Panel(
                "plane",
                "A square and its image",
                plane.WIDTH,
                plane.HEIGHT,
                overlay=overlay,
                lead=True,
            ),
            Panel(
                "divisor",
                "What the coordinates of P′ are divided by",
                divisor.WIDTH,
                divisor.HEIGHT,
                overlay=divisor.draw(settings.amount, H, point),
            ),
        ),
        readouts=(
            readout("w", "w at P", w, digits=3),
            readout("area", "Area, image : original", area, digits=3),
        ),
        description=describe(H, point, w, area),
    )


def describe(H: Floats, point: Floats, w: float, area: float) -> str:
    """The picture in two sentences."""
    size = (
        "is cut where it reaches the line that is sent to infinity"
        if math.isinf(area)
        else f"has {format_number(area, 2)} times its area"
    )
    return (
        f"The image of a square under a homography {size}. "
        f"{describe_point(H, point)} There w is {format_number(w, 2)}."
    )


SCENE = Scene(
    "lost-corner", "A Corner at Infinity", Settings, draw, handles=HANDLES, formula=apply_homography
)
