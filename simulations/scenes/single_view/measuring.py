"""The camera of a picture, and lengths in it: readouts, and the data sheet."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from simulations.engine.frame import Readout, format_number, value_with_error
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.reading import Readings
from simulations.engine.stages import Outputs
from simulations.models.calibration.camera import PINHOLE
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion
from simulations.models.projection.picture_lens import (
    IDEAL,
    PictureLens,
    edge_points,
    lens_by_lines,
    unknown_lens,
)
from simulations.models.projection.pinhole import field_of_view_rad
from simulations.models.projection.single_view import SingleView, fit_view
from simulations.models.projection.single_view_lengths import Measured, Stretch, measured
from simulations.scenes.single_view.lines import (
    FLOOR,
    FOCAL_PX,
    HEIGHT,
    LISTS,
    ROOMS,
    Lines,
    Settings,
)

NORMALS = {"floor": 2, "along": 0, "across": 1}
"""The axis at right angles to each plane."""
STATED_ERROR_LINES = 1.0  # lines that the error of an end, as said, counts for
FEWER_LINES = 4.0
"""By how many fewer lines the error of an end is divided: then three of its errors hold a number as
often as of a normal distribution, within 3 % of Student's t from nine lines on."""
UNKNOWN = 0.25  # relative standard error from which a number counts as unknown
FOCUS = 0.005
"""Share by which the focal length differs between photographs of a board and of a room, as the
lens is focused (standard deviation)."""
OFF_SQUARE_RAD = math.radians(1.5)
"""Angle by which the walls that readers photograph are off square (standard deviation)."""
NONE, MISSING = "none drawn", "lines missing"

type Pair = tuple[float, float]
"""A number and its standard error, NaN where there is none."""


@dataclass(frozen=True, slots=True)
class Found:
    """The camera, or why there is none."""

    view: SingleView | None
    problem: str = ""
    sigma: float = 1.0
    """Standard deviation of an end, in pixels: as said of the book's lines, and of the reader's by
    how well they agree."""
    misfits: bool = False
    """Whether the lines miss each other by much more than their ends' errors, as said, explain."""

    @property
    def focal_error(self) -> float:
        """Standard error of ln f, that is, of f relative to it; infinite without a camera."""
        if self.view is None:
            return math.inf
        return math.sqrt(self.view.covariance[0, 0])

    @property
    def knows_focal(self) -> bool:
        return self.focal_error < UNKNOWN


@dataclass(frozen=True, slots=True)
class Lengths:
    """The lengths and the heights that count, as measured, the known one first."""

    floor: tuple[Pair, ...] = ()
    """Metres."""
    height: tuple[Pair, ...] = ()
    distance: Pair = (math.nan, math.nan)
    """Distance of the camera from the plane."""
    known: str = ""
    """The list that has the known length."""


def lens_of(
    photo: Codes, lines: Lines, calibration: str, readings: Readings, photograph: Photograph | None
) -> tuple[PictureLens, str]:
    """The lens, and how it is known: by calibration, or by the edges along the lines. That of the
    book's pictures has no distortion; calibrated, its focal length is known too."""
    if photograph is None:
        if calibration != "any":
            return IDEAL, "without distortion"
        middle = (0.5 * (lines.size[0] - 1), 0.5 * (lines.size[1] - 1))
        return PictureLens(middle, (FOCAL_PX, FOCAL_PX), pinhole_errors=(FOCUS, 0.0)), "calibrated"
    why = ""
    for reading in readings if calibration != "none" else ():
        why = "" if calibration == "any" else other_camera(reading.data, photograph)
        why = why or other_shape(reading.data, lines.size)
        if not why:
            return calibrated(reading.data, lines.size), "calibrated on this page"
    drawn = [ends for axis in range(3) for ends in lines.counted(axis)]
    followed = [points for ends in drawn if len(points := edge_points(photo, ends))]
    lens = lens_by_lines(followed, unknown_lens(lines.size))
    how = f"by {len(followed)} edges that are straight" if followed else "by the lines alone"
    return lens, f"{how}; {why}" if why else how


def other_camera(data: Mapping[str, Any], photograph: Photograph) -> str:
    """The reason why a calibration may be of another camera; empty if the files say that it is of
    this one."""
    taken, facts = data.get("taken", {}), photograph.facts
    for name in ("make", "model", "lens", "focal_mm"):
        ours, theirs = facts.get(name), taken.get(name)
        if ours is not None and theirs is not None and ours != theirs:
            what = "focal length" if name == "focal_mm" else "camera or lens"
            return f"the calibrated one is of another {what}"
    if not all(name in each for each in (taken, facts) for name in ("model", "focal_mm")):
        return "the calibrated one may be of another camera: choose it if it is of this one"
    return ""


def other_shape(data: Mapping[str, Any], size: tuple[int, int]) -> str:
    """The reason why a calibration's photographs are not this one at another scale, if so."""
    off = abs(data["height"] * size[0] / data["width"] - size[1])
    return "the calibrated one is of pictures of another shape" if off > 0.005 * size[1] else ""


def calibrated(data: Mapping[str, Any], size: tuple[int, int]) -> PictureLens:
    """The lens of a calibration's file, for a photograph of this size."""
    camera, scale = data["camera"], size[0] / data["width"]
    cx, cy = (scale * (camera[name] + 0.5) - 0.5 for name in ("cx", "cy"))
    kind = Fisheye if data.get("model") == "fisheye" else Distortion
    lens = kind(**{name: value for name, value in camera.items() if name not in PINHOLE})
    errors = data.get("standard_errors", {})
    off = [errors.get(name, 0.0) for name in ("fx", "cx", "cy")]
    known = math.hypot(off[0] / camera["fx"], FOCUS), scale * max(off[1:])
    unit = scale * camera["fx"], scale * camera["fy"]
    return PictureLens((cx, cy), unit, lens, pinhole_errors=known)


def camera_of(
    lines: Lines,
    lens: tuple[PictureLens, str],
    sigma: float,
    centre: bool,
    photograph: Photograph | None,
) -> Found:
    ends = [lines.counted(axis) for axis in range(3)]
    counts = [len(each) for each in ends]
    if sum(count >= 2 for count in counts) < 2:
        return Found(None, "Draw two lines or more along each of two directions.")
    if centre and min(counts) < 2:
        return Found(None, "The principal point needs lines along three directions.")
    axes = np.repeat(np.arange(3), counts)

    def fitted(sigma: float, lens: PictureLens) -> SingleView:
        drawn = np.concatenate(ends)
        off = OFF_SQUARE_RAD if photograph else 0.0
        return fit_view(
            drawn, axes, lines.size, sigma, find_centre=centre, lens=lens, off_square=off
        )

    try:
        view = fitted(sigma, replace(lens[0], error=0.0))
        misfits = view.misfit > view.spare + 4.0 * math.sqrt(2 * view.spare) + 4.0
        if photograph:  # few lines tell it roughly
            both = STATED_ERROR_LINES * sigma**2 + view.misfit * sigma**2
            sigma = math.sqrt(both / max(STATED_ERROR_LINES + view.spare - FEWER_LINES, 1.0))
            view = fitted(sigma, lens[0])
    except ValueError:
        return Found(None, "Two directions meet in one point: check which lines are which.")
    return Found(view, "", sigma, misfits)


def lengths_of(lines: Lines, found: Found, known: float, plane: str) -> Lengths:
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
            found.view, first, known, tuple(others), found.sigma, normal=NORMALS[plane]
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


def true_lengths(
    lines: Lines, picture: str, plane: str, photograph: Photograph | None
) -> tuple[tuple[float, ...], ...]:
    """The true lengths and heights in metres, where those of the book are drawn; else none."""
    if photograph is not None or plane != "floor":
        return (), ()
    true = [(number, ROOMS[picture].metres(number)) for number in (FLOOR, HEIGHT)]
    return tuple(
        metres if len(lines.counted(number)) == len(metres) else () for number, metres in true
    )


def with_error(pair: Pair, unit: str = "") -> str:
    """``2.13 ± 0.04 m``; in words for what is unknown."""
    value, error = pair
    if not math.isfinite(value):
        return "beyond the horizon"
    if not error < UNKNOWN * abs(value):
        return "cannot be told"
    return f"{value_with_error(value, error)} {unit}".strip()


def readouts(outputs: Outputs) -> tuple[Readout, ...]:
    """The numbers beside the figure; those in sight first, with the truth where it is known."""
    found: Found = outputs["view"]
    lengths: Lengths = outputs["lengths"]
    view, known, knows = found.view, lengths.known, found.knows_focal
    is_readers = outputs["photograph"] is not None
    focal = centre = pitch = roll = (MISSING, "")
    scatter = ("too few lines", "")
    if view is not None:
        true_focal = "" if is_readers else f", true {FOCAL_PX:.0f} px"
        focal = _split((view.focal_px, view.focal_px * found.focal_error), "px", true_focal)
        x, y = (format_number(number, 0) for number in view.centre)
        centre = f"({x}, {y})", "px"
        values = np.degrees((view.pitch, view.roll)).tolist()
        errors = view.spread(lambda view: np.degrees((view.pitch, view.roll))).tolist()
        angles = [value_with_error(*pair) for pair in zip(values, errors, strict=True)]
        pitch, roll = ((text, "°") for text in angles)
        if view.spare >= 1:  # the error of an end by the lines' own misfit
            ends = found.sigma * math.sqrt(view.misfit / view.spare)
            scatter = format_number(ends, 1), "px"
    floor, height = (
        _first_length(pairs, true, known == name)
        for name, pairs, true in zip(
            ("floor", "height"), (lengths.floor, lengths.height), outputs["truth"], strict=True
        )
    )
    error = (format_number(100.0 * found.focal_error, 2), "%") if knows else ("unknown", "")
    distance = _split(lengths.distance, "m") if known else (NONE, "")
    return (
        Readout("focal", "Focal length", *focal, role="camera"),
        Readout("length", "Length on the plane", *floor, role="image"),
        Readout("height", "Height above the plane", *height, role="image"),
        Readout("focal_error", "Standard error of f", *error, role="camera"),
        Readout("pitch", "Looks down (pitch)", *pitch, role="camera"),
        Readout("roll", "Leans right (roll)", *roll, role="camera"),
        Readout("distance", "Camera above the plane", *distance, role="camera"),
        Readout("scatter", "Scatter of the ends", *scatter),
        Readout("centre_at", "Principal point", *centre, role="camera"),
        Readout("lens", "Lens", bend_in_words(view, outputs["lens"]), "", role="camera"),
    )


def bend_in_words(view: SingleView | None, lens: tuple[PictureLens, str]) -> str:
    """k₁ with its error and how it is known."""
    known, how = lens
    if known == IDEAL:
        return how
    bend = view.lens if view else known
    share = (view.focal_px / bend.unit[0]) ** 2 if view else 1.0  # to the unit of the focal length
    if not known.error:
        return f"k₁ = {format_number(known.distortion.k1, 4)}, {how}"
    error = math.sqrt(view.covariance[6, 6]) if view else known.error
    return f"k₁ = {value_with_error(share * bend.distortion.k1, share * error)}, {how}"


def _first_length(
    pairs: tuple[Pair, ...], truth: tuple[float, ...], known: bool
) -> tuple[str, str]:
    """Text and unit of the first length that is measured."""
    if len(pairs) <= known:
        return NONE, ""
    return _split(pairs[known], "m", f", true {format_number(truth[known])} m" if truth else "")


def _split(pair: Pair, unit: str, truth: str = "") -> tuple[str, str]:
    """The text and the unit of a value with its error."""
    text = with_error(pair)
    return text, unit + truth if "±" in text else ""


def sheet(_settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet; none for what is not drawn."""
    found: Found = outputs["view"]
    lines: Lines = outputs["lines"]
    shown = {each.name: each for each in readouts(outputs)}
    named = tuple(
        shown[name]
        for name in ("length", "height", "distance", "focal", "pitch", "roll")
        if shown[name].text not in (NONE, MISSING)
    )
    named += _by_the_file(lines, outputs["photograph"])
    if found.view is not None and outputs["photograph"]:
        named += (shown["lens"], shown["scatter"])
    if found.view is None or not found.knows_focal:
        return named

    def angle_deg(view: SingleView) -> float:
        return math.degrees(field_of_view_rad(view.focal_px, lines.size[0]))

    text = value_with_error(angle_deg(found.view), float(found.view.spread(angle_deg)))
    return (*named, Readout("field_of_view", "Horizontal field of view", text, "°", role="camera"))


def _by_the_file(lines: Lines, photograph: Photograph | None) -> tuple[Readout, ...]:
    """The focal length that EXIF states, on the film of 36 × 24 mm, which is by the diagonal."""
    stated = photograph.facts.get("focal_35mm_mm") if photograph else None
    if not isinstance(stated, int | float) or not stated > 0:
        return ()
    pixels = float(stated) / math.hypot(36.0, 24.0) * math.hypot(*lines.size)
    label = "Focal length by the file"
    return (Readout("focal_by_file", label, format_number(pixels, 0), "px", role="camera"),)
