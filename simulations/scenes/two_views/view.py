"""A lamp, two cameras, its two images, and the uncertainty of its depth."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import intrinsics, project
from simulations.models.projection.two_views import (
    depth_of_match,
    epipolar_lines,
    fundamental_matrix,
)
from simulations.scenes.two_views.settings import Settings

HALF_WIDTH_PX, HALF_HEIGHT_PX = 100.0, 75.0
"""Half of each picture, in pixels from the principal point."""
EYE_M = 1.5
"""Height of both cameras above the floor."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two equal cameras; the right one is rotated about its vertical axis, towards the left
    one's."""

    focal_px: float
    baseline: float
    """Metres."""
    toe_in_rad: float
    K: Floats
    """Focal length of both; pixels are relative to the principal point."""
    R: Floats
    """From the left camera's frame to the right one's, and ..."""
    t: Floats
    """... the left camera's place in that frame, metres."""

    def line(self, left: Floats) -> Floats:
        """The epipolar line (3,) of a pixel of the left picture, a² + b² = 1."""
        F = fundamental_matrix(self.K, self.K, self.R, self.t)
        return epipolar_lines(F, left)[0]

    def right(self, point: Floats) -> Floats:
        """Pixels (..., 2) of points (..., 3) of the left camera's frame; NaN behind the camera."""
        return project(point @ self.R.T + self.t, self.K)[0]

    def vanishing(self, left: Floats) -> Floats:
        """The right camera's image of the end of a left pixel's ray."""
        return project(self.R @ [*(left / self.focal_px), 1.0], self.K)[0]

    def depth(self, left: Floats, right: Floats) -> float:
        """Depth of a left pixel with its match; ∞ also if the match is beyond infinity."""
        depth, valid = depth_of_match(left, right, self.K, self.K, self.R, self.t)
        return float(depth) if valid else math.inf


@dataclass(frozen=True, slots=True)
class View:
    """The lamp in both pictures."""

    pair: Pair
    depth: float
    """Depth in metres from the left camera."""
    left: Floats
    right: Floats
    line: Floats
    nearest: float
    """The least depth that a match with its error may mean, metres ..."""
    farthest: float
    """... and the largest, which may be ∞."""
    matches: Floats
    """(2, 2) the match at those depths: on the epipolar line, the error to either side."""

    @property
    def point(self) -> Floats:
        """Place in the left camera's frame, metres."""
        return self.at(self.depth)

    @property
    def disparity(self) -> float:
        return float(self.left[0] - self.right[0])

    def at(self, depth: float) -> Floats:
        """Point of the left pixel's ray at a depth."""
        return np.array([*(self.left / self.pair.focal_px), 1.0]) * depth


def pair_of(settings: Settings) -> Pair:
    angle = math.radians(settings.toe_in)
    cos, sin = math.cos(angle), math.sin(angle)
    R = np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
    return Pair(
        focal_px=settings.focal_length,
        baseline=settings.baseline,
        toe_in_rad=angle,
        K=intrinsics(settings.focal_length, (0.0, 0.0)),
        R=R,
        t=R @ np.array([-settings.baseline, 0.0, 0.0]),
    )


def view_of(settings: Settings) -> View:
    """The view at these settings."""
    pair, left = pair_of(settings), np.array([settings.left_x, -settings.left_up])
    ray = np.array([*(left / pair.focal_px), 1.0])
    right = pair.right(ray * settings.depth)
    line = pair.line(left)
    towards_near = np.array([line[1], -line[0]])
    towards_near *= math.copysign(1.0, float(towards_near @ (right - pair.vanishing(left))))
    off = settings.matching_error * towards_near
    matches = np.array([right + off, right - off])
    near, far = (pair.depth(left, match) for match in matches)
    return View(pair, settings.depth, left, right, line, near, far, matches)


def in_picture(pixel: Floats) -> bool:
    """Whether a pixel lies within the edges of a picture."""
    return bool(abs(pixel[0]) <= HALF_WIDTH_PX and abs(pixel[1]) <= HALF_HEIGHT_PX)
