"""Lengths in a plane and heights above it, from one picture and one known length.

The plane is at right angles to one of the axes of a `single_view.SingleView`: the floor, or a wall.
Its place is not known, so lengths are in units of the camera's distance from it, which one known
length turns into metres.

Source: Criminisi, Reid and Zisserman, Single view metrology, IJCV 40, 2000.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_matrices
from simulations.models.projection.level_ground import height_by_horizon
from simulations.models.projection.single_view import STEPS, SingleView, numerical_derivatives
from simulations.models.projection.vanishing_lines import check_sigma
from simulations.models.require import require, require_one_of, require_positive

KINDS = ("within", "above")


@dataclass(frozen=True, slots=True)
class Stretch:
    """A length, drawn by its two ends."""

    ends: Floats
    """(2, 2) pixels; of a height the foot, which is in the plane, and the top."""
    kind: str = "within"
    """``within`` the plane, or ``above`` it, at right angles."""

    def __post_init__(self) -> None:
        require_one_of("kind", self.kind, KINDS)


@dataclass(frozen=True, slots=True)
class Measured:
    """Lengths in metres with their standard errors; NaN for one beyond the plane's horizon."""

    metres: Floats
    """(N,)"""
    errors: Floats
    """(N,)"""
    distance: float
    """Distance of the camera from the plane, metres; its height, if that is the floor."""
    distance_error: float


def measured(
    view: SingleView,
    known: Stretch,
    known_metres: float,
    others: tuple[Stretch, ...],
    sigma_px: float = 1.0,
    *,
    normal: int = 2,
) -> Measured:
    """The other lengths, from the one that is known.

    Parameters
    ----------
    view : the camera.
    known : a length of ``known_metres``, which counts as exact; its ends do not.
    others : what is measured.
    sigma_px : standard deviation of an end in x and in y; with the camera's covariance it decides
        the standard errors: of logarithms, to first order; those of the lengths are a quarter of
        the longer side of the interval of four.
    normal : the axis at right angles to the plane: 2 for the floor.

    Raises `ValueError` if the known length has no length, is beyond the plane's horizon, or a
    number is not legal.
    """
    require_positive("known_metres", known_metres)
    check_sigma(sigma_px)
    require("normal", normal, normal in (0, 1, 2), "0, 1, 2")
    stretches = (known, *others)
    ends = as_matrices("ends", np.stack([stretch.ends for stretch in stretches]), 2, 2)
    kinds = [stretch.kind for stretch in stretches]
    found = lengths(view, ends, kinds, normal)
    require("known length", found[0], found[0] > 0.0, "with two ends, before the plane's horizon")
    unit = view.diagonal

    def by_view(step: Floats) -> Floats:
        return np.log(lengths(view.moved(step), ends, kinds, normal))

    def by_ends(step: Floats) -> Floats:  # the same step at every stretch
        return np.log(lengths(view, ends + unit * step.reshape(2, 2), kinds, normal))

    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        through_view = numerical_derivatives(by_view, STEPS, view.covariance)
        variance = (numerical_derivatives(by_ends, 4) ** 2).sum(axis=-1) * (sigma_px / unit) ** 2
        apart = np.vstack([through_view[1:], np.zeros(STEPS)]) - through_view[0]
        relative = np.einsum("ni,ij,nj->n", apart, view.covariance, apart)
        relative += np.append(variance[1:], 0.0) + variance[0]
        metres = known_metres * np.append(found[1:], 1.0) / found[0]
        errors = metres * 0.25 * np.expm1(4.0 * np.sqrt(relative))
    return Measured(metres[:-1], errors[:-1], float(metres[-1]), float(errors[-1]))


def lengths(view: SingleView, ends: ArrayLike, kinds: list[str], normal: int = 2) -> Floats:
    """Lengths (N,) of stretches by their ends (N, 2, 2), in distances of the camera from the plane.

    NaN for one that is beyond the plane's horizon, seen from the first.
    """
    places = view.lens.straight(as_matrices("ends", ends, 2, 2))
    axis = view.normal(normal)
    rays = np.concatenate([places, np.ones((*places.shape[:-1], 1))], axis=-1)
    rays = rays @ np.linalg.inv(view.K).T
    towards = rays @ axis
    before = -towards if towards[0, 0] <= 0.0 else towards  # on the first stretch's side of it
    with np.errstate(divide="ignore", invalid="ignore"):
        points = rays / np.where(before > 0.0, before, np.nan)[..., None]
    within = np.linalg.norm(points[:, 1] - points[:, 0], axis=-1)
    horizon = np.linalg.solve(view.K.T, axis)
    above, _ = height_by_horizon(places[:, 0], places[:, 1], horizon, view.K @ axis)
    above = np.where(before[:, 0] > 0.0, np.abs(above), np.nan)
    return np.where(np.array(kinds) == "above", above, within)
