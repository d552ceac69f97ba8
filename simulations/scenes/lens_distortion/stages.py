"""The stages of the lens-distortion figure: picture → through the lens → corrected → bytes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb_table
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.pixel_grid import centred
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
from simulations.scenes.lens_distortion.drawing import grid_overlay, picture_overlay
from simulations.scenes.lens_distortion.profile import profile_overlay
from simulations.scenes.lens_distortion.radii import (
    FOCAL_PX,
    HEIGHT_PX,
    WIDTH_PX,
    Radii,
    centred_pixels,
    ideal_radii,
    pixel_radii,
)

MARGIN_PX = (120, 90)
"""Margin beyond the sides of the pinhole picture that a barrel can bring into view."""
PHOTOGRAPH_PX = (WIDTH_PX + 2 * MARGIN_PX[0], HEIGHT_PX + 2 * MARGIN_PX[1])
"""Size of a reader's own picture: with the margin."""
UNSEEN = (0.33, 0.34, 0.36)
"""Linear grey where the model has no light of the scene."""


@dataclass(frozen=True, slots=True)
class Drawings:
    """The SVG of all three panels that depends on the lens alone."""

    grid: str
    photograph: str
    """Overlay of the photograph ..."""
    corrected: str
    """... and of the corrected picture."""
    profile: str


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


def _drawings(k1: float, k2: float) -> Drawings:
    lens = Distortion(k1=k1, k2=k2)
    return Drawings(
        grid_overlay(lens),
        picture_overlay(lens, corrected=False),
        picture_overlay(lens, corrected=True),
        profile_overlay(lens),
    )


def needs_margin(k1: float, k2: float) -> bool:
    """Whether light from beyond the sides of the pinhole picture may come into view.

    If k₁ and k₂ are not negative, no point moves inwards.
    """
    return min(k1, k2) < 0.0


def _margin_px(margin: bool) -> tuple[int, int]:
    return MARGIN_PX if margin else (0, 0)


def _scenery(picture: str, photograph: Photograph | None) -> Floats:
    """The picture with its margin, drawn once, so that a change of k₁ need not redraw it."""
    if photograph:
        return decode_srgb(np.float32(1 / 255) * photograph.codes)
    draw = {"room": checker_room, "chart": resolution_chart}[picture]
    return draw(*PHOTOGRAPH_PX, FOCAL_PX)


def _pinhole(scenery: Floats, margin: bool) -> Floats:
    if margin:
        return scenery
    x, y = MARGIN_PX
    return scenery[y : y + HEIGHT_PX, x : x + WIDTH_PX]


def _undistorted_frame(pinhole: Floats, margin: bool) -> Photo:
    x, y = _margin_px(margin)
    shown = pinhole[y : y + HEIGHT_PX, x : x + WIDTH_PX]
    return Photo(shown, np.ones((HEIGHT_PX, WIDTH_PX), np.float32))


def _map(radii: Radii, k1: float, k2: float, tier: str, margin: bool) -> Warp:
    """The place in the pinhole picture of the light of each pixel of the photograph."""
    lens = Distortion(k1=k1, k2=k2)
    ideal = ideal_radii(radii.distinct, lens, tier)
    ratio = (ideal / radii.distinct)[radii.of_pixel].reshape(HEIGHT_PX, WIDTH_PX)
    beyond_x, beyond_y = _margin_px(margin)
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
    if photo.coverage.min() == 1.0:
        return to_rgba8(encode_srgb_table(photo.linear))
    return to_rgba8(encode_srgb_table(_over_unseen(photo)))


def _over_unseen(photo: Photo) -> Floats:
    """The photograph where it covers a pixel, grey where it does not."""
    laid = np.empty_like(photo.linear)
    for channel, grey in enumerate(np.asarray(UNSEEN, np.float32)):
        laid[..., channel] = grey + (photo.linear[..., channel] - grey) * photo.coverage
    return laid


def _ideal_lens(k1: float, k2: float) -> str:
    return "" if k1 or k2 else "k₁ = k₂ = 0: the lens is ideal"


def _not_corrected(k1: float, k2: float, correct: bool) -> str:
    return _ideal_lens(k1, k2) or ("" if correct else "no correction is asked for")


STAGES = (
    Stage("drawings", _drawings),
    Stage("radii", pixel_radii),
    Stage("scenery", _scenery),
    Stage("pinhole", _pinhole, ("scenery",)),
    Stage("undistorted", _undistorted_frame, ("pinhole",)),
    Stage("source", gather_source, ("pinhole",)),
    Stage("map", _map, ("radii",), _ideal_lens),
    Stage("through-lens", _through_lens, ("undistorted", "source", "map"), _ideal_lens),
    Stage("corrected", _corrected, ("through-lens",), _not_corrected),
    Stage("encoded", _encoded, ("corrected",)),
)
"""The stages in order. ``margin`` is from `needs_margin`."""
