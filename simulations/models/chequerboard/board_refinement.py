"""The corners of a board at full resolution: each fitted to the pixels about it."""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask, quantile_of
from simulations.models.chequerboard.corner_fit import Fit, fit_corners
from simulations.models.chequerboard.corner_windows import Picture, windows
from simulations.models.chequerboard.grid_recovery import corners_of, in_squares
from simulations.models.chequerboard.local_lattice import Lattice, Prediction, predict
from simulations.models.chequerboard.quadratic_saddle import quadratic_saddle

WINDOW, SMALLEST_WINDOW, LARGEST_WINDOW = 0.45, 2, 10
"""Radius of a corner's window in squares; its least and its largest in px."""
MISFIT, WORSE, WORST = 0.1, 2.5, 0.25
"""A corner is dropped if it differs from its model by more than the first share of its contrast and
by so many times as much as half of the corners do, or by more than the last share."""
STRETCHED = 1.3
"""Largest contrast of the fitted corners, in that of the middles of the squares about them: waves
and woven checks, whose brightness keeps changing, exceed it."""
SHARP, STEADY, VARIED = 0.04, 0.15, 0.5
"""Blur in squares up to which an edge is a step and no wave: such a picture may have a higher
contrast at its edges, if that of the squares is even, within the second share. A camera's
sharpening leaves these halos. If it varies by more than the third share, there is something in the
squares."""
MOVED = 0.3
"""Largest distance of a corner from where it was first found, in squares."""


@dataclass(frozen=True, slots=True)
class Refined:
    """The corners that look like corners at full resolution."""

    lattice: Lattice
    blur_px: float
    """Median standard deviation of the blur of edges."""
    spacing_px: float
    """Median distance between neighbouring lines of the grid."""
    even: bool
    """Whether the squares are as light and as dark as their corners say."""
    filled: bool = False
    """Whether the squares have something in them, as those of a ChArUco board."""


def refine_board(picture: Picture, rough: Lattice, factor: int) -> Refined:
    """Corners that were found in the photograph reduced by ``factor``, to parts of a pixel.

    The window of each follows the size of its squares in the photograph.
    """
    cells = np.argwhere(rough.known)
    predicted = predict(rough, cells)
    places, _ = corners_of(rough)
    spacing = np.nan_to_num(predicted.spacing)
    radii = np.clip(np.rint(WINDOW * spacing), SMALLEST_WINDOW, LARGEST_WINDOW).astype(int)
    edges = np.stack([predicted.across, predicted.down], axis=1)
    fits = Fit(np.full(places.shape, np.nan), *np.full((3, len(places)), np.nan))
    for radius in sorted(set(radii.tolist())):
        selected = radii == radius
        fit = _fit(picture, places[selected], edges[selected], radius, factor)
        for all_values, values in (
            (fits.places, fit.places),
            (fits.blur_px, fit.blur_px),
            (fits.contrast, fit.contrast),
            (fits.misfit, fit.misfit),
        ):
            all_values[selected] = values
    light = (cells.sum(axis=1) % 2 == 0) == rough.light
    moved = np.hypot(*(fits.places - places).T) - 0.5
    good = _good(fits, light) & (moved < MOVED * spacing)
    grid = np.full(rough.places.shape, np.nan)
    grid[cells[good, 0], cells[good, 1]] = fits.places[good]
    if not good.any():
        return Refined(Lattice(grid, rough.light), np.nan, quantile_of(spacing), False)
    blur = quantile_of(fits.blur_px[good])
    middles = _contrast_of_middles(picture, places, predicted, light)
    usual, apart = (
        quantile_of(middles[good]),
        np.diff([quantile_of(middles[good], share) for share in (0.1, 0.9)]),
    )
    even = bool(quantile_of(np.abs(fits.contrast[good])) < STRETCHED * usual)
    sharp = blur < SHARP * quantile_of(spacing)
    lattice = in_squares(Lattice(grid, rough.light))
    return Refined(
        lattice,
        blur,
        quantile_of(spacing),
        even or (sharp and bool(apart < STEADY * usual)),
        sharp and not even and bool(apart > VARIED * usual),
    )


def _contrast_of_middles(
    picture: Picture, places: Floats, predicted: Prediction, light: Mask
) -> Floats:
    """(N,) difference between the middles of the two light and the two dark squares."""
    total = np.zeros(len(places))
    for right, down in ((0.5, 0.5), (-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5)):
        middle = places + right * predicted.across + down * predicted.down
        values = windows(picture, middle, 1).values.mean(axis=1)
        total += 0.5 * values if right == down else -0.5 * values
    return np.where(light, total, -total)


def _fit(picture: Picture, start: Floats, edges: Floats, radius: int, factor: int) -> Fit:
    if factor > 1:
        closer = quadratic_saddle(picture, start, radius, 2)
        start = np.where(np.isfinite(closer), closer, start)
    return fit_corners(picture, start, edges, radius)


def _good(fits: Fit, light: Mask) -> Mask:
    """Whether each looks like the corner model as well as the others do, and is light where it
    should be."""
    finite = np.isfinite(fits.places[:, 0])
    if not finite.any():
        return finite
    usual = quantile_of(fits.misfit[finite])
    right_way = np.where(light, fits.contrast, -fits.contrast) > 0.0
    good: Mask = finite & right_way & (fits.misfit < min(max(MISFIT, WORSE * usual), WORST))
    return good
