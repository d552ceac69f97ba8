"""The matrices of the square's images: one of each family, and the change by pulling a corner.

Four corners have eight coordinates. Pulling one corner uses two degrees of freedom of a family; the
remaining ones keep other corners fixed: none under a translation, the opposite one under a
similarity (and under a rigid transformation, which then can only turn), two under an affine
transformation, all three under a homography.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.geometry import transforms
from simulations.scenes._mapped_square.square import SQUARE

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
    """The matrix of a family: that of the family below it, with one more freedom in use."""
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
def way(kind: str, pull: tuple[float, float] = (0.0, 0.0)) -> Floats:
    """The matrices (101, 3, 3) of all whole amounts."""
    return pulled(kind, _unpulled_way(kind), pull)


@lru_cache(maxsize=8)
def _unpulled_way(kind: str) -> Floats:
    return np.array([transformation(kind, float(amount)) for amount in range(101)])


def pulled(kind: str, H: Floats, pull: Sequence[float]) -> Floats:
    """Matrices (..., 3, 3) like ``H`` of a family, with the image of one corner pulled away.

    The matrix stays in the family, so the corner follows as far as that allows, and those of
    `FIXED` stay fixed.
    """
    away = np.asarray(pull, float)
    return _PULLED[kind](np.asarray(H, float), away) if away.any() else H


def pulled_corner(H: Floats) -> Floats:
    """The image (..., 2) of the corner that can be pulled."""
    image = H @ _CORNERS[:, PULLED]
    return image[..., :2] / image[..., 2:]


def _moved(H: Floats, away: Floats) -> Floats:
    moved = H.copy()
    moved[..., :2, 2] += away
    return moved


def _turned(H: Floats, away: Floats) -> Floats:
    return _about_opposite(H, away, lambda factor: factor / np.abs(factor))


def _scaled(H: Floats, away: Floats) -> Floats:
    def not_too_small(factor: Floats) -> Floats:
        size = np.abs(factor)
        return factor * np.maximum(size, FLAT) / size

    return _about_opposite(H, away, not_too_small)


def _about_opposite(H: Floats, away: Floats, allowed: Callable[[Floats], Floats]) -> Floats:
    """Rotate and scale about the opposite corner's image, by a factor in the complex plane."""
    centre = (H @ _CORNERS[:, LOWER_RIGHT])[..., :2]
    arm = _complex(pulled_corner(H) - centre)
    target = arm + _complex(away)
    factor = allowed(np.where(np.abs(target) < 1e-9, 1e-9 * arm, target) / arm)
    c, s = factor.real, factor.imag
    turn = np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)
    moved = H.copy()
    moved[..., :2, :] = turn @ H[..., :2, :]
    moved[..., :2, 2] += centre - (turn @ centre[..., None])[..., 0]
    return moved


def _complex(vectors: Floats) -> Floats:
    return vectors[..., 0] + 1j * vectors[..., 1]


def _sheared(H: Floats, away: Floats) -> Floats:
    """Move each point in proportion to its height above the lower side."""
    side = SQUARE[LOWER_RIGHT] - SQUARE[LOWER_LEFT]
    along = H[..., :2, :2] @ side
    up = pulled_corner(H) - (H @ _CORNERS[:, LOWER_LEFT])[..., :2]
    area, change = _cross(along, up), _cross(along, np.broadcast_to(away, along.shape))
    share = _share_left(np.ones_like(area), 1.0 + change / area)
    height = np.array([0.0, 1.0, -SQUARE[LOWER_LEFT][1]]) / side[0]
    moved = H.copy()
    moved[..., :2, :] += (share[..., None] * away)[..., None] * height
    return moved


def _cross(a: Floats, b: Floats) -> Floats:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _tilted(H: Floats, away: Floats) -> Floats:
    """Keep the images of the other three corners and change their w, which moves the fourth.

    In homogeneous coordinates the fourth corner is the sum of its neighbours minus the opposite
    one, so that their weights in the sum determine its image.
    """
    fixed = _CORNERS[:, FIXED["projective"]] * [1.0, -1.0, 1.0]
    images = H @ fixed
    ends = np.stack([pulled_corner(H), pulled_corner(H) + away], axis=-1)
    weights = np.linalg.solve(images, np.insert(ends, 2, 1.0, axis=-2))
    rest, wanted = weights[..., 0], weights[..., 1]
    share = _share_left(rest, wanted).min(axis=-1)[..., None]
    moved = (images * (rest + share * (wanted - rest))[..., None, :]) @ np.linalg.inv(fixed)
    return moved / moved[..., 2:, 2:]


def _share_left(rest: Floats, wanted: Floats) -> Floats:
    """Largest share of the step from positive numbers to others that leaves `FLAT` of them."""
    short = wanted < FLAT * rest
    way = np.where(short, rest - wanted, 1.0)
    return np.where(short, (1.0 - FLAT) * rest / way, 1.0)


_PULLED: Mapping[str, Callable[[Floats, Floats], Floats]] = {
    "translation": _moved,
    "rigid": _turned,
    "similarity": _scaled,
    "affine": _sheared,
    "projective": _tilted,
}
