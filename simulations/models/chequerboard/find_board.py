"""The corners of a chequerboard in a photograph, each with its column and row.

From coarse to fine: saddle points of a reduced photograph, joined to a grid, which is completed;
then each corner is fitted to the pixels about it at full resolution. Pixel (0, 0), the top-left
one, is centred at (0, 0).

Nothing need be known of the board. Columns run along its longer side, and rows turn clockwise from
them, so that a numbering is never mirrored. Beyond corner (0, 0) the board ends in a dark square,
if only one of its two ends does; otherwise columns run to the right. A calibration, which finds a
pose for each photograph, bears any such choice. As the mirror image of a chequerboard is a
chequerboard, a mirrored photograph cannot be told from another.

Corners that are not on one plane, behind an unknown lens, are refused. A plane is seen through a
homography, and a lens moves its image along the radius and, decentred, a little aside. In the
inverse model of distortion all of that is linear but the homography.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, quantile_of
from simulations.models.chequerboard.board_refinement import refine_board
from simulations.models.chequerboard.board_search import (
    FEW,
    FEWEST,
    NONE,
    NoBoardError,
    full_size,
    search_board,
)
from simulations.models.chequerboard.corner_windows import Picture
from simulations.models.chequerboard.grid_recovery import corners_of
from simulations.models.chequerboard.local_lattice import Lattice, Whole
from simulations.models.distortion.fisheye import EQUIDISTANT, Fisheye
from simulations.models.distortion.lens import ideal
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.homography_estimation import estimate_homography
from simulations.models.geometry.transforms import apply_homography

STEPS = 6
TERMS = 5
"""Terms of the lens: r², r⁴, r⁶ and two of decentring."""


def flat_residuals(places: Floats, indices: Floats, middle: Floats) -> Floats:
    """(N, 2) what a homography and a lens about ``middle`` leave of corners (N, 2), in px.

    ``indices`` (N, 2) are columns and rows. NaN where these do not determine a homography.
    """
    H, valid = estimate_homography(indices, places)
    if not valid:
        return np.full(places.shape, np.nan)
    away = places - middle
    reach = float(np.hypot(*away.T).max())
    away = away / reach
    bends = _bends(away)
    scaled = np.diag([1.0 / reach, 1.0 / reach, 1.0]) @ np.array(
        [[1, 0, -middle[0]], [0, 1, -middle[1]], [0, 0, 1]]
    )
    h = (scaled @ H).ravel()
    h = h / h[8]
    lens = np.zeros(TERMS)
    for _ in range(STEPS):
        rest, slopes = _linearised(h, indices, away)
        rest = rest + bends @ lens
        system = np.concatenate([bends, -slopes], axis=2).reshape(-1, TERMS + 8)
        size = np.linalg.norm(system, axis=0) + 1e-12
        step = np.linalg.lstsq(system / size, -rest.ravel(), rcond=1e-9)[0] / size
        lens += step[:TERMS]
        h[:8] += step[TERMS:]
    rest, _ = _linearised(h, indices, away)
    return reach * (rest + bends @ lens)


def _bends(away: Floats) -> Floats:
    """(N, 2, 5) how each term of the lens moves a point."""
    x, y = away.T
    s = x * x + y * y
    radial = [away * (s**power)[:, None] for power in (1, 2, 3)]
    aside = [np.stack([s + 2 * x * x, 2 * x * y], -1), np.stack([2 * x * y, s + 2 * y * y], -1)]
    return np.stack(radial + aside, axis=-1)


def _linearised(h: Floats, indices: Floats, away: Floats) -> tuple[Floats, Floats]:
    """(N, 2) points less those of the homography, and (N, 2, 8) the derivatives of the latter."""
    u, v = np.asarray(indices, float).T
    mapped, _ = apply_homography(h.reshape(3, 3), np.stack([u, v], axis=-1))
    w = h[6] * u + h[7] * v + h[8]
    slopes = np.zeros((len(u), 2, 8))
    for axis in range(2):
        slopes[:, axis, 3 * axis] = u / w
        slopes[:, axis, 3 * axis + 1] = v / w
        slopes[:, axis, 3 * axis + 2] = 1.0 / w
        slopes[:, axis, 6] = -mapped[:, axis] * u / w
        slopes[:, axis, 7] = -mapped[:, axis] * v / w
    return away - mapped, slopes


NARROWEST_PX = 4.5
"""Least width of a square."""
BLURRED = 0.2
"""Largest blur, in squares."""
BENT_PX, BENT = 0.4, 0.05
"""A board whose corners are farther than this from a plane's, in px and in squares, is no smooth
board behind any lens. One that is bent by less is for the calibration to judge, which knows all
photographs of it."""
NOISY_CODES = 25.0
"""Standard deviation of the noise from which on it is named as the cause."""
ENOUGH_FOR_BENDS = 20
"""Corners from which on a bent board is told from a lens."""

OUTLYING, OUTLYING_PX = 5.0, 0.15
"""A corner is dropped if it is so many times as far from a plane's as half of the corners are, and
farther than this."""

SMALL = "The squares are only {side:.0f} px wide; go closer to the board."
SOFT = "The board is blurred over {blur:.0f} px; focus on it and hold the camera still."
CURVED = (
    "Corners are off by {off:.1f} px from a smooth board behind any lens that is known here; fix "
    "the board to something flat, and keep shadows and reflections off it."
)
NOISY = "The photograph is too noisy to place corners in it; use more light, or a lower ISO."
CHARUCO = (
    "The squares have marks in them, as those of a ChArUco board; it is not read here: print the "
    "plain chequerboard of this page."
)


@dataclass(frozen=True, slots=True)
class FoundBoard:
    """The corners of a chequerboard in a photograph."""

    places: Floats
    """(N, 2) px, x and y."""
    indices: Whole
    """(N, 2) column and row of each, from 0."""
    size: tuple[int, int]
    """Columns and rows between the outermost corners found; the first is not the smaller one."""
    blur_px: float
    """Standard deviation of the blur of edges, by lens and pixel together."""
    spacing_px: float
    """Median distance between neighbouring lines of the grid."""


def find_board(picture: Picture) -> FoundBoard:
    """The board in a photograph (H, W) or (H, W, 3) of codes.

    Raises
    ------
    NoBoardError
        For no board, only a few corners, two boards, squares too small, blur, and a bent board.
    """
    try:
        factor, lattice = search_board(picture)
    except NoBoardError:
        if min(picture.shape[:2]) > 1 and _noise_codes(picture) > NOISY_CODES:
            raise NoBoardError(NOISY) from None
        raise
    refined = refine_board(picture, full_size(lattice, factor), factor)
    count = int(refined.lattice.known.sum())
    if refined.spacing_px < NARROWEST_PX:
        raise NoBoardError(SMALL.format(side=refined.spacing_px))
    if refined.filled:
        raise NoBoardError(CHARUCO)
    if count < FEWEST and _noise_codes(picture) > NOISY_CODES:
        raise NoBoardError(NOISY)
    if count < FEWEST:
        raise NoBoardError(FEW.format(count=count) if count else NONE)
    if refined.blur_px > BLURRED * refined.spacing_px:
        raise NoBoardError(SOFT.format(blur=2.0 * refined.blur_px))
    if not refined.even:
        raise NoBoardError(NONE)
    height, width = picture.shape[:2]
    middle = np.array([width - 1.0, height - 1.0]) / 2.0
    places, indices = _without_outliers(*numbered(refined.lattice), middle)
    columns, rows = (int(most) + 1 for most in indices.max(axis=0))
    most = max(BENT_PX, BENT * refined.spacing_px)
    uneven = _uneven_px(places, indices, middle)
    if uneven > most:
        straightened = _straightened(places, indices, middle)
        uneven = min([uneven, *(_uneven_px(*seen) for seen in straightened)])
    if uneven > most:
        raise NoBoardError(CURVED.format(off=uneven))
    return FoundBoard(places, indices, (columns, rows), refined.blur_px, refined.spacing_px)


def numbered(lattice: Lattice) -> tuple[Floats, Whole]:
    """Places (N, 2), row by row, with columns and rows (N, 2) as the module says."""
    places, indices = corners_of(lattice)
    light = lattice.light ^ bool(indices.min(axis=0).sum() % 2)
    indices = indices - indices.min(axis=0)
    columns, rows = indices.max(axis=0)
    if rows > columns:
        indices = np.stack([indices[:, 1], columns - indices[:, 0]], axis=-1)
        light ^= bool(columns % 2 == 0)
        columns, rows = rows, columns
    leftwards = np.dot(indices[:, 0] - indices[:, 0].mean(), places[:, 0]) < 0.0
    ends_differ = (columns + rows) % 2 == 1
    if light if ends_differ else leftwards:
        indices = np.array([columns, rows]) - indices
    order = np.lexsort(indices.T)
    return places[order], indices[order]


def _without_outliers(places: Floats, indices: Whole, middle: Floats) -> tuple[Floats, Whole]:
    """Without corners that lie much farther from a plane's than the others, such as those half
    behind a finger."""
    if len(places) < ENOUGH_FOR_BENDS:
        return places, indices
    off = np.hypot(*flat_residuals(places, indices.astype(float), middle).T)
    near = ~(off > max(OUTLYING * quantile_of(off), OUTLYING_PX))
    return places[near], indices[near] - indices[near].min(axis=0)


def _straightened(
    places: Floats, indices: Whole, middle: Floats
) -> Iterator[tuple[Floats, Whole, Floats]]:
    """The corners as a pinhole would see them, if the lens is `EQUIDISTANT`."""
    for share in EQUIDISTANT:
        focal = share * 2.0 * float(middle.max())
        straight, valid = ideal((places - middle) / focal, Fisheye())
        if valid.all():
            yield middle + focal * straight, indices, middle


def _noise_codes(picture: Picture) -> float:
    """Standard deviation of the noise, from half of the differences of neighbours."""
    steps = np.diff(picture.reshape(*picture.shape[:2], -1)[..., 0].astype(np.float32), axis=1)
    return quantile_of(np.abs(steps.ravel())) / 0.954


def _uneven_px(places: Floats, indices: Whole, middle: Floats) -> float:
    """RMS distance from the image of a plane through a smooth lens; NaN for few corners."""
    if len(places) < ENOUGH_FOR_BENDS:
        return float("nan")
    residuals = flat_residuals(places, indices.astype(float), middle)
    return root_mean_square(np.hypot(*residuals.T))
