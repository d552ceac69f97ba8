"""From the corner of a board to its pixel, step by step."""

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, dot, line
from simulations.engine.illustration import Illustration, Panel, in_steps
from simulations.illustrations._board_before_camera import (
    CENTRE,
    ORIGIN,
    R1,
    R2,
    at,
    board,
    corner,
    image_plane,
    offset_from,
    pierced,
)

ACROSS, DOWN = 2, 3
"""The corner that is followed."""


def draw() -> Illustration:
    point = corner(ACROSS, DOWN)
    image = pierced(point)
    ox, oy = at(CENTRE)
    first = [
        *board(),
        image_plane((-1.3, -1.1), (1.3, 1.1)),
        arrow(at(CENTRE), at(ORIGIN), "camera"),
        dot(at(CENTRE), "camera", 5),
        label((ox, oy + 20), "camera", "camera", "middle"),
        label(offset_from(0.55 * ORIGIN, 0, -8), "t", "camera italic strong ground", "middle"),
    ]
    second = [
        arrow(at(ORIGIN), at(ORIGIN + R1), "error bold"),
        arrow(at(ORIGIN), at(ORIGIN + R2), "error bold"),
        label(offset_from(ORIGIN + 0.6 * R1, -6, -8), "r_1", "error italic", "end"),
        label(offset_from(ORIGIN + 0.35 * R2, -6, 6), "r_2", "error italic", "end"),
    ]
    third = [
        arrow(at(ORIGIN), at(corner(ACROSS, 0)), "error"),
        arrow(at(corner(ACROSS, 0)), at(point), "error"),
        dot(at(point), "world", 5),
        label(offset_from(point, 10, 5), "(X, Y, 0)", "world italic"),
    ]
    fourth = [
        line(at(CENTRE), at(point), "ray"),
        dot(at(image), "image", 4.5),
        label(offset_from(image, 0, -10), "m", "image italic ground", "middle"),
    ]
    words = (
        "A camera, its image plane and a slanting board of three by three squares. An arrow leads "
        f"to the board's origin, {ACROSS} squares along one edge and {DOWN} along the other lead "
        "to a corner, and the ray of this corner meets the image plane in its picture."
    )
    overlay = in_steps(first, second, third, fourth)
    return Illustration((Panel("space", "", 400.0, 240.0, overlay=overlay),), words)
