"""The inverse, the condition and the decomposition of 2D transformations.

Source: Szeliski, 2nd ed., §2.1.2; Hartley and Zisserman, Multiple View Geometry, §2.4.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats

SINGULAR = 1e12
"""Condition number from which on an inverse has hardly any digits."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Parts:
    """H = affine part · projective part, the affine one as translation · rotation · stretch."""

    tx: float
    ty: float
    angle_rad: float
    scale_x: float
    """Positive."""
    scale_y: float
    """Negative if the transformation mirrors."""
    shear: float
    """How far x moves per unit of y, before the scales."""
    vanishing: tuple[float, float]
    """h₃₁ and h₃₂ for h₃₃ = 1: zero for affine transformations."""


def condition_number(H: ArrayLike) -> float:
    """Condition number of H (3, 3), independent of units: 1 at best, ∞ if H is singular.

    The usual condition number of a translation by 1000 px is a million, although it is harmless. As
    units of length are arbitrary, they are first chosen to balance the last row and column with the
    others.
    """
    matrix = np.array(H, dtype=float)
    largest = float(np.abs(matrix).max())
    if largest == 0.0 or not np.isfinite(matrix).all():
        return math.inf
    matrix /= largest
    for _ in range(8):
        for rows in (matrix, matrix.T):
            size, last = float(np.linalg.norm(rows[:2])), float(np.linalg.norm(rows[2]))
            if size == 0.0 or last == 0.0:
                return math.inf
            rows[2] *= size / (math.sqrt(2.0) * last)
        matrix /= float(np.abs(matrix).max())
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return float(sizes[0] / sizes[2]) if sizes[2] > 1e-16 * sizes[0] else math.inf


def is_singular(H: ArrayLike) -> bool:
    """Whether H (3, 3) maps the plane to a line or a point, to rounding."""
    return condition_number(H) > SINGULAR


def invert(H: ArrayLike) -> Floats:
    """H⁻¹ with the sign that keeps w > 0. Raises `ValueError` if H is singular in any units."""
    matrix = np.asarray(H, float)
    condition = condition_number(matrix)
    if condition > SINGULAR:
        raise ValueError(f"H: condition number {condition:.3g}; legal: at most {SINGULAR:g}")
    largest = float(np.abs(matrix).max())
    with np.errstate(over="ignore"):
        inverse = np.asarray(np.linalg.inv(matrix / largest) / largest, float)
    if not np.isfinite(inverse).all():
        raise ValueError(f"H: entries up to {largest:g} only; legal: with a finite inverse")
    return inverse


def decompose(H: ArrayLike) -> Parts:
    """Translation, rotation, scales, shear and vanishing terms of a homography (3, 3).

    Raises
    ------
    ValueError
        If h₃₃ = 0, so that the origin goes to infinity, or if H is singular, where the angle or the
        shear is undefined. Also for parts beyond 1e±75, whose squares overflow.
    """
    matrix = np.array(H, dtype=float)
    legal = f"H {matrix.tolist()}; legal: invertible with h₃₃ ≠ 0, parts from 1e-75 to 1e75"
    if matrix[2, 2] == 0.0 or is_singular(matrix):
        raise ValueError(legal)
    with np.errstate(over="ignore"):
        matrix /= matrix[2, 2]
    if np.abs(matrix).max() > 1e75:
        raise ValueError(legal)
    offset, vanishing = matrix[:2, 2], matrix[2, :2]
    A = matrix[:2, :2] - np.outer(offset, vanishing)
    scale_x = math.hypot(A[0, 0], A[1, 0])
    if not 1e-75 <= scale_x <= 1e75:
        raise ValueError(legal)
    angle_rad = math.atan2(A[1, 0], A[0, 0])
    scale_y = float(np.linalg.det(A)) / scale_x
    shear = float(A[:, 0] @ A[:, 1]) / scale_x**2
    tx, ty = map(float, offset)
    return Parts(
        tx=tx,
        ty=ty,
        angle_rad=angle_rad,
        scale_x=scale_x,
        scale_y=scale_y,
        shear=shear,
        vanishing=(float(vanishing[0]), float(vanishing[1])),
    )
