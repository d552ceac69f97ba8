"""Distances from One Picture: a camera and lengths from lines drawn over it."""

import math
from collections.abc import Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import PointLists, Value
from simulations.engine.export import Export
from simulations.engine.frame import Frame, Panel, Raster
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Codes, Photograph, Whole
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.projection.single_view import fit_view
from simulations.pictures.checker_room import checker_room
from simulations.scenes.single_view import drawing, files, measuring
from simulations.scenes.single_view.drawing import HEIGHT, WIDTH, Field, picture_field
from simulations.scenes.single_view.lines import (
    FOCAL_PX,
    LISTS,
    MOST,
    ROOMS,
    SAMPLES,
    SIZE,
    Lines,
    Settings,
    current,
    drawn_lines,
    size_of,
    start_of,
)

WIDEST, TALLEST = 1000, 750
"""Size in pixels of the largest picture in the lead panel; larger ones are reduced."""


def photo(picture: str, photograph: Photograph | None) -> Codes:
    """(H, W, 3) sRGB."""
    if photograph is not None:
        return photograph.codes
    room = checker_room(*SIZE, FOCAL_PX, ROOMS[picture].turn)
    return encode_srgb_codes(room)


def small(photo: Codes) -> Raster:
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


def boxed(small: Raster) -> Raster:
    """The picture in the middle of a panel of 4 : 3."""
    height, width, _ = small.shape
    rows, columns = max(height, math.ceil(0.75 * width)), max(width, math.ceil(height / 0.75))
    if (rows, columns) == (height, width):
        return small
    box = np.zeros((rows, columns, 4), np.uint8)
    top, left = (rows - height) // 2, (columns - width) // 2
    box[top : top + height, left : left + width] = small
    return box


def wide(small: Raster, field: Field) -> Raster:
    """The picture in the field of the second panel, by the nearest pixels."""
    plane = np.zeros((int(HEIGHT), int(WIDTH), 4), np.uint8)
    x = field.pixel_x(np.arange(plane.shape[1]) + 0.5) / field.size[0]
    y = field.pixel_y(np.arange(plane.shape[0]) + 0.5) / field.size[1]
    (columns, u), (rows, v) = _inside(x, small.shape[1]), _inside(y, small.shape[0])
    plane[np.ix_(rows, columns)] = small[np.ix_(v, u)]
    return plane


def _inside(share: Floats, count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The places of shares of a side that are inside, and their pixels."""
    at = np.flatnonzero((share >= 0.0) & (share < 1.0))
    return at, (share[at] * count).astype(np.intp)


def loupe(photo: Codes, lines: Lines, direction: str) -> Raster:
    """The pixels around the end that was moved last; transparent beyond the picture."""
    shown = np.zeros((drawing.LOUPE_ROWS, drawing.LOUPE_COLUMNS, 4), np.uint8)
    height, width, _ = photo.shape
    ends = lines.ends[list(LISTS).index(direction)].reshape(-1, 2)
    ends = ends if len(ends) else np.array([[width / 2.0, height / 2.0]])
    x, y = np.rint(ends[min(lines.points.touched, len(ends) - 1)]).astype(int)
    u = np.arange(x - drawing.LOUPE_COLUMNS // 2, x + drawing.LOUPE_COLUMNS // 2)
    v = np.arange(y - drawing.LOUPE_ROWS // 2, y + drawing.LOUPE_ROWS // 2)
    columns, rows = (np.flatnonzero((at >= 0) & (at < n)) for at, n in ((u, width), (v, height)))
    shown[np.ix_(rows, columns)] = opaque(photo[np.ix_(v[rows], u[columns])])
    return shown


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture with the lines, the image plane around it, and the loupe."""
    lines, found, lengths = (outputs[name] for name in ("lines", "view", "lengths"))
    over = drawing.over_picture(settings, lines, found, lengths)
    around = drawing.over_field(settings, lines, found, outputs["field"])
    near, size = drawing.in_loupe(lines, settings), (WIDTH, HEIGHT)
    numbers = measuring.readouts(outputs)
    shown = {each.name: f"{each.text} {each.unit}".strip() for each in numbers}
    counts = [len(lines.counted(axis)) for axis in range(3)]
    drawn = f"{counts[0]} lines across, {counts[1]} along and {counts[2]} upright"
    result = (
        found.problem
        if found.view is None
        else f"Focal length: {shown['focal']}; the camera looks down by {shown['pitch']}. Length "
        f"on the plane: {shown['length']}; height above it: {shown['height']}."
    )
    title, loupe_title = "Lines over the picture", "Around the end moved last"
    return Frame(
        (
            Panel("picture", title, *size, outputs["boxed"], over, lead=True),
            Panel("field", "Where they meet", *size, outputs["wide"], around),
            Panel("loupe", loupe_title, *size, outputs["loupe"], near, pixelated=True),
        ),
        numbers,
        f"A picture with {drawn}. {result}",
    )


def number_of(settings: Settings) -> int:
    """The number of the list that is drawn in."""
    return list(LISTS).index(settings.direction)


def points_of(settings: Settings, photograph: Photograph | None) -> PointLists:
    return current(settings.lines, settings.picture, settings.sigma, settings.take, photograph)


def end_at(end: int, settings: Settings, outputs: Outputs) -> Point | None:
    lines: Lines = outputs["lines"]
    ends = lines.ends[number_of(settings)].reshape(-1, 2)
    return picture_field(lines.size).place(ends[end]) if end < len(ends) else None


def end_pulled(
    end: int, settings: Settings, place: Point, photograph: Photograph | None
) -> Mapping[str, Value]:
    """The nearest pixel."""
    points, size = points_of(settings, photograph), size_of(photograph)
    ends = list(points.lists[number_of(settings)])
    if end >= len(ends):
        return {}
    shares = (
        np.rint(np.clip(picture_field(size).pixel(place), -1.0, np.add(size, 1))) + 0.5
    ) / size
    ends[end] = (float(shares[0]), float(shares[1]))
    return changed(points, number_of(settings), ends, end)


def added(settings: Settings, _place: Point, photograph: Photograph | None) -> Mapping[str, Value]:
    points, number = points_of(settings, photograph), number_of(settings)
    ends = points.lists[number]
    if len(ends) >= 2 * MOST:
        return {}
    return changed(points, number, [*ends, *start_of(number, len(ends) // 2)], len(ends))


def cleared(
    settings: Settings, _place: Point, photograph: Photograph | None
) -> Mapping[str, Value]:
    """All lines are taken away."""
    return {
        "lines": PointLists(points_of(settings, photograph).picture, 0, ((),) * len(LISTS)).text
    }


def changed(
    points: PointLists, number: int, ends: list[tuple[float, float]], touched: int
) -> Mapping[str, Value]:
    lists = (*points.lists[:number], tuple(ends), *points.lists[number + 1 :])
    return {"lines": PointLists(points.picture, touched, lists).text}


SCENE = Scene(
    "single-view",
    "Distances from One Picture",
    Settings,
    draw,
    (
        Stage("photo", photo),
        Stage("lines", drawn_lines),
        Stage("lens", measuring.lens_of, ("photo", "lines")),
        Stage("view", measuring.camera_of, ("lines", "lens")),
        Stage("lengths", measuring.lengths_of, ("lines", "view")),
        Stage("truth", measuring.true_lengths, ("lines",)),
        Stage("small", small, ("photo",)),
        Stage("boxed", boxed, ("small",)),
        Stage("field", drawing.field_around, ("lines", "view")),
        Stage("wide", wide, ("small", "field")),
        Stage("loupe", loupe, ("photo", "lines")),
    ),
    handles=(
        *(
            Handle(
                f"end-{end}",
                "picture",
                f"{'Other' if end % 2 else 'First'} end of line {end // 2 + 1}",
                drives=("lines",),
                at=partial(end_at, end),
                pull=partial(end_pulled, end),
                step=lambda _, outputs: picture_field(outputs["lines"].size).scale,  # a pixel
            )
            for end in range(2 * MOST)
        ),
        Handle(
            "add", "picture", "New line", ("lines",), at=lambda *_: None, pull=added, reach="aim"
        ),
        Handle(
            "clear", "loupe", "All lines", ("lines",), at=lambda *_: None, pull=cleared, reach="aim"
        ),
    ),
    instrument=Instrument(
        photograph=Whole(24),
        samples={name: partial(photo, room, None) for name, room in SAMPLES.items()},
        exports=(
            Export("distances", "Distances as JSON", ".json", files.as_json),
            Export("camera", "Camera for fSpy and Blender, JSON", ".json", files.as_fspy),
        ),
        sheet=measuring.sheet,
    ),
    formula=fit_view,
)
