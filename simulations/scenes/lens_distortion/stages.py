"""What the lens-distortion figure computes: picture → map → through the lens → corrected → bytes.

The photograph is 320 × 240 px with a focal length of 200 px, so that its half-diagonal is 200 px
and its corners lie at the normalised radius r = 1, 45° from the axis.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Values
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_inverse import invert_bracketed
from simulations.models.distortion.radial_table import invert
from simulations.models.distortion.undistortion import (
    undistort_first_order,
    undistort_fixed_point,
    undistort_newton,
    undistort_table,
)
from simulations.models.sampling.resampling import GatherTable, gather, gather_table
from simulations.pictures.checker_room import checker_room
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_distortion.drawing import drawings

type Floats = NDArray[np.floating]

WIDTH_PX, HEIGHT_PX = 320, 240
FOCAL_PX = 200.0
HALF_DIAGONAL = 0.5 * np.hypot(WIDTH_PX, HEIGHT_PX) / FOCAL_PX
"""Normalised radius of the picture's corners: 1."""
MARGIN_PX = (120, 90)
"""A barrel pulls into view what lies so far beyond the sides of the pinhole picture, at most."""
UNSEEN = (0.33, 0.34, 0.36)
"""Linear grey where no light of the scene arrives according to the model."""


TIERS = (
    "first-order",
    "lookup-table",
    "newton-3",
    "newton-4",
    "newton-5",
    "fixed-point-5",
    "fixed-point-10",
    "checked-table",
    "newton-bracketed",
)
"""Ways to find where a pixel's light comes from: rungs of the ladder `inverse-strong`."""
DEFAULT_TIER = "checked-table"


@dataclass(frozen=True, slots=True)
class Radii:
    """The distinct radii among the pixel centres: a radial map is solved once for each."""

    distinct: Floats
    """Sorted normalised radii."""
    of_pixel: NDArray[np.intp]
    """(HEIGHT_PX · WIDTH_PX,) index into ``distinct``."""


@dataclass(frozen=True, slots=True)
class Warp:
    """A gather table and how much of each pixel of its output has a source."""

    table: GatherTable
    coverage: Floats
    """(HEIGHT_PX, WIDTH_PX) float32 in [0, 1]."""


@dataclass(frozen=True, slots=True)
class Photo:
    """A picture in linear light, and where it shows the scene at all."""

    linear: Floats
    coverage: Floats


def centred_pixels() -> Floats:
    """(HEIGHT_PX, WIDTH_PX, 2) pixel centres relative to the principal point, in px."""
    x = np.arange(WIDTH_PX) - 0.5 * (WIDTH_PX - 1)
    y = np.arange(HEIGHT_PX) - 0.5 * (HEIGHT_PX - 1)
    return np.stack(np.meshgrid(x, y), axis=-1)


def ideal_radii(seen: Floats, lens: Distortion, tier: str) -> Floats:
    """The radius without the lens of each radius in the photograph, as the tier computes it.

    Only the last two notice the fold; the others run on past it, or out of range.
    """
    if tier == "checked-table":
        return invert(lens.radial, seen)[0]
    if tier == "newton-bracketed":
        return invert_bracketed(lens.radial, seen)[0]
    points = np.stack((seen, np.zeros_like(seen)), axis=-1)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        match tier.rsplit("-", 1):
            case ["first", "order"]:
                ideal = undistort_first_order(points, lens)
            case ["lookup", "table"]:
                ideal = undistort_table(points, lens)
            case ["fixed-point", steps]:
                ideal = undistort_fixed_point(points, lens, int(steps))
            case ["newton", steps]:
                ideal = undistort_newton(points, lens, int(steps))
            case _:
                raise ValueError(f"tier {tier!r}; legal: {', '.join(TIERS)}")
    radii: Floats = ideal[..., 0]
    return radii


def true_radii(seen: Floats, lens: Distortion) -> Floats:
    """The same by bisection down to the last bit, sharing nothing with any tier; NaN past the fold.

    The image radius is written out: r (1 + k₁ r² + k₂ r⁴).
    """
    fold = min(fold_radius(lens), 1e3)
    low, high = np.zeros_like(seen), np.full_like(seen, fold)
    for _ in range(64):
        middle = 0.5 * (low + high)
        s = middle * middle
        beyond = middle * (1.0 + s * (lens.k1 + s * lens.k2)) > seen
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.where(seen < largest_distorted_radius(lens), high, np.nan)


def inversion_error_px(lens: Distortion, tier: str) -> float:
    """RMS over the photograph of how far off the scene point is that each pixel is drawn from.

    In pixels of the pinhole picture; pixels that show nothing do not count.
    """
    radii = _radii()
    wrong = ideal_radii(radii.distinct, lens, tier) - true_radii(radii.distinct, lens)
    pixels = np.bincount(radii.of_pixel)
    seen = ~np.isnan(wrong)
    if np.isinf(wrong[seen]).any():
        return float("inf")
    square = np.average(np.square(wrong[seen]), weights=pixels[seen])
    return float(np.sqrt(square)) * FOCAL_PX


def _radii() -> Radii:
    # Twice a coordinate is an odd whole number: equal radii are found without rounding.
    doubled = np.rint(2.0 * centred_pixels()).astype(np.int64)
    squares, of_pixel = np.unique((doubled**2).sum(axis=-1).ravel(), return_inverse=True)
    return Radii(np.sqrt(squares) / (2.0 * FOCAL_PX), of_pixel.astype(np.intp))


def needs_margin(values: Values) -> bool:
    """Whether light from beyond the sides of the pinhole picture may come into view.

    With k₁ and k₂ not negative, no point is drawn further in than it lies.
    """
    return min(values.number("k1"), values.number("k2")) < 0.0


def _margin_px(margin: bool) -> tuple[int, int]:
    return MARGIN_PX if margin else (0, 0)


def _pinhole(picture: str, margin: bool) -> Floats:
    beyond_x, beyond_y = _margin_px(margin)
    width, height = WIDTH_PX + 2 * beyond_x, HEIGHT_PX + 2 * beyond_y
    draw = {"room": checker_room, "chart": resolution_chart}[picture]
    return draw(width, height, FOCAL_PX)


def _undistorted_frame(pinhole: Floats, margin: bool) -> Photo:
    x, y = _margin_px(margin)
    shown = pinhole[y : y + HEIGHT_PX, x : x + WIDTH_PX]
    return Photo(shown, np.ones((HEIGHT_PX, WIDTH_PX), np.float32))


def _map(radii: Radii, k1: float, k2: float, tier: str, margin: bool) -> Warp:
    """For each pixel of the photograph, where in the pinhole picture its light comes from."""
    lens = Distortion(k1=k1, k2=k2)
    ideal = ideal_radii(radii.distinct, lens, tier)
    ratio = (ideal / radii.distinct)[radii.of_pixel].reshape(HEIGHT_PX, WIDTH_PX, 1)
    beyond_x, beyond_y = _margin_px(margin)
    centre = np.array((beyond_x + 0.5 * (WIDTH_PX - 1), beyond_y + 0.5 * (HEIGHT_PX - 1)))
    shape = (HEIGHT_PX + 2 * beyond_y, WIDTH_PX + 2 * beyond_x)
    table = gather_table(centre + centred_pixels() * ratio, shape)
    # A soft edge, one pixel wide, where the image ends.
    limit = min(largest_distorted_radius(lens), 1e6)
    edge = np.clip((limit - radii.distinct) * FOCAL_PX + 0.5, 0.0, 1.0).astype(np.float32)
    coverage = edge[radii.of_pixel].reshape(HEIGHT_PX, WIDTH_PX)
    return Warp(table, coverage * table.inside.reshape(coverage.shape))


def _through_lens(_undistorted: Photo, pinhole: Floats, warp: Warp) -> Photo:
    return Photo(gather(warp.table, pinhole, fill=None), warp.coverage)


def _corrected(photo: Photo, k1: float, k2: float) -> Photo:
    """The photograph with its distortion taken out again.

    For each pixel the forward formula tells where in the photograph its light went. Past the
    fold it would fetch light from a wrong place: those pixels are sent off the picture.
    """
    lens = Distortion(k1=k1, k2=k2)
    ideal = centred_pixels() / FOCAL_PX
    folded = np.hypot(ideal[..., 0], ideal[..., 1]) >= fold_radius(lens)
    centre = np.array((0.5 * (WIDTH_PX - 1), 0.5 * (HEIGHT_PX - 1)))
    position = np.where(folded[..., None], -2.0, centre + distort(ideal, lens) * FOCAL_PX)
    table = gather_table(position, (HEIGHT_PX, WIDTH_PX), "spline", np.float32)
    linear = np.maximum(gather(table, photo.linear), 0.0)  # splines undershoot at edges
    return Photo(linear, np.clip(gather(table, photo.coverage), 0.0, 1.0))


def _encoded(photo: Photo) -> NDArray[np.uint8]:
    covered = photo.coverage[..., None]
    unseen = np.asarray(UNSEEN, np.float32)
    return to_rgba8(encode_srgb(unseen + (photo.linear - unseen) * covered))


def _ideal_lens(values: Values) -> str:
    return "k₁ = k₂ = 0: the lens is ideal" if not values["k1"] and not values["k2"] else ""


def _not_corrected(values: Values) -> str:
    return _ideal_lens(values) or ("" if values.toggle("correct") else "no correction is asked for")


STAGES = (
    Stage("drawings", drawings),
    Stage("radii", _radii),
    Stage("pinhole", _pinhole),
    Stage("undistorted", _undistorted_frame, ("pinhole",)),
    Stage("map", _map, ("radii",), _ideal_lens),
    Stage("through-lens", _through_lens, ("undistorted", "pinhole", "map"), _ideal_lens),
    Stage("corrected", _corrected, ("through-lens",), _not_corrected),
    Stage("encoded", _encoded, ("corrected",)),
)
"""In order; each is recomputed only when what it reads has changed. ``margin``: `needs_margin`."""
