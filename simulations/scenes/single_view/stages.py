"""The stages: the picture; the lines; the camera; the lengths; and what the panels show of them."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.raster import opaque, to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_table
from simulations.models.projection.single_view import SingleView, fit_view
from simulations.models.projection.single_view_lengths import Measured, Stretch, measured
from simulations.pictures.checker_room import checker_room
from simulations.scenes.single_view.fields import LOUPE_COLUMNS, LOUPE_ROWS, Field, around
from simulations.scenes.single_view.lines import FLOOR, HEIGHT, Drawn, drawn
from simulations.scenes.single_view.room import FOCAL_PX, ROOMS, SIZE
from simulations.scenes.single_view.settings import LISTS, NORMALS

WIDEST, TALLEST = 1000, 750
"""Size in pixels of the largest picture in the lead panel; larger ones are reduced."""
FIELD_COLUMNS, FIELD_ROWS = 400, 300
UNKNOWN = 0.3
"""Relative standard error from which a number counts as unknown."""


type Whole = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Found:
    """The camera, or why there is none."""

    view: SingleView | None
    problem: str = ""

    @property
    def focal_error(self) -> float:
        """Standard error of ln f, that is, of f relative to it; infinite without a camera."""
        if self.view is None:
            return math.inf
        return math.sqrt(self.view.covariance[0, 0])

    @property
    def knows_focal(self) -> bool:
        return self.focal_error < UNKNOWN

    @property
    def misfits(self) -> bool:
        """Whether the lines miss each other by much more than their ends' errors explain."""
        view = self.view
        return view is not None and view.misfit > view.spare + 4.0 * math.sqrt(2 * view.spare) + 4.0


@dataclass(frozen=True, slots=True)
class Lengths:
    """What was measured of the lengths and the heights that count, the known one first."""

    floor: tuple[tuple[float, float], ...] = ()
    """Metres and their standard error, NaN where there is none."""
    height: tuple[tuple[float, float], ...] = ()
    distance: tuple[float, float] = (math.nan, math.nan)
    """Of the camera from the plane."""
    known: str = ""
    """Which list has the known length."""


def _photo(picture: str, photograph: Photograph | None) -> Codes:
    """(H, W, 3) sRGB."""
    if photograph is not None:
        return photograph.codes
    room = checker_room(*SIZE, FOCAL_PX, ROOMS[picture].turn)
    return to_rgba8(encode_srgb_table(room))[..., :3]


def _view(lines: Drawn, sigma: float, centre: bool) -> Found:
    ends = [lines.counted(axis) for axis in range(3)]
    counts = [len(each) for each in ends]
    if sum(count >= 2 for count in counts) < 2:
        return Found(None, "Draw two lines or more along each of two directions.")
    if centre and min(counts) < 2:
        return Found(None, "The principal point needs lines along three directions.")
    axes = np.repeat(np.arange(3), counts)
    try:
        view = fit_view(np.concatenate(ends), axes, lines.size, sigma, find_centre=centre)
    except ValueError:
        return Found(None, "Two directions meet in one point: check which lines are which.")
    return Found(view)


def _lengths(lines: Drawn, found: Found, sigma: float, known: float, plane: str) -> Lengths:
    floor, height = (
        [Stretch(ends, kind) for ends in lines.counted(number)]
        for number, kind in ((FLOOR, "within"), (HEIGHT, "above"))
    )
    stretches = (*floor, *height)
    if found.view is None or not stretches:
        return Lengths()
    first, *others = stretches
    try:
        made: Measured = measured(
            found.view, first, known, tuple(others), sigma, normal=NORMALS[plane]
        )
    except ValueError:
        return Lengths()
    pairs = [(known, 0.0), *zip(made.metres.tolist(), made.errors.tolist(), strict=True)]
    return Lengths(
        tuple(pairs[: len(floor)]),
        tuple(pairs[len(floor) :]),
        (made.distance, made.distance_error),
        list(LISTS)[FLOOR if floor else HEIGHT],
    )


def _truth(
    lines: Drawn, picture: str, plane: str, photograph: Photograph | None
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The true lengths and heights in metres, where those of the book are drawn; else none."""
    if photograph is not None or plane != "floor":
        return (), ()
    true = [ROOMS[picture].metres(number) for number in (FLOOR, HEIGHT)]
    floor, height = (
        metres if len(lines.counted(number)) == len(metres) else ()
        for number, metres in zip((FLOOR, HEIGHT), true, strict=True)
    )
    return floor, height


def _small(photo: Codes) -> Raster:
    """The picture with at most `WIDEST` × `TALLEST` pixels, each the mean of a block."""
    height, width, _ = photo.shape
    step = max(1, math.ceil(max(width / WIDEST, height / TALLEST)))
    rows, columns = height // step, width // step
    if step == 1:
        return opaque(photo)
    total = np.zeros((rows, columns, 3), np.uint32)
    for row in range(step):
        for column in range(step):
            total += photo[row : rows * step : step, column : columns * step : step]
    return opaque((total // (step * step)).astype(np.uint8))


def _boxed(small: Raster) -> Raster:
    """The picture in the middle of a panel of 4 : 3."""
    height, width, _ = small.shape
    rows, columns = max(height, math.ceil(0.75 * width)), max(width, math.ceil(height / 0.75))
    if (rows, columns) == (height, width):
        return small
    box = np.zeros((rows, columns, 4), np.uint8)
    top, left = (rows - height) // 2, (columns - width) // 2
    box[top : top + height, left : left + width] = small
    return box


def _field(lines: Drawn, found: Found) -> Field:
    return around(lines, found.view)


def _wide(small: Raster, field: Field) -> Raster:
    """The picture in the field of the second panel, by the nearest pixels."""
    wide = np.zeros((FIELD_ROWS, FIELD_COLUMNS, 4), np.uint8)
    x = field.pixel_x(np.arange(FIELD_COLUMNS) + 0.5) / field.size[0]
    y = field.pixel_y(np.arange(FIELD_ROWS) + 0.5) / field.size[1]
    (columns, u), (rows, v) = (
        _inside(share, n) for share, n in ((x, small.shape[1]), (y, small.shape[0]))
    )
    wide[np.ix_(rows, columns)] = small[np.ix_(v, u)]
    return wide


def _inside(share: Floats, count: int) -> tuple[Whole, Whole]:
    """Of shares of a side: the places of those inside, and their pixels."""
    at = np.flatnonzero((share >= 0.0) & (share < 1.0))
    return at, (share[at] * count).astype(np.intp)


def _loupe(photo: Codes, lines: Drawn, direction: str) -> Raster:
    """The pixels around the end that was moved last; transparent beyond the picture."""
    wide = np.zeros((LOUPE_ROWS, LOUPE_COLUMNS, 4), np.uint8)
    height, width, _ = photo.shape
    ends = lines.ends[list(LISTS).index(direction)].reshape(-1, 2)
    ends = ends if len(ends) else np.array([[width / 2.0, height / 2.0]])
    x, y = np.rint(ends[min(lines.points.touched, len(ends) - 1)]).astype(int)
    u = np.arange(x - LOUPE_COLUMNS // 2, x + LOUPE_COLUMNS // 2)
    v = np.arange(y - LOUPE_ROWS // 2, y + LOUPE_ROWS // 2)
    columns, rows = (np.flatnonzero((at >= 0) & (at < n)) for at, n in ((u, width), (v, height)))
    wide[np.ix_(rows, columns)] = opaque(photo[np.ix_(v[rows], u[columns])])
    return wide


STAGES = (
    Stage("photo", _photo),
    Stage("lines", drawn),
    Stage("view", _view, ("lines",)),
    Stage("lengths", _lengths, ("lines", "view")),
    Stage("truth", _truth, ("lines",)),
    Stage("small", _small, ("photo",)),
    Stage("boxed", _boxed, ("small",)),
    Stage("field", _field, ("lines", "view")),
    Stage("wide", _wide, ("small", "field")),
    Stage("loupe", _loupe, ("photo", "lines")),
)
