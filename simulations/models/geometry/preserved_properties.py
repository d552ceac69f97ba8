"""Which properties of a figure a 2D transformation preserves, measured on examples.

The five measures are the last column of Szeliski, 2nd ed., table 2.1: they are all zero for a
translation, and every more general transformation changes one more.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography, clip_to_visible

PARALLEL = 1e-9
"""Sine of the angle below which two lines of the original count as parallel."""


@dataclass(frozen=True, slots=True)
class Preservation:
    """The largest change of each property over a figure; zero if it is preserved."""

    turn_rad: float
    """Orientation: angle between a line and its image."""
    length: float
    """Lengths: |L′/L − 1|; infinite if the figure reaches the line that is mapped to infinity."""
    angle_rad: float
    """Angles: change of the angle between two lines, regardless of its sense."""
    parallel_rad: float
    """Parallelism: angle between the images of two parallel lines."""
    bend: float
    """Straightness: distance of the image from its chord, as a share of the chord."""


def measure_preservation(H: ArrayLike, segments: ArrayLike) -> Preservation:
    """Compare line segments (N, 2, 2) with their images under H, as far as they are visible.

    The visible side is that of the origin, of the line that H maps to infinity.

    Raises
    ------
    ValueError
        If fewer than two segments are visible, or a segment or its image is a single point.
    """
    before = visible = np.asarray(segments, float)
    ends = before.reshape(-1, 2)
    if not np.array_equal(clip_to_visible(H, ends, closed=False), ends):  # slow, one by one
        pieces = [clip_to_visible(H, segment, closed=False) for segment in before]
        visible = np.array([piece for piece in pieces if len(piece) == 2])
    if len(visible) < 2:
        raise ValueError(f"segments: {len(visible)} of {len(before)} visible; legal: 2 or more")
    images, _ = apply_homography(H, _sample(visible))
    chords, chords_image = visible[:, 1] - visible[:, 0], images[:, -1] - images[:, 0]
    if not chords_image.any(axis=1).all():  # the image of a point is one
        raise ValueError("segments; legal: longer than a point, also in the image")
    directions, lengths = _unit(chords)
    directions_image, lengths_image = _unit(chords_image)
    whole = len(visible) == len(before) and np.allclose(visible, before)
    between, between_image = _angles(directions), _angles(directions_image)
    parallel = np.sin(between) < PARALLEL
    return Preservation(
        turn_rad=float(_angle(directions, directions_image).max()),
        length=float(np.abs(lengths_image / lengths - 1.0).max()) if whole else math.inf,
        angle_rad=float(np.abs(between_image - between).max()),
        parallel_rad=float(np.abs(between_image - between)[parallel].max()),
        bend=_bend(images, directions_image, lengths_image),
    )


def _sample(segments: Floats, count: int = 9) -> Floats:
    """Points (N, count, 2) spread evenly over segments (N, 2, 2), both ends included."""
    share = np.linspace(0.0, 1.0, count)[:, None]
    return segments[:, None, 0] * (1.0 - share) + segments[:, None, 1] * share


def _unit(vectors: Floats) -> tuple[Floats, Floats]:
    lengths = np.hypot(vectors[:, 0], vectors[:, 1])
    return vectors / lengths[:, None], lengths


def _angle(a: Floats, b: Floats) -> Floats:
    """Angle in [0, π] between vectors; through atan2, which is exact for small angles too."""
    cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return np.arctan2(np.abs(cross), (a * b).sum(axis=-1))


def _angles(directions: Floats) -> Floats:
    """Angles (N, N) between all pairs."""
    return _angle(directions[:, None], directions[None, :])


def _bend(images: Floats, directions: Floats, lengths: Floats) -> float:
    offset = images - images[:, :1]
    distance = offset[..., 0] * directions[:, None, 1] - offset[..., 1] * directions[:, None, 0]
    return float((np.abs(distance).max(axis=1) / lengths).max())
