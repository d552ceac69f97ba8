"""The stages of the lens-distortion figure: picture → through the lens → corrected → bytes.

The photograph is 320 × 240 px with a focal length of 200 px, so that its half-diagonal is 200 px
and its corners are at the normalised radius r = 1, 45° from the axis.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.photograph import Photograph
from simulations.engine.raster import opaque
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, centred
from simulations.models.color.srgb import decode_srgb, encode_srgb_codes
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.undistortion import INVERSES
from simulations.models.sampling.resampling import (
    GatherTable,
    Source,
    gather,
    gather_source,
    gather_table,
    gather_table_at,
)
from simulations.pictures.checker_room import checker_room
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_distortion.drawing import overlays

WIDTH_PX, HEIGHT_PX = 320, 240
FOCAL_PX = 200.0
MARGIN_PX = (120, 90)
"""Margin beyond the sides of the pinhole picture that a barrel can bring into view."""
PHOTOGRAPH_PX = (WIDTH_PX + 2 * MARGIN_PX[0], HEIGHT_PX + 2 * MARGIN_PX[1])
"""Size of a reader's own picture: with the margin."""
TIERS = tuple(name for name in INVERSES if name != "fixed-point-20")
"""Methods to find the source of a pixel's light: rungs of the ladder `inverse-strong`, without the
longest of those that may diverge."""
UNSEEN = (0.33, 0.34, 0.36)
"""Linear grey where the model has no light of the scene."""


@dataclass(frozen=True, slots=True)
class Radii:
    """The distinct radii among the pixel centres: a radial map is solved once for each."""

    distinct: Floats
    """Sorted normalised radii."""
    of_pixel: NDArray[np.intp]
    """(HEIGHT_PX · WIDTH_PX,) index into ``distinct``."""


@dataclass(frozen=True, slots=True)
class Warp:
    """A gather table, and the share of each output pixel that has a source."""

    table: GatherTable
    coverage: Floats
    """(HEIGHT_PX, WIDTH_PX) float32 in [0, 1]."""


@dataclass(frozen=True, slots=True)
class Photo:
    """A picture in linear light, and where it shows the scene."""

    linear: Floats
    coverage: Floats


def centred_pixels() -> Floats:
    """(HEIGHT_PX, WIDTH_PX, 2) pixel centres relative to the principal point, in px."""
    return np.stack(np.meshgrid(centred(WIDTH_PX), centred(HEIGHT_PX)), axis=-1)


def pixel_radii() -> Radii:
    # Twice a coordinate is an odd whole number, so that equal radii are exactly equal.
    doubled = np.rint(2.0 * centred_pixels()).astype(np.int64)
    lengths = (doubled**2).sum(axis=-1).ravel()
    squares, of_pixel = np.unique(lengths, return_inverse=True)  # noqa: TID251, as it has indices
    return Radii(np.sqrt(squares) / (2.0 * FOCAL_PX), of_pixel.astype(np.intp))


def ideal_radii(distorted: Floats, lens: Distortion, tier: str) -> Floats:
    """The radius without the lens of each radius in the photograph, as the tier computes it.

    Only the last three detect the fold; the others continue past it, or overflow.
    """
    points = np.stack((distorted, np.zeros_like(distorted)), axis=-1)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return INVERSES[tier](points, lens)[..., 0]


def true_radii(distorted: Floats, lens: Distortion) -> Floats:
    """Ideal radii by bisection to the last bit, independent of all tiers; NaN past the fold.

    The image radius is written out: r (1 + k₁ r² + k₂ r⁴).
    """
    fold = min(fold_radius(lens), 1e3)
    low, high = np.zeros_like(distorted), np.full_like(distorted, fold)
    for _ in range(64):
        middle = 0.5 * (low + high)
        s = middle * middle
        beyond = middle * (1.0 + s * (lens.k1 + s * lens.k2)) > distorted
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.where(distorted < largest_distorted_radius(lens), high, np.nan)


def inversion_error_px(lens: Distortion, tier: str) -> float:
    """RMS error over the photograph of the scene point that each pixel is drawn from.

    In pixels of the pinhole picture, without pixels that show nothing.
    """
    radii = pixel_radii()
    wrong = ideal_radii(radii.distinct, lens, tier) - true_radii(radii.distinct, lens)
    pixels = np.bincount(radii.of_pixel)
    seen = ~np.isnan(wrong)
    if np.isinf(wrong[seen]).any():
        return float("inf")
    square = np.average(np.square(wrong[seen]), weights=pixels[seen])
    return float(np.sqrt(square)) * FOCAL_PX


def needs_margin(k1: float, k2: float) -> bool:
    """Whether light from beyond the sides of the pinhole picture may come into view.

    If k₁ and k₂ are not negative, no point moves inwards.
    """
    return min(k1, k2) < 0.0


def _scenery(picture: str, photograph: Photograph | None) -> Floats:
    """The picture with its margin, drawn once, so that a change of k₁ need not redraw it."""
    if photograph:
        return decode_srgb(np.float32(1 / 255) * photograph.codes)
    draw = {"room": checker_room, "chart": resolution_chart}[picture]
    return draw(*PHOTOGRAPH_PX, FOCAL_PX)


def _without_margin(picture: Floats) -> Floats:
    x, y = MARGIN_PX
    return picture[y : y + HEIGHT_PX, x : x + WIDTH_PX]


def _pinhole(scenery: Floats, margin: bool) -> Floats:
    return scenery if margin else _without_margin(scenery)


def _undistorted(pinhole: Floats, margin: bool) -> Photo:
    visible = _without_margin(pinhole) if margin else pinhole
    return Photo(visible, np.ones((HEIGHT_PX, WIDTH_PX), np.float32))


def _map(radii: Radii, k1: float, k2: float, tier: str, margin: bool) -> Warp:
    """The place in the pinhole picture of the light of each pixel of the photograph."""
    lens = Distortion(k1=k1, k2=k2)
    ideal = ideal_radii(radii.distinct, lens, tier)
    ratio = (ideal / radii.distinct)[radii.of_pixel].reshape(HEIGHT_PX, WIDTH_PX)
    beyond_x, beyond_y = MARGIN_PX if margin else (0, 0)
    x = beyond_x + 0.5 * (WIDTH_PX - 1) + centred(WIDTH_PX) * ratio
    y = beyond_y + 0.5 * (HEIGHT_PX - 1) + centred(HEIGHT_PX)[:, None] * ratio
    shape = (HEIGHT_PX + 2 * beyond_y, WIDTH_PX + 2 * beyond_x)
    table = gather_table_at(x, y, shape, dtype=np.float32)
    # A soft edge, one pixel wide, where the image ends.
    limit = min(largest_distorted_radius(lens), 1e6)
    edge = np.clip((limit - radii.distinct) * FOCAL_PX + 0.5, 0.0, 1.0).astype(np.float32)
    coverage = edge[radii.of_pixel].reshape(HEIGHT_PX, WIDTH_PX)
    return Warp(table, coverage * table.inside.reshape(coverage.shape))


def _through_lens(_undistorted: Photo, source: Source, warp: Warp) -> Photo:
    return Photo(gather(warp.table, source, fill=None), warp.coverage)


def _corrected(photo: Photo, k1: float, k2: float) -> Photo:
    """The photograph with its distortion corrected.

    For each pixel the forward formula gives the place of its light in the photograph. Past the fold
    that place would be wrong: those pixels are put off the picture.
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
    """The photograph where it covers a pixel, grey where it does not."""
    if photo.coverage.min() == 1.0:
        return opaque(encode_srgb_codes(photo.linear))
    laid = np.empty_like(photo.linear)
    for channel, grey in enumerate(np.asarray(UNSEEN, np.float32)):
        laid[..., channel] = grey + (photo.linear[..., channel] - grey) * photo.coverage
    return opaque(encode_srgb_codes(laid))


def _ideal_lens(k1: float, k2: float) -> str:
    return "" if k1 or k2 else "k₁ = k₂ = 0: the lens is ideal"


def _not_corrected(k1: float, k2: float, correct: bool) -> str:
    return _ideal_lens(k1, k2) or ("" if correct else "no correction is asked for")


STAGES = (
    Stage("drawings", overlays),
    Stage("radii", pixel_radii),
    Stage("scenery", _scenery),
    Stage("pinhole", _pinhole, ("scenery",)),
    Stage("undistorted", _undistorted, ("pinhole",)),
    Stage("source", gather_source, ("pinhole",)),
    Stage("map", _map, ("radii",), neutral=_ideal_lens),
    Stage("through-lens", _through_lens, ("undistorted", "source", "map"), neutral=_ideal_lens),
    Stage("corrected", _corrected, ("through-lens",), neutral=_not_corrected),
    Stage("encoded", _encoded, ("corrected",)),
)
"""The stages in order. ``margin`` is from `needs_margin`."""
