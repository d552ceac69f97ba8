"""2D transformations estimated from pairs of points.

All functions return ``(H, valid)``. ``valid`` is False, and H is NaN, where the points do not
determine the transformation: too few, coincident, or collinear where a plane is needed.

Source: Szeliski, 2nd ed., §8.1; Hartley, In defense of the eight-point algorithm, 1997 (why to
normalise first); Umeyama, Least-squares estimation of transformation parameters, 1991.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry.homography_algebra import is_singular
from simulations.models.geometry.transforms import affine, apply_homography, similarity

DEGENERATE = 1e-9
"""Singular values below this share of the largest count as zero."""

LARGEST_ERROR = 1e-6
"""Largest error from rounding the entries of a homography, as a share of the spread of the
points."""

LARGEST, SMALLEST = 1e100, 1e-100
"""Range of coordinates and of distances within which no product overflows or vanishes."""

type Estimate = tuple[Floats, bool]


def estimate_homography(source: ArrayLike, target: ArrayLike) -> Estimate:
    """The homography that maps ``source`` to ``target``, (N, 2) each, N ≥ 4.

    Exact for four points, no three of them collinear. For more, the direct linear transform: it
    minimises an algebraic error in coordinates normalised to the spread of the points, without
    which the squares of pixel coordinates would drown the rest. H is returned with w positive at
    the source points, and with h₃₃ = 1 if that is possible.

    Returns
    -------
    H : (3, 3). Its nine rounded numbers move the images by less than ε · (distance / spread) of
        the one picture times that of the other, as a share of their spread, where ε = 2.2e-16 and
        the distances are those from the origins. For two pictures 800 px wide, both a million px
        from the origin, the error is 1e-7 px, with a bound of 2e-6 px.
    valid : also False if that bound exceeds `LARGEST_ERROR`: then subtract a point near the
        middle of each picture first. Also False if the source points are on both sides of the line
        that is mapped to infinity, which no picture does.
    """
    before, after = _pairs(source, target)
    T_before, T_after = normalisation(before), normalisation(after)
    if len(before) < 4 or T_before is None or T_after is None:
        return _undetermined()
    if np.finfo(float).eps * _remoteness(T_before) * _remoteness(T_after) > LARGEST_ERROR:
        return _undetermined()
    system = _direct_linear_system(
        apply_homography(T_before, before)[0], apply_homography(T_after, after)[0]
    )
    # Only the rows of V are needed; with eight equations the ninth needs full_matrices.
    _, sizes, Vt = np.linalg.svd(system, full_matrices=len(system) < 9)
    H_normalised = Vt[8].reshape(3, 3)
    if sizes[7] <= DEGENERATE * sizes[0] or is_singular(H_normalised):
        return _undetermined()
    H = np.linalg.solve(T_after, H_normalised @ T_before)
    H = H / np.abs(H).max()
    w = before @ H[2, :2] + H[2, 2]
    H = H * math.copysign(1.0 / float(np.linalg.norm(H)), float(w.sum()))
    visible = bool((before @ H[2, :2] + H[2, 2] > 0.0).all())
    if not visible:
        return _undetermined()
    return (H / H[2, 2] if H[2, 2] > 1e-9 else H), True


def _remoteness(normalising: Floats) -> float:
    """Distance of points from the origin, in units of their spread; at least 1."""
    return 1.0 + math.hypot(normalising[0, 2], normalising[1, 2])


def _direct_linear_system(before: Floats, after: Floats) -> Floats:
    """Rows (2N, 9) of A h = 0: each pair says that x' (h₃·x) = h₁·x and y' (h₃·x) = h₂·x."""
    ones = np.column_stack([before, np.ones(len(before))])
    zero = np.zeros_like(ones)
    return np.concatenate(
        [
            np.hstack([ones, zero, -after[:, :1] * ones]),
            np.hstack([zero, ones, -after[:, 1:] * ones]),
        ]
    )


def estimate_affine(source: ArrayLike, target: ArrayLike) -> Estimate:
    """The affine map with the least sum of squared distances; (N, 2), N ≥ 3, not on one line."""
    before, after = _pairs(source, target)
    T = normalisation(before)
    if len(before) < 3 or T is None:
        return _undetermined()
    design = np.column_stack([apply_homography(T, before)[0], np.ones(len(before))])
    centre = after.mean(axis=0)
    solution, _, _, sizes = np.linalg.lstsq(design, after - centre, rcond=None)
    if sizes[-1] <= DEGENERATE * sizes[0]:
        return _undetermined()
    return affine(solution[:2].T, solution[2] + centre) @ T, True


def estimate_similarity(source: ArrayLike, target: ArrayLike) -> Estimate:
    """Rotation, scale and translation with the least squared distances (Umeyama); N ≥ 2.

    Never a reflection: for mirrored points the best rotation is returned, if it is unique.
    """
    return _procrustes(source, target, scaled=True)


def estimate_rigid(source: ArrayLike, target: ArrayLike) -> Estimate:
    """Rotation and translation with the least squared distances; (N, 2), N ≥ 2."""
    return _procrustes(source, target, scaled=False)


def _procrustes(source: ArrayLike, target: ArrayLike, *, scaled: bool) -> Estimate:
    """In the plane, the best rotation is the angle of a sum of dot and cross products."""
    before, after = _pairs(source, target)
    (a, size_before), (b, size_after) = _spread(before), _spread(after)
    dot = float((a * b).sum())
    cross = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
    spread, spread_after = float((a * a).sum()), float((b * b).sum())
    overlap = math.hypot(dot, cross)
    if not overlap > DEGENERATE * math.sqrt(spread) * math.sqrt(spread_after):
        return _undetermined()
    turn = similarity(1.0, math.atan2(cross, dot), 0.0, 0.0)[:2, :2]
    with np.errstate(over="ignore", invalid="ignore"):
        A = overlap / spread * (size_after / np.float64(size_before)) * turn if scaled else turn
        offset = after.mean(axis=0) - A @ before.mean(axis=0)
    if not (A.any() and np.isfinite(A).all() and np.isfinite(offset).all()):
        return _undetermined()
    return affine(A, offset), True


def _spread(points: Floats) -> tuple[Floats, float]:
    """Points about their mean, divided by the largest coordinate, and that coordinate.

    Their squares can then neither overflow nor vanish.
    """
    centred = points - points.mean(axis=0)
    largest = float(np.abs(centred).max())
    return centred / largest if largest > 0.0 else centred, largest


def normalisation(points: Floats) -> Floats | None:
    """The similarity that moves the centroid to 0 and the mean distance from it to √2.

    None if the points coincide, to rounding or within `SMALLEST`.
    """
    centre = points.mean(axis=0)
    distance = float(np.hypot(*(points - centre).T).mean())
    if not distance > max(1e-12 * float(np.abs(points).max()), SMALLEST):
        return None
    scale = math.sqrt(2.0) / distance
    return similarity(scale, 0.0, *(-scale * centre))


def _pairs(source: ArrayLike, target: ArrayLike) -> tuple[Floats, Floats]:
    before, after = np.asarray(source, float), np.asarray(target, float)
    if (
        before.ndim != 2
        or before.shape[1:] != (2,)
        or before.shape != after.shape
        or not len(before)
    ):
        raise ValueError(
            f"source {before.shape} and target {after.shape}; legal: both (N, 2), N at least 1"
        )
    if not (np.all(np.abs(before) <= LARGEST) and np.all(np.abs(after) <= LARGEST)):
        raise ValueError(f"source and target; legal: finite, at most {LARGEST:g} in size")
    return before, after


def _undetermined() -> Estimate:
    return np.full((3, 3), np.nan), False
