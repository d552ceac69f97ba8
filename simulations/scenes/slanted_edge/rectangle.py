"""The rectangle over the picture: from settings to pixels, and its handles.

The picture is fitted into the panel, so that settings and handles need not know its size: they are
shares of the panel's width.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from simulations.engine.controls import PointLists, Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.slanted_edge.settings import MOST_KEPT, Settings

WIDTH, HEIGHT = 400.0, 300.0
"""Size of the panel."""


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle of whole pixels in a picture that is fitted into the panel."""

    left: int
    top: int
    right: int
    bottom: int
    per_unit: float
    """Pixels of the picture per unit of the panel."""
    corner: tuple[float, float]
    """Where the picture's upper left corner is in the panel."""

    def at(self, column: float, row: float) -> Point:
        """A place in the panel, given from the box's upper left corner, in pixels."""
        across, down = self.corner
        return (
            across + (self.left + column) / self.per_unit,
            down + (self.top + row) / self.per_unit,
        )


def box_in(picture: tuple[int, int], centre: tuple[float, float], size: tuple[float, float]) -> Box:
    """The pixels of a picture (width, height) under a rectangle in % of the panel's width.

    They end where the picture does; there may be none.
    """
    width, height = picture
    per_unit = max(width / WIDTH, height / HEIGHT)
    corner = (0.5 * (WIDTH - width / per_unit), 0.5 * (HEIGHT - height / per_unit))
    ends = [
        min(max(round((0.01 * WIDTH * (middle + side * whole) - start) * per_unit), 0), pixels)
        for middle, whole, start, pixels in zip(centre, size, corner, picture, strict=True)
        for side in (-0.5, 0.5)
    ]
    return Box(ends[0], ends[2], ends[1], ends[3], per_unit, corner)


def centre_of(settings: Settings) -> Point:
    """Place of the rectangle's middle in the panel."""
    return (0.01 * WIDTH * settings.x, 0.01 * WIDTH * settings.y)


def corner_of(settings: Settings) -> Point:
    """Place of its lower right corner."""
    across, down = centre_of(settings)
    return (across + 0.005 * WIDTH * settings.width, down + 0.005 * WIDTH * settings.height)


def kept_in(picture: tuple[int, int], kept: str) -> tuple[Box, ...]:
    """The rectangles that were kept, on a picture (width, height).

    Each is a pair of opposite corners, as shares of the panel.
    """
    corners = PointLists.from_text(kept).lists[0] if kept else ()
    boxes = []
    for (left, top), (right, bottom) in zip(corners[::2], corners[1::2], strict=False):
        tall = 100.0 * HEIGHT / WIDTH
        centre = (50.0 * (left + right), 0.5 * tall * (top + bottom))
        boxes.append(box_in(picture, centre, (100.0 * (right - left), tall * (bottom - top))))
    return tuple(boxes)


def _nowhere(_settings: Settings, _outputs: Outputs) -> None:
    return None


def _keep_pulled(settings: Settings, _place: Point) -> Mapping[str, Value]:
    """The rectangle is kept, in place of the oldest one if there are too many."""
    before = PointLists.from_text(settings.kept).lists[0] if settings.kept else ()
    (across, down), (right, bottom) = centre_of(settings), corner_of(settings)
    corners = ((2 * across - right, 2 * down - bottom), (right, bottom))
    new = tuple((min(max(x / WIDTH, 0.0), 1.0), min(max(y / HEIGHT, 0.0), 1.0)) for x, y in corners)
    return {"kept": PointLists("", 0, ((*before, *new)[-2 * MOST_KEPT :],)).text}


def _forget_pulled(_settings: Settings, _place: Point) -> Mapping[str, Value]:
    return {"kept": ""}


def _middle(settings: Settings, _outputs: Outputs) -> Point:
    return centre_of(settings)


def _middle_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"x": 100.0 * place[0] / WIDTH, "y": 100.0 * place[1] / WIDTH}


def _corner(settings: Settings, _outputs: Outputs) -> Point:
    return corner_of(settings)


def _corner_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    across, down = centre_of(settings)
    return {
        "width": 200.0 * (place[0] - across) / WIDTH,
        "height": 200.0 * (place[1] - down) / WIDTH,
    }


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "corner", "picture", "Corner", ("width", "height"), _corner, _corner_pulled, role="image"
    ),
    Handle(
        "rectangle",
        "picture",
        "Rectangle",
        ("x", "y"),
        _middle,
        _middle_pulled,
        reach="press",
        role="image",
    ),
    Handle("keep", "across", "This place", ("kept",), _nowhere, _keep_pulled, reach="aim"),
    Handle("forget", "waves", "All places", ("kept",), _nowhere, _forget_pulled, reach="aim"),
)
