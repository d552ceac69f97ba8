"""Space on a drawing board: points in three dimensions, seen in parallel projection."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.projection.affine_cameras import orthographic_camera, project_affine
from simulations.models.projection.pinhole import look_at


@dataclass(frozen=True, slots=True)
class Space:
    """A view of space whose parallels stay parallel."""

    camera: Floats
    """(3, 4), from points to view box units."""

    def at(self, *point: float) -> tuple[float, float]:
        """One point in view box units."""
        x, y = self.all([point])[0]
        return float(x), float(y)

    def all(self, points: ArrayLike) -> Floats:
        """Points (n, 3) in view box units (n, 2)."""
        return project_affine(points, self.camera)[0]


def seen_from(
    direction: ArrayLike,
    scale: float,
    origin: tuple[float, float],
    up: ArrayLike = (0.0, 0.0, 1.0),
) -> Space:
    """The view from ``direction``, ``scale`` units for a length of 1, the origin at ``origin``."""
    pose = look_at(np.asarray(direction, float), (0.0, 0.0, 0.0), up)
    return Space(orthographic_camera(scale, origin) @ pose)
