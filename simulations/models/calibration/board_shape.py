"""The shape of the board: how far its corners lie from those of a flat one with square squares.

Paper curls, card sags, and printers scale. All photographs show the same board, so its shape is
one more thing that they share, and is estimated with the camera. A corner at (u, v) squares lies at

    P(u, v) = (u, v, 0) + Σ cₖ eₖ (u − u₀)ⁱ (v − v₀)ʲ / hⁱ⁺ʲ

with eₖ one of the three axes, (u₀, v₀) the middle of the board and h half its longer side. A shift,
a turn and a change of size are no shape, and their terms are left out: 1, u and v along z, 1 along
x and y, and two of the four linear terms in the plane. What is left of those is the ratio of the
sides of a square, and how far it is from a rectangle.

A board of constant curvature looks the same from any of its corners, but for its pose. So the terms
of second degree along z bear photographs that show parts of a board, or whose columns are counted
from the other end. K. H. Strobl and G. Hirzinger, *More accurate pinhole camera calibration with
imperfect planar target*, 2011, free every corner instead.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.views import Views

type Term = tuple[int, int, int]
"""Axis, and the powers of u and v."""

_CURVED = ((2, 2, 0), (2, 1, 1), (2, 0, 2))
_HIGHER = tuple((n - j, j) for n in (3, 4) for j in range(n + 1))

SHAPES: Mapping[str, tuple[Term, ...]] = MappingProxyType(
    {
        "flat": (),
        "bent": (*_CURVED, (1, 0, 1)),
        "warped": (
            *_CURVED,
            *((2, i, j) for i, j in _HIGHER),
            (1, 0, 1),
            (0, 0, 1),
            *((axis, i, j) for axis in (0, 1) for i, j in ((2, 0), (1, 1), (0, 2), *_HIGHER)),
        ),
    }
)
"""The models of the board, from simple to rich: bent alike everywhere, with squares of any ratio of
sides; and any smooth shape, to the fourth degree."""


@dataclass(frozen=True, slots=True)
class Shape:
    """The coefficients of some terms."""

    terms: tuple[Term, ...] = ()
    values: tuple[float, ...] = ()
    """In squares."""
    middle: tuple[float, float] = (0.0, 0.0)
    reach: float = 1.0
    """(u₀, v₀) and h, in squares."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of the coefficients, as x01 and z20."""
        return tuple(f"{'xyz'[axis]}{i}{j}" for axis, i, j in self.terms)

    def moved(self, step: Floats) -> "Shape":
        """After a step (K) of the coefficients."""
        return replace(self, values=tuple((np.array(self.values) + step).tolist()))

    def powers(self, board: Floats) -> Floats:
        """(..., K) what each term multiplies, at corners (..., 2)."""
        u, v = np.moveaxis((board - self.middle) / self.reach, -1, 0)
        return np.stack([u**i * v**j for _, i, j in self.terms], axis=-1)

    def points(self, board: Floats) -> Floats:
        """(..., 3) of corners (..., 2)."""
        points = np.zeros((*board.shape[:-1], 3))
        points[..., :2] = board
        if self.terms:
            moved = self.powers(board) * self.values
            for index, (axis, _, _) in enumerate(self.terms):
                points[..., axis] += moved[..., index]
        return points

    def coefficient_derivatives(self, board: Floats, by_point: Floats) -> Floats:
        """(P, 2, N, K) derivatives by the coefficients, from those (P, 2, N, 3) by the points of
        corners (P, N, 2)."""
        axes = [axis for axis, _, _ in self.terms]
        slopes: Floats = by_point[..., axes] * self.powers(board)[:, None]
        return slopes

    @property
    def aspect(self) -> float:
        """Height of a square by its width."""
        return 1.0 + dict(zip(self.names, self.values, strict=True)).get("y01", 0.0) / self.reach


FLAT = Shape()


def flat_shape(name: str, views: Views) -> Shape:
    """The flat board as a start for one of `SHAPES`."""
    far = views.board[views.found].max(axis=0)
    terms = SHAPES[name]
    middle = (float(far[0]) / 2, float(far[1]) / 2)
    return Shape(terms, (0.0,) * len(terms), middle, float(far.max()) / 2)


def corners_numbered_alike(views: Views) -> bool:
    """Whether all photographs count as many columns and rows, so that they number corners alike."""
    far = np.where(views.found[..., None], views.board, 0.0).max(axis=1)
    return bool((far == far[0]).all())
