"""The picture of the projection figure: the point, and a house to which it belongs."""

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.scenes.perspective_projection import house
from simulations.scenes.perspective_projection.view import (
    HALF_HEIGHT_PX,
    HALF_WIDTH_PX,
    Camera,
    View,
    in_picture,
)

WIDTH, HEIGHT = 400.0, 300.0
IMAGE_SCALE = 2.0
"""View box units per pixel."""
CENTRE = np.array([200.0, 150.0])
"""Principal point in the image panel's view box."""
LETTER_LEAST = 14.0
"""Side of a rectangle, in view box units, from which it is named."""
PIXELS = (-50, 50)
"""Columns and rows with a mark."""
MESSAGE_Y, CLAIM_Y = 26.0, 44.0
"""Baselines of the text in place of a missing image."""
SAME_PX = 0.05
"""Distances below this are printed as 0.0 px."""


def place(x: float, y: float) -> Floats:
    """Pixel to view box."""
    return CENTRE + IMAGE_SCALE * np.array([x, y])


def pixel_at(spot: drawing.Point) -> Floats:
    """View box to pixel."""
    return (np.asarray(spot, float) - CENTRE) / IMAGE_SCALE


def image_panel(view: View) -> Panel:
    overlay = "".join(
        (
            house.in_picture(view, CENTRE, IMAGE_SCALE),
            "" if view.full else in_perspective(view),
            axes(),
            point(view) if view.visible else no_image(view),
        )
    )
    return Panel("image", "The picture", WIDTH, HEIGHT, overlay=overlay, lead=True)


def axes() -> str:
    """The axes through the principal point, and their pixels and names along the edges of the
    picture."""
    right, bottom = WIDTH - 8.0, HEIGHT - 8.0
    ticks = [[(place(x, 0)[0], HEIGHT), (place(x, 0)[0], HEIGHT - 6.0)] for x in PIXELS]
    ticks += [[(0.0, place(0, y)[1]), (6.0, place(0, y)[1])] for y in PIXELS]
    words = [
        drawing.text((place(x, 0)[0], HEIGHT - 11.0), format_number(x, 0), "muted small", "middle")
        for x in PIXELS
    ] + [
        drawing.text((10.0, place(0, y)[1] + 4.0), format_number(y, 0), "muted small")
        for y in PIXELS
    ]
    return (
        drawing.arrow((8.0, CENTRE[1]), (right, CENTRE[1]), "muted thin")
        + drawing.arrow((CENTRE[0], 8.0), (CENTRE[0], bottom), "muted thin")
        + drawing.path(ticks, "muted thin")
        + "".join(words)
        + drawing.text((right, HEIGHT - 11.0), "x, px", "muted small", "end")
        + drawing.text((10.0, HEIGHT - 11.0), "y, px", "muted small")
    )


def point(view: View) -> str:
    """The image of the point, or an arrow towards it if it is outside the picture."""
    if view.in_picture:
        spot = place(view.x, view.y)
        corners = [CENTRE, place(view.x, 0), spot, place(0, view.y)]
        return (
            drawing.polygon(corners, "image fill")
            + (_letters(view) if view.full else "")
            + drawing.line(CENTRE, spot, "ray")
            + drawing.dot(spot, "image", 5.0)
        )
    reach = min(
        limit / abs(value)
        for limit, value in ((HALF_WIDTH_PX, view.x), (HALF_HEIGHT_PX, view.y))
        if value != 0.0
    )
    tip, tail = (place(view.x * reach * s, view.y * reach * s) for s in (0.97, 0.82))
    numbers = f"({format_number(view.x, 1)}, {format_number(view.y, 1)}) px"
    return drawing.arrow(tail, tip, "image bold", head=12.0) + message(
        f"outside the picture: {numbers}", "image"
    )


def _letters(view: View) -> str:
    """The names of the rectangle's sides: x below it, y beside it."""
    parts = []
    if IMAGE_SCALE * abs(view.x) >= LETTER_LEAST:
        middle = place(view.x / 3.0, max(view.y, 0.0)) + np.array([0.0, 19.0])
        parts.append(drawing.text(middle, "x", "image italic ground", "middle"))
    if IMAGE_SCALE * abs(view.y) >= LETTER_LEAST:
        aside, anchor = (-6.0, "end") if view.x >= 0.0 else (6.0, "start")
        middle = place(0, view.y / 2.0) + np.array([aside, 4.0])
        parts.append(drawing.text(middle, "y", "image italic ground", anchor))
    return "".join(parts)


def in_perspective(view: View) -> str:
    """The house and the point as full perspective shows them."""
    full = Camera(view.camera.focal_px, 1.0)
    parts = [house.outline(view, full, CENTRE, IMAGE_SCALE)]
    if view.Z > 0.0 and view.off_px >= SAME_PX and in_picture(*view.formula_only):
        parts.append(drawing.dot(place(*view.formula_only), "error", 3.0))
    words = "dashed: in perspective" if view.Z > 0.0 else "in perspective: no image of the point"
    parts.append(drawing.text((WIDTH - 8.0, HEIGHT - 34.0), words, "error small ground", "end"))
    return "".join(parts)


def no_image(view: View) -> str:
    """Why the point has no image, and the result of the bare formula."""
    if view.camera.centre_m == view.Z:
        return message("Z = 0: the ray never meets the image plane", "error")
    ghost, claim = "", ""
    if view.full:
        x, y = view.formula_only
        numbers = f"({format_number(x, 1)}, {format_number(y, 1)})"
        claim = drawing.text(
            (WIDTH / 2.0, CLAIM_Y),
            f"the formula alone would say {numbers}",
            "error small ground",
            "middle",
        )
        if in_picture(x, y):
            spot = place(x, y)
            ghost = drawing.line(CENTRE, spot, "error dashed") + drawing.circle(spot, 5.0, "error")
    return ghost + message("behind the camera: no image", "error") + claim


def message(words: str, role: str) -> str:
    return drawing.text((WIDTH / 2.0, MESSAGE_Y), words, f"{role} strong ground", "middle")
