"""The picture of the projection figure: the point, and the same point at other depths."""

from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Panel, format_number
from simulations.models.arrays import Floats
from simulations.scenes.perspective_projection import house
from simulations.scenes.perspective_projection.view import (
    HALF_HEIGHT_PX,
    HALF_WIDTH_PX,
    PERSPECTIVE,
    View,
    in_picture,
)

WIDTH, HEIGHT = 400.0, 300.0
TITLE = "The picture"
IMAGE_SCALE = 2.0
"""View box units per pixel."""
CENTRE = np.array([200.0, 150.0])
"""Principal point in the image panel's view box."""

COMPARED_DEPTHS = (1.0, 2.0, 3.0, 5.0, 10.0, 20.0)
"""Depths in metres at which the point is drawn faintly, for comparison."""
LABEL_HEIGHT = 14.0
"""Line height of a label, in view box units."""
MESSAGE_Y, CLAIM_Y = 26.0, 44.0
"""Baselines of the text in place of a missing image."""


@dataclass(frozen=True, slots=True)
class Label:
    """Size of a line of text."""

    middle: Floats
    """Middle of the baseline in the view box."""
    half_width: float

    def covers(self, other: "Label") -> bool:
        across, down = np.abs(self.middle - other.middle)
        return bool(across < self.half_width + other.half_width and down < LABEL_HEIGHT)

    def draw(self, words: str, style: str) -> str:
        return drawing.text(self.middle, words, style, "middle")


def place(x: float, y: float) -> Floats:
    """Pixel to view box."""
    return CENTRE + IMAGE_SCALE * np.array([x, y])


def pixel_at(spot: drawing.Point) -> Floats:
    """View box to pixel."""
    return (np.asarray(spot, float) - CENTRE) / IMAGE_SCALE


def house_of(view: View) -> str:
    """The house, with the point as its corner."""
    return house.in_picture(view, CENTRE, IMAGE_SCALE)


def image_panel(view: View) -> Panel:
    shown = point(view) if view.visible else no_image(view)
    overlay = axes(view) + house_of(view) + comparison(view) + shown
    return Panel("image", TITLE, WIDTH, HEIGHT, overlay=overlay)


def axes(view: View) -> str:
    """Pixel axes through the principal point, and the edge of the picture."""
    marks = [[place(x, -1.5), place(x, 1.5)] for x in (-50, 50)]
    return (
        drawing.rectangle((1.0, 1.0), WIDTH - 2.0, HEIGHT - 2.0, "image")
        + drawing.arrow(place(-97, 0), place(97, 0), "muted thin")
        + y_axis(view)
        + drawing.path(marks, "muted thin")
        + "".join(label.draw(words, "muted small") for words, label in axis_labels(view))
    )


def y_axis(view: View) -> str:
    """The axis downwards and its ticks, with a gap for text across it."""
    top, bottom = place(0, -72), place(0, 72)
    rows = message_rows(view)
    low, high = (min(rows) - LABEL_HEIGHT, max(rows) + 6.0) if rows else (0.0, 0.0)
    parts = [[place(-1.5, y), place(1.5, y)] for y in (-50, 50) if not low < place(0, y)[1] <= high]
    if low - top[1] > LABEL_HEIGHT:
        parts.append([top, np.array([top[0], low])])
    start = (top[0], max(top[1], high))
    return drawing.path(parts, "muted thin") + drawing.arrow(start, bottom, "muted thin")


def axis_labels(view: View) -> list[tuple[str, Label]]:
    """Names and numbers of the axes, without those hidden by more important text."""
    labels = [
        ("x, px", Label(place(97, 0) + np.array([-12, 18]), 12.0)),
        ("y, px", Label(place(0, 72) + np.array([20, 0]), 12.0)),
    ]
    for value in (-50, 50):
        number = format_number(value, 0)
        labels.append((number, Label(place(value, 0) + np.array([0, 14]), 9.0)))
        labels.append((number, Label(place(0, value) + np.array([-14, 4]), 9.0)))
    taken = [Label(np.array([WIDTH / 2.0, y]), 130.0) for y in message_rows(view)]
    if view.in_picture:
        taken.append(point_label(view))
    return [(words, own) for words, own in labels if not any(own.covers(it) for it in taken)]


def message_rows(view: View) -> tuple[float, ...]:
    """Baselines of the text across the picture, clear of the point's own label."""
    if not view.in_picture:
        return MESSAGE_Y, CLAIM_Y
    if view.camera == PERSPECTIVE:
        return ()
    return (CLAIM_Y if view.y >= 0.0 else HEIGHT - 30.0,)


def comparison(view: View) -> str:
    """The same point at other depths, whose images are on one line to the principal point."""
    parts: list[str] = []
    labels = [Label(CENTRE, 10.0), *(label for _, label in axis_labels(view))]
    if view.in_picture:
        labels += [Label(place(view.x, view.y), 18.0), point_label(view)]
    for depth in COMPARED_DEPTHS:
        x, y = view.focal_px * view.X / depth, view.focal_px * view.Y / depth
        if not in_picture(x, y) or (view.X == 0.0 and view.Y == 0.0):
            continue
        spot = place(x, y)
        parts.append(corner_rectangle(x, y, "world thin faint"))
        parts.append(drawing.dot(spot, "world faint", 3.0))
        label = depth_label(spot)
        if not any(label.covers(other) for other in labels):
            labels.append(label)
            parts.append(label.draw(f"{depth:.0f} m", "world small halo"))
    return "".join(parts)


def outward(spot: Floats, half_width: float, gap: float) -> Label:
    """A label beyond ``spot`` as seen from the principal point, moved into the picture.

    If there is no space beyond, it is on the near side of ``spot``, clear of the ray.
    """
    right, below = spot[0] >= CENTRE[0], spot[1] >= CENTRE[1]
    under, over = spot[1] + LABEL_HEIGHT + 2.0, spot[1] - 8.0
    room = under <= HEIGHT - 8.0 if below else over >= 18.0
    x = spot[0] + (gap + half_width if right else -gap - half_width)
    margin = half_width + (5.0 if room else 36.0)
    return Label(
        np.array([np.clip(x, margin, WIDTH - margin), under if below == room else over]),
        half_width,
    )


def depth_label(spot: Floats) -> Label:
    return outward(spot, 14.0, -14.0)


def point_label(view: View) -> Label:
    return outward(place(view.x, view.y), 54.0, 4.0)


def corner_rectangle(x: float, y: float, style: str) -> str:
    """The rectangle between the principal point and (x, y): it shrinks with depth."""
    return drawing.polygon([CENTRE, place(x, 0), place(x, y), place(0, y)], style)


def point(view: View) -> str:
    """The image of the point, or an arrow towards it if it is outside the picture."""
    numbers = f"({format_number(view.x, 1)}, {format_number(view.y, 1)}) px"
    if view.in_picture:
        spot = place(view.x, view.y)
        return (
            corner_rectangle(view.x, view.y, "image fill")
            + drawing.line(CENTRE, spot, "ray")
            + drawing.dot(spot, "image", 5.0)
            + point_label(view).draw(numbers, "image strong halo")
        )
    reach = min(
        limit / abs(value)
        for limit, value in ((HALF_WIDTH_PX, view.x), (HALF_HEIGHT_PX, view.y))
        if value != 0.0
    )
    tip, tail = (place(view.x * reach * s, view.y * reach * s) for s in (0.97, 0.82))
    return drawing.arrow(tail, tip, "image bold", head=12.0) + message(
        f"outside the picture: {numbers}", "image"
    )


def no_image(view: View) -> str:
    """Why the point has no image, and the result of the bare formula."""
    if view.Z == 0.0:
        return message("Z = 0: the ray never meets the image plane", "error")
    x, y = view.formula_only
    ghost = ""
    if in_picture(x, y):
        ghost = drawing.line(CENTRE, place(x, y), "error dashed") + drawing.circle(
            place(x, y), 5.0, "error"
        )
    claim = f"({format_number(x, 1)}, {format_number(y, 1)})"
    return (
        ghost
        + message("behind the camera: no image", "error")
        + drawing.text(
            (WIDTH / 2.0, CLAIM_Y),
            f"the formula alone would say {claim}",
            "error small halo",
            "middle",
        )
    )


def message(words: str, role: str) -> str:
    return drawing.text((WIDTH / 2.0, MESSAGE_Y), words, f"{role} strong halo", "middle")
