"""The matrices of the square's images: one of each family, and the change by pulling a corner.

Four corners have eight coordinates. Pulling one corner uses two degrees of freedom of a family; the
remaining ones keep other corners fixed: none under a translation, the opposite one under a
similarity (and under a rigid transformation, which then can only turn), two under an affine
transformation, all three under a homography.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.geometry import transforms

HALF = 40.0  # half the side of the square, which is centred on the origin
SQUARE = np.array([(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)])
LOWER_LEFT, LOWER_RIGHT, UPPER_RIGHT, PULLED = range(4)
"""Indices of corners of the square. No transformation here maps the upper left one to infinity."""
FIXED: Mapping[str, tuple[int, ...]] = {
    "translation": (),
    "rigid": (LOWER_RIGHT,),
    "similarity": (LOWER_RIGHT,),
    "affine": (LOWER_LEFT, LOWER_RIGHT),
    "projective": (LOWER_LEFT, LOWER_RIGHT, UPPER_RIGHT),
}
"""The corners whose images stay fixed while one is pulled."""
FLAT = 0.05
"""Least size of the image after a pull, as a share of its area or scale: at 0 it could not be
pulled back."""

_CORNERS = np.vstack([SQUARE.T, np.ones(4)])


def transformation(kind: str, amount: float) -> Floats:
    """The matrix of a family: the matrix of the family below it, with one more freedom in use."""
    tx, ty = amount, amount / 2.0
    if kind == "translation":
        return transforms.translation(tx, ty)
    angle_rad = math.radians(amount / 2.0)
    if kind == "rigid":
        return transforms.rigid(angle_rad, tx, ty)
    H = transforms.similarity(1.0 + amount / 200.0, angle_rad, tx, ty)
    if kind == "similarity":
        return H
    shear = [[1.0 + amount / 500.0, amount / 250.0], [0.0, 1.0 - amount / 300.0]]
    H = H @ transforms.affine(shear, (0.0, 0.0))
    if kind == "affine":
        return H
    tilt = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-amount / 10000.0, amount / 3000.0, 1.0]]
    return transforms.projective(H @ tilt)


@lru_cache(maxsize=8)
def matrices_of_amounts(kind: str) -> Floats:
    """The matrices (101, 3, 3) of all whole amounts."""
    return np.array([transformation(kind, float(amount)) for amount in range(101)])


def with_moved_corner(kind: str, H: Floats, pull: Sequence[float]) -> Floats:
    """The matrix (3, 3) ``H`` of a family, with the image of one corner pulled away.

    The matrix stays in the family, so the corner follows as far as that allows, and those of
    `FIXED` stay fixed.
    """
    away = np.asarray(pull, float)
    if not away.any():
        return H
    if kind == "translation":
        return transforms.translation(*away) @ H
    if kind == "affine":
        return _sheared(H, away)
    if kind == "projective":
        return _tilted(H, away)
    return _turned(H, away, rigid=kind == "rigid")


def pulled_corner(H: Floats) -> Floats:
    """The image (2,) of the corner that can be pulled."""
    image = H @ _CORNERS[:, PULLED]
    return image[:2] / image[2]


def _turned(H: Floats, away: Floats, *, rigid: bool) -> Floats:
    """Rotate and scale about the opposite corner's image, by a factor in the complex plane."""
    centre = (H @ _CORNERS[:, LOWER_RIGHT])[:2]
    arm, step = complex(*(pulled_corner(H) - centre)), complex(*away)
    target = arm + step if abs(arm + step) >= 1e-9 else 1e-9 * arm
    factor = target / arm
    factor *= (1.0 if rigid else max(abs(factor), FLAT)) / abs(factor)
    c, s = factor.real, factor.imag
    turn = np.array([(c, -s), (s, c)])
    moved = H.copy()
    moved[:2] = turn @ H[:2]
    moved[:2, 2] += centre - turn @ centre
    return moved


def _sheared(H: Floats, away: Floats) -> Floats:
    """Move each point in proportion to its height above the lower side."""
    side = SQUARE[LOWER_RIGHT] - SQUARE[LOWER_LEFT]
    along = H[:2, :2] @ side
    up = pulled_corner(H) - (H @ _CORNERS[:, LOWER_LEFT])[:2]
    area, change = (along[0] * v[1] - along[1] * v[0] for v in (up, away))
    share = _share_left(np.ones(1), np.array([1.0 + change / area]))
    height = np.array([0.0, 1.0, -SQUARE[LOWER_LEFT][1]]) / side[0]
    moved = H.copy()
    moved[:2] += share * np.outer(away, height)
    return moved


def _tilted(H: Floats, away: Floats) -> Floats:
    """Keep the images of the other three corners and change their w, which moves the fourth.

    In homogeneous coordinates the fourth corner is the sum of its neighbours minus the opposite
    one, so that their weights in the sum determine its image.
    """
    fixed = _CORNERS[:, FIXED["projective"]] * [1.0, -1.0, 1.0]
    images = H @ fixed
    ends = np.stack([pulled_corner(H), pulled_corner(H) + away], axis=-1)
    rest, target = np.linalg.solve(images, np.insert(ends, 2, 1.0, axis=0)).T
    weights = rest + _share_left(rest, target) * (target - rest)
    moved = (images * weights) @ np.linalg.inv(fixed)
    return np.asarray(moved / moved[2, 2])


def _share_left(rest: Floats, target: Floats) -> float:
    """Largest share of the step from positive numbers to others that leaves `FLAT` of them."""
    short = target < FLAT * rest
    step = np.where(short, rest - target, 1.0)
    return float(np.where(short, (1.0 - FLAT) * rest / step, 1.0).min())
