"""A view: projects three-dimensional points to the panel, with their depth.

    VIEW = orbit(30, 20, centre=(200, 150), unit=90)  # parallels stay parallel
    NEAR = orbit(30, 20, centre=(200, 150), unit=90, distance=5)  # what is near is larger

    arrow(VIEW.at(0, 0, 0), VIEW.at(1, 0, 0), "world")

`orbit.turning` is the handle with which a reader turns such a view.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Points = NDArray[np.floating]

NEAREST = 0.05
"""Share of the eye's distance. Points closer to the eye than this, or behind it, are not seen."""
EDGE_ON = 1e-3
"""Least visible share of a plane's area for which places on it are computed."""
UP = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class View:
    """A view of a point of the world from a direction."""

    axes: Points
    """(3, 3) rows: right, down and away, unit vectors of the world."""
    centre: tuple[float, float] = (0.0, 0.0)
    """The place of the target in the view box."""
    unit: float = 1.0
    """View box units for a length of 1 at the target."""
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The point that the eye looks at."""
    distance: float = math.inf
    """Distance from the eye to the target; at infinity the projection is parallel."""

    def place(self, points: ArrayLike) -> Points:
        """Points (..., 3) in the panel: view box x, y, and the depth behind the target.

        x and y are NaN for points too near to the eye, or behind it.
        """
        camera_points = (np.asarray(points, float) - self.target) @ self.axes.T
        depth = camera_points[..., 2:]
        flat = camera_points[..., :2]
        if math.isfinite(self.distance):
            before = self.distance + depth
            visible = before >= NEAREST * self.distance
            flat = np.where(visible, flat * self.distance / np.where(visible, before, 1.0), np.nan)
        return np.concatenate([flat * self.unit + self.centre, depth], axis=-1)

    def all(self, points: ArrayLike) -> Points:
        """Points (..., 3) in view box units (..., 2)."""
        return self.place(points)[..., :2]

    def at(self, *point: float) -> tuple[float, float]:
        """One point in view box units."""
        x, y = self.all(point).tolist()
        return x, y

    def on_plane(
        self, place: Sequence[float], point: ArrayLike, directions: ArrayLike
    ) -> tuple[float, float] | None:
        """The coordinates of a place of the view box in a plane, in parallel projection; None if
        the plane is seen on its edge. It leads through a point (3,) in two directions (2, 3)."""
        across = self.unit * (np.asarray(directions, float) @ self.axes[:2].T).T
        if abs(float(np.linalg.det(across))) < EDGE_ON * self.unit**2:
            return None
        u, v = np.linalg.solve(across, np.asarray(place, float) - self.all(point)).tolist()
        return u, v


def axes_towards(direction: ArrayLike) -> Points:
    """Axes (3, 3) of a view along a direction that is not parallel to `UP`, which stays upright."""
    away = -_unit(np.asarray(direction, float))
    right = np.cross(away, UP)
    if not np.linalg.norm(right) > 1e-12:
        raise ValueError("a vertical direction; legal: any other direction")
    right = _unit(right)
    return np.stack([right, np.cross(away, right), away])


def _unit(vector: Points) -> Points:
    length = float(np.linalg.norm(vector))
    if not 0.0 < length < math.inf:
        raise ValueError(f"direction {vector.tolist()}; legal: three numbers, not all 0")
    return vector / length


def orbit(
    azimuth_deg: float,
    elevation_deg: float,
    *,
    centre: tuple[float, float] = (0.0, 0.0),
    unit: float = 1.0,
    distance: float = math.inf,
) -> View:
    """A view from a direction in degrees, z up: the azimuth from x towards y, and the elevation.

    Seen straight from above or below, x points down or up in the panel.
    """
    axes = orbit_axes(azimuth_deg, elevation_deg)
    return View(axes, centre, unit, distance=distance)


def orbit_axes(azimuth_deg: float, elevation_deg: float, *, z_down: bool = False) -> Points:
    """The axes (3, 3) of `orbit`'s view, also straight down. ``z_down`` is for a world whose z
    points to the ground, as in aviation."""
    turn, rise = math.radians(azimuth_deg), math.radians(elevation_deg)
    sign = -1.0 if z_down else 1.0
    ahead, aside = math.cos(turn), math.sin(turn)
    right = (-sign * aside, sign * ahead, 0.0)
    down = (math.sin(rise) * ahead, math.sin(rise) * aside, -sign * math.cos(rise))
    away = (-math.cos(rise) * ahead, -math.cos(rise) * aside, -sign * math.sin(rise))
    return np.array([right, down, away])


def runs(places: Points, *, front: bool) -> list[list[list[float]]]:
    """Connected runs of the segments of a curve whose middle is in front of the target, or behind.

    ``places`` (n, 3) hold view box x, y and depth, as `View.place` gives them.
    """
    rows, depths = places[:, :2].tolist(), places[:, 2]
    here = ((depths[:-1] + depths[1:]) <= 0) == front
    here &= np.isfinite(places[:-1, 0]) & np.isfinite(places[1:, 0])
    found: list[list[list[float]]] = []
    for index in np.flatnonzero(here).tolist():
        if found and index > 0 and here[index - 1]:
            found[-1].append(rows[index + 1])
        else:
            found.append([rows[index], rows[index + 1]])
    return found
