"""A camera from one picture: its focal length and its turn from lines along three axes.

The axes are at right angles to each other: 0 to the right and 1 away, in the floor, and 2 upwards.
The camera has square pixels. Its principal point is the middle of the picture, or is found too. Of
a calibrated lens focal length and principal point are known, with their errors.

All lines are fitted together: the axes' vanishing points are the columns of K R, so right angles
hold by construction; that of the axes 0 and 1 only within an error, if walls may be off square. Two
directions and a fixed principal point leave nothing over, and the result is
f² = −(v₁ − c)·(v₂ − c) with the vanishing points of `vanishing_lines.fit_vanishing_point`, but for
`FOREKNOWN`.

Camera frame and pixels as in `simulations.models.projection.pinhole`, axes of the world as in
`simulations.models.projection.level_ground`.

Source: Hartley and Zisserman, Multiple View Geometry, 2nd ed., §8.6, §8.8; Criminisi, Reid and
Zisserman, Single view metrology, IJCV 40, 2000.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_array, as_matrices
from simulations.models.geometry.rotations import exponential, nearest_rotation
from simulations.models.least_squares import levenberg_marquardt
from simulations.models.projection.picture_lens import IDEAL, PictureLens
from simulations.models.projection.pinhole import intrinsics
from simulations.models.projection.vanishing_lines import (
    check_segments,
    check_sigma,
    fit_vanishing_point,
    line_residuals,
)
from simulations.models.require import require

SHORTEST, LONGEST = 0.1, 20.0
"""Focal lengths that there are, in diagonals of the picture."""
STARTS = (0.3, 0.6, 1.2, 2.4, 5.0)
"""Lengths at which the search starts where no two vanishing points give one."""
FOREKNOWN = 1.0
"""Standard deviation of ln f before any line is drawn, about the diagonal: most cameras lie within
a factor of seven of it. Where the lines tell f to 1 %, this changes it by less than 0.01 %; where
they leave it open, it stays at a length that there is, with a large error."""
BEND = 1e-6
"""Step of k₁ over which derivatives are taken."""
STEPS = 8
"""Numbers of a step of the camera, see `SingleView.moved`."""
UNKNOWN = 1e-6
"""Information on other unknowns that counts as none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SingleView:
    """A camera, as one picture tells it."""

    focal_px: float
    centre: tuple[float, float]
    """The principal point, in pixels."""
    R: Floats
    """(3, 3) turn from the axes to the camera frame: in its columns, the axes."""
    diagonal: float
    """Diagonal of the picture, in pixels."""
    covariance: Floats
    """(8, 8) of a step, see `moved`; zero for what is fixed or known."""
    lean: float = 0.0
    """Radians by which the angle between the axes 0 and 1 is less than a right one."""
    misfit: float = 0.0
    """Sum of the squared residuals in units of σ²: about `spare` if the lines fit."""
    spare: int = 0
    """Lines less unknowns."""
    lens: PictureLens = IDEAL
    """Its distortion; all else is about the picture that an ideal lens would make."""

    @property
    def K(self) -> Floats:  # noqa: N802, as in the formulae
        return intrinsics(self.focal_px, self.centre)

    @property
    def axes(self) -> Floats:
        """(3, 3) unit vectors along the three axes in the camera frame, in its columns."""
        c, s = math.cos(0.5 * self.lean), math.sin(0.5 * self.lean)
        return self.R @ np.array([[c, s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def normal(self, axis: int) -> Floats:
        """(3,) unit vector at right angles to the other two axes, on the side of this one."""
        across = np.linalg.inv(self.axes)[axis]
        return np.asarray(across / np.linalg.norm(across))

    @property
    def vanishing(self) -> Floats:
        """(3, 3) the vanishing points of the three axes, homogeneous, one a row."""
        return np.asarray((self.K @ self.axes).T)

    @property
    def vanishing_covariances(self) -> Floats:
        """(3, 3, 3) covariances of their homogeneous coordinates; see `pixel_of`."""
        J = _points_by_step(self)
        return np.asarray(J @ self.covariance @ np.swapaxes(J, 1, 2))

    @property
    def pitch(self) -> float:
        """Angle of the camera's axis below the horizontal, radians."""
        x, y, z = self.R[:, 2]
        return math.atan2(-z, math.hypot(x, y))

    @property
    def roll(self) -> float:
        """Lean to the right, radians."""
        x, y, _ = self.R[:, 2]
        return math.atan2(-x, -y)

    def moved(self, step: Floats) -> "SingleView":
        """The camera after a step (8,) of ln f, of a turn in radians, of the principal point in
        diagonals, of the lens's k₁, and of the lean in radians."""
        growth = float(np.clip(step[0], -0.5, 0.5))
        low, high = (share * self.diagonal for share in (SHORTEST, LONGEST))
        return replace(
            self,
            focal_px=min(max(self.focal_px * math.exp(growth), low), high),
            R=exponential(step[1:4]) @ self.R,
            centre=(
                self.centre[0] + float(step[4]) * self.diagonal,
                self.centre[1] + float(step[5]) * self.diagonal,
            ),
            lens=self.lens.moved(float(step[6])) if step[6] else self.lens,
            lean=self.lean + float(step[7]),
        )

    def spread(self, quantity: Callable[["SingleView"], Floats | float]) -> Floats:
        """Standard errors (...) of numbers that the camera determines, to first order."""
        covariance = self.covariance
        J = numerical_derivatives(lambda s: np.asarray(quantity(self.moved(s))), STEPS, covariance)
        return np.sqrt(np.einsum("...i,ij,...j->...", J, covariance, J))


def fit_view(
    segments: ArrayLike,
    axes: ArrayLike,
    size: tuple[float, float],
    sigma_px: float = 1.0,
    *,
    find_centre: bool = False,
    lens: PictureLens = IDEAL,
    off_square: float = 0.0,
) -> SingleView:
    """The likeliest camera for lines along the axes.

    Parameters
    ----------
    segments : (N, 2, 2) the ends of the lines, in pixels.
    axes : (N,) 0, 1 or 2: the axis along which each runs. Two of them need two or more lines each.
    size : width and height of the picture, in pixels.
    sigma_px : standard deviation of an end in x and in y.
    find_centre : whether to find the principal point as well; else it is the picture's middle.
    lens : what is known of its distortion. If k₁ has an error, it is found too. A calibrated lens
        has a focal length and a principal point, which the lines may move within their errors.
    off_square : standard deviation of the angle between the axes 0 and 1, in radians.

    Returns
    -------
    The camera, with large variances of what the lines do not determine.

    Raises
    ------
    ValueError
        For an axis that is none, fewer than two axes with two lines or more, axes that vanish in
        one point, and what `fit_vanishing_point` refuses.
    """
    ends = as_matrices("segments", segments, 2, 2)
    along = as_array("axes", axes, len(ends)).astype(int)
    require("axes", along, bool(np.isin(along, (0, 1, 2)).all()), "0, 1, 2")
    check_sigma(sigma_px)
    check_segments(ends)
    counts = np.bincount(along, minlength=3)
    require("lines along the axes", counts, (counts >= 2).sum() >= 2, "two for two axes")
    diagonal = math.hypot(*size)
    middle = ((size[0] - 1.0) / 2.0, (size[1] - 1.0) / 2.0)
    foreknown, focal_error, centre_error = diagonal, FOREKNOWN, 0.0
    if lens.pinhole_errors:
        middle, foreknown = lens.centre, math.sqrt(lens.unit[0] * lens.unit[1])
        focal_error, centre_error = lens.pinhole_errors
    points = {
        int(axis): fit_vanishing_point(lens.straight(ends[along == axis]))[0]
        for axis in np.flatnonzero(counts >= 2)
    }
    free = [*range(6 if find_centre or centre_error else 4), *([6] if lens.error else [])]
    free += [7] if off_square else []

    along_each = ends[:, 1] - ends[:, 0]
    across = np.stack([-along_each[:, 1], along_each[:, 0]], axis=1)
    across = (across / np.hypot(*along_each.T)[:, None])[:, None, :]

    def misses(lens: PictureLens, points: Floats) -> tuple[Floats, Floats]:
        """In pixels of the picture."""
        if not lens.error:
            return line_residuals(lens.straight(ends), points)
        straight, growth = lens.straight_with_growth(ends, across)
        r, by_point = line_residuals(straight, points)
        scale = growth.mean(axis=1)
        return r / scale, by_point / scale[:, None]

    def residuals(view: SingleView) -> tuple[Floats, Floats]:
        r, by_point = misses(view.lens, view.vanishing[along])
        J = _by_step(view, along, by_point)
        known = [math.log(view.focal_px / foreknown) / focal_error]
        by_known = [np.eye(1, STEPS)[0] / focal_error]
        if centre_error:
            known += [(view.centre[k] - middle[k]) / centre_error for k in range(2)]
            by_known += [*np.eye(2, STEPS, 4) * diagonal / centre_error]
        if lens.error:
            J[:, 6] = (misses(view.lens.moved(BEND), view.vanishing[along])[0] - r) / BEND
            known.append((view.lens.distortion.k1 - lens.distortion.k1) / lens.error)
            by_known.append(np.eye(1, STEPS, 6)[0] / lens.error)
        if off_square:
            known.append(view.lean / off_square)
            by_known.append(np.eye(1, STEPS, 7)[0] / off_square)
        return np.append(r / sigma_px, known), np.vstack([J / sigma_px, by_known])[:, free]

    def moved(view: SingleView, step: Floats) -> SingleView:
        whole = np.zeros(STEPS)
        whole[free] = step
        return view.moved(whole)

    starts = [
        SingleView(
            focal_px=focal,
            centre=middle,
            R=_turn(points, focal, middle),
            diagonal=diagonal,
            covariance=np.zeros((STEPS, STEPS)),
            lens=lens,
        )
        for focal in (
            [foreknown] if lens.pinhole_errors else _focal_lengths(points, middle, diagonal)
        )
    ]
    start = min(starts, key=lambda view: float((residuals(view)[0] ** 2).sum()))
    found = _upright(levenberg_marquardt(residuals, moved, start))
    r, J = residuals(found)
    misfit = float(r[: len(ends)] @ r[: len(ends)])
    covariance = np.zeros((STEPS, STEPS))
    covariance[np.ix_(free, free)] = _covariance(J)
    # What is known of k₁, of walls, and of a calibrated lens, counts for as many lines.
    spare = (
        len(ends)
        - len(free)
        + bool(lens.error)
        + bool(off_square)
        + bool(lens.pinhole_errors)
        + 2 * bool(centre_error)
    )
    return replace(found, covariance=covariance, misfit=misfit, spare=spare)


def focal_from_pair(first: ArrayLike, second: ArrayLike, centre: ArrayLike) -> float:
    """f = √(−(v₁ − c)·(v₂ − c)) of two directions at right angles, in pixels.

    Parameters
    ----------
    first, second : (3,) homogeneous vanishing points.
    centre : (2,) the principal point.

    Returns
    -------
    f : infinite if a point is at infinity, NaN if no camera sees a right angle between the two.
    """
    (x, y, w), (u, v, t) = as_array("first", first, 3), as_array("second", second, 3)
    cx, cy = as_array("centre", centre, 2)
    product = -((x - w * cx) * (u - t * cx) + (y - w * cy) * (v - t * cy))
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.sqrt(np.float64(product) / (w * t)))


def numerical_derivatives(
    function: Callable[[Floats], Floats], count: int, covariance: Floats | None = None
) -> Floats:
    """Derivatives (..., count) of a function of ``count`` numbers where all are 0.

    They are central differences over steps of 10⁻⁵, so the numbers must be scaled such that this is
    small and the function smooth. Those without variance, if it is given, are left at 0.
    """
    steps = 1e-5 * np.eye(count)
    free = range(count) if covariance is None else np.flatnonzero(np.diag(covariance))
    J = np.zeros((*np.shape(function(steps[0])), count))
    for at in free:
        J[..., at] = (function(steps[at]) - function(-steps[at])) / 2e-5
    return J


def _by_step(view: SingleView, along: Floats, by_point: Floats) -> Floats:
    """Derivatives (N, 8) of the residuals by a step of the camera, from those by the points."""
    return np.asarray(np.einsum("ni,nij->nj", by_point, _points_by_step(view)[along]))


def _points_by_step(view: SingleView) -> Floats:
    """Derivatives (3, 3, 8) of the vanishing points by a step of the camera.

    v = K d, so dv = f (d₁, d₂, 0) d ln f + K (ω × d) + d₃ (dc, 0) + K d′ with the direction d.
    """
    J = np.zeros((3, 3, STEPS))
    c, s = 0.5 * math.cos(0.5 * view.lean), 0.5 * math.sin(0.5 * view.lean)
    J[:2, :, 7] = (view.K @ view.R @ np.array([[-s, c], [c, -s], [0.0, 0.0]])).T
    for axis, (x, y, z) in enumerate(view.axes.T.tolist()):
        direction = np.array([x, y, z])
        J[axis, :2, 0] = view.focal_px * direction[:2]
        J[axis, :, 1:4] = view.K @ np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
        J[axis, :2, 4:6] = view.diagonal * direction[2] * np.eye(2)
    return J


def _covariance(J: Floats) -> Floats:
    """(JᵀJ)⁻¹, with a large variance in place of an infinite one."""
    information, axes = np.linalg.eigh(J.T @ J)
    return np.asarray((axes / np.maximum(information, UNKNOWN)) @ axes.T)


def _focal_lengths(
    points: dict[int, Floats], centre: tuple[float, float], diagonal: float
) -> list[float]:
    """Where the search may start: at the pairs' closed forms, else at some fixed ones."""
    pairs = [(a, b) for a in points for b in points if a < b]
    closed = [focal_from_pair(points[a], points[b], centre) for a, b in pairs]
    low, high = SHORTEST * diagonal, LONGEST * diagonal
    return [f for f in closed if low < f < high] or [share * diagonal for share in STARTS]


def _turn(points: dict[int, Floats], focal: float, centre: tuple[float, float]) -> Floats:
    """The turn whose axes come nearest to the rays of the vanishing points."""
    rays = {axis: np.linalg.solve(intrinsics(focal, centre), v) for axis, v in points.items()}
    units = {axis: ray / np.linalg.norm(ray) for axis, ray in rays.items()}
    for axis in {0, 1, 2} - units.keys():
        units[axis] = np.cross(units[(axis + 1) % 3], units[(axis + 2) % 3])
    columns = np.column_stack([units[axis] for axis in range(3)])
    if np.linalg.det(columns) < 0.0:
        columns[:, 0] *= -1.0
    sizes = np.linalg.svd(columns, compute_uv=False)
    require("axes", sorted(points), sizes[1] > 1e-6, "with vanishing points that are apart")
    return nearest_rotation(columns)


def _upright(view: SingleView) -> SingleView:
    """The same with its third axis upwards in the picture and its second away from the camera.

    d and −d vanish in one point, so the lines alone do not tell them apart.
    """
    up, away, lean = view.R[:, 2], view.R[:, 1], view.lean
    if up[1] > 0.0:
        up, lean = -up, -lean  # one of the axes 0 and 1 turns back with it
    away = -away if away[2] < 0.0 else away
    return replace(view, R=np.column_stack([np.cross(away, up), away, up]), lean=lean)
