"""Zhang's two constraints: where a board's edges vanish, at a right angle and equally long."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, dot, line, polygon, polyline
from simulations.engine.illustration import Illustration, Panel, in_steps
from simulations.illustrations._board_before_camera import (
    CENTRE,
    R1,
    R2,
    SQUARES,
    at,
    board,
    corner,
    image_plane,
    offset_from,
    pierced,
)

ENDS = pierced(R1), pierced(R2)
"""The vanishing points of the two families of edges."""


def angle_deg() -> float:
    """Between the rays to the two vanishing points."""
    first, second = (end / np.linalg.norm(end) for end in ENDS)
    return float(np.degrees(np.arccos(first @ second)))


def draw() -> Illustration:
    ox, oy = at(CENTRE)
    (end1, end2), last = ENDS, SQUARES
    places = ((0, 0), (last, 0), (last, last), (0, last))
    near, right, far, down = (pierced(corner(*place)) for place in places)
    first = [
        *board(),
        image_plane((-1.4, -1.2), (2.15, 2.2)),
        *(line(at(start), at(end1), "image thin dashed") for start in (near, down)),
        *(line(at(start), at(end2), "image thin dashed") for start in (near, right)),
        polygon([at(near), at(right), at(far), at(down)], "image"),
        dot(at(end1), "image", 4.5),
        dot(at(end2), "image", 4.5),
        dot(at(CENTRE), "camera", 5),
        label((ox - 12, oy + 5), "camera", "camera", "end"),
        label(offset_from(end1, 8, 5), "h_1", "image italic ground"),
        label(offset_from(end2, 8, 5), "h_2", "image italic ground"),
    ]
    second = [
        line(at(CENTRE), at(end1), "ray"),
        line(at(CENTRE), at(end2), "ray"),
        arrow(at(corner(0, 0)), at(corner(1, 0)), "error bold"),
        arrow(at(corner(0, 0)), at(corner(0, 1)), "error bold"),
        label(offset_from(corner(0.6, 0), 0, -9), "r_1", "error italic", "middle"),
        label(offset_from(corner(0, 0.6), -6, 4), "r_2", "error italic", "end"),
    ]
    short = 0.35
    third = [polyline([at(short * R1), at(short * (R1 + R2)), at(short * R2)], "error")]
    fourth = [arrow(at(CENTRE), at(R1), "error bold"), arrow(at(CENTRE), at(R2), "error bold")]
    words = (
        "A camera and a slanting board. The pictures of the board's edges run to two vanishing "
        f"points, seen from the camera {angle_deg():.0f}° apart, as the edges are."
    )
    overlay = in_steps(first, second, third, fourth)
    return Illustration((Panel("space", "", 400.0, 240.0, overlay=overlay),), words)
