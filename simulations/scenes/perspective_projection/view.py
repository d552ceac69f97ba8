"""The point and its house, and the camera of the figure, from perspective to orthography.

Full perspective has its centre at depth 0. From there the centre moves back while the focal length
grows, so that the plane at `REFERENCE_DEPTH_M` keeps its size in the picture: a dolly zoom. With
the centre at infinity, the rays are parallel: scaled orthography.

The point is the front lower left corner of a small house that moves with it and shows the division
by depth.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.models.arrays import Floats, Mask
from simulations.models.projection.affine_cameras import project_affine, scaled_orthographic_camera
from simulations.models.projection.pinhole import intrinsics, project

HALF_WIDTH_PX, HALF_HEIGHT_PX = 100.0, 75.0
"""Half the picture, in pixels from the principal point."""
METRES_PER_PX = 0.03  # size of a pixel of the image plane, as drawn
REFERENCE_DEPTH_M = 5.0
"""Depth of the plane whose image is the same in perspective and in orthography."""

WIDTH_M, DEPTH_M, EAVES_M, RIDGE_M = 3.0, 4.0, 2.0, 3.2  # of the house
NEAR_M = 0.2
"""Parts nearer than this to the plane of the centre are not drawn: their image is too far off."""


@dataclass(frozen=True, slots=True)
class Camera:
    """The camera between perspective and orthography."""

    focal_px: float
    """Focal length of full perspective."""
    perspective: float
    """1 is full perspective, 0 orthography: the depth of the reference plane over its distance from
    the centre."""

    @property
    def parallel(self) -> bool:
        """Whether the rays are parallel."""
        return self.perspective == 0.0

    @property
    def centre_m(self) -> float:
        """Depth of the centre, 0 or negative; −∞ for parallel rays."""
        if self.parallel:
            return -math.inf
        return REFERENCE_DEPTH_M - REFERENCE_DEPTH_M / self.perspective

    @property
    def plane_m(self) -> float:
        """Depth of the image plane; −∞ for parallel rays."""
        if self.parallel:
            return -math.inf
        return self.centre_m + self.focal_px * METRES_PER_PX / self.perspective

    def project(self, points: Floats) -> tuple[Floats, Mask]:
        """Pixels (..., 2) from the principal point of points (..., 3), and which have one."""
        if self.parallel:
            K = intrinsics(self.focal_px, (0.0, 0.0))
            return project_affine(points, scaled_orthographic_camera(K, REFERENCE_DEPTH_M))
        K = intrinsics(self.focal_px / self.perspective, (0.0, 0.0))
        return project(points - np.array([0.0, 0.0, self.centre_m]), K)

    def size_at(self, Z: float) -> float:
        """Pixels per metre at a depth; infinite at the centre itself."""
        if self.centre_m == Z:
            return math.inf
        per_m = self.focal_px / REFERENCE_DEPTH_M
        return per_m / (1.0 + self.perspective * (Z / REFERENCE_DEPTH_M - 1.0))


@dataclass(frozen=True, slots=True)
class Projection:
    """A point, the camera, and the point's image."""

    X: float
    """Metres to the right."""
    Y: float
    """Metres down."""
    Z: float
    """Metres along the optical axis from the centre of full perspective."""
    camera: Camera
    x: float
    """Pixels right of the principal point; NaN where there is no image."""
    y: float
    """Pixels below the principal point; NaN where there is no image."""
    visible: bool
    """Whether the point has an image."""

    @property
    def full(self) -> bool:
        """Whether the camera is full perspective."""
        return self.camera.perspective == 1.0

    @property
    def in_picture(self) -> bool:
        """Whether the image falls within the edges of the picture."""
        return self.visible and in_picture(self.x, self.y)

    @property
    def formula_only(self) -> tuple[float, float]:
        """x = f X / Z, also for points behind the camera; Z must not be 0."""
        return self.camera.focal_px * self.X / self.Z, self.camera.focal_px * self.Y / self.Z

    @property
    def off_px(self) -> float:
        """Pixels from the image in full perspective; Z must be positive."""
        x, y = self.formula_only
        return math.hypot(self.x - x, self.y - y)


def in_picture(x: float, y: float) -> bool:
    """Whether pixel (x, y), counted from the principal point, lies in the picture."""
    return abs(x) <= HALF_WIDTH_PX and abs(y) <= HALF_HEIGHT_PX


def projection_of(X: float, Y: float, Z: float, camera: Camera) -> Projection:
    """Project the point (X, Y, Z). Depth is rounded to the millimetre, so that Z = 0 is exact."""
    Z = round(Z, 3)
    pixels, valid = camera.project(np.array([X, Y, Z]))
    return Projection(X, Y, Z, camera, float(pixels[0]), float(pixels[1]), bool(valid))


def _face(*corners: tuple[float, float, float]) -> Floats:
    """Corners (n, 3) of a face from the point: X, height above the ground, depth. Y points down."""
    return np.array(corners) * (1.0, -1.0, 1.0)


def _rectangle(left: float, right: float, low: float, high: float) -> Floats:
    """A rectangle in the front wall."""
    return _face((left, low, 0), (left, high, 0), (right, high, 0), (right, low, 0))


_GABLE = [(0, 0), (0, EAVES_M), (WIDTH_M / 2, RIDGE_M), (WIDTH_M, EAVES_M), (WIDTH_M, 0)]
_FRONT, _BACK = ([(x, up, depth) for x, up in _GABLE] for depth in (0.0, DEPTH_M))
# Corners run clockwise as seen from outside.
FACES = (
    (_face(*_FRONT), 1),
    (_face(*reversed(_BACK)), 4),
    (_face(_BACK[0], _BACK[1], _FRONT[1], _FRONT[0]), 3),
    (_face(_FRONT[4], _FRONT[3], _BACK[3], _BACK[4]), 4),
    (_face(_FRONT[1], _BACK[1], _BACK[2], _FRONT[2]), 4),
    (_face(_FRONT[2], _BACK[2], _BACK[3], _FRONT[3]), 6),
)
"""The walls and the two sides of the roof, each with its layers of colour: more, where darker."""
OPENINGS = ((_rectangle(0.45, 1.2, 0.0, 1.45), 5), (_rectangle(1.75, 2.5, 0.7, 1.45), 3))
"""Door and window, in the front wall."""


def house(view: Projection, place: Floats, units_per_px: float) -> str:
    """SVG markup of the house; ``place`` is the principal point in the view box."""
    corner = np.array([view.X, view.Y, view.Z])

    def seen(face: Floats) -> Floats:
        return units_per_px * _image(view.camera, face + corner) + place

    parts: list[str] = []
    outer = [(seen(face), washes) for face, washes in FACES]
    # Walls seen from inside lie behind those seen from outside.
    for outside in (False, True):
        for n, (places, washes) in enumerate(outer):
            if len(places) > 2 and (_area(places) > 0.0) == outside:
                parts += _painted(places, washes)
                if n == 0 and outside:
                    parts += [
                        part for face, more in OPENINGS for part in _painted(seen(face), more)
                    ]
    return "".join(parts)


def outline(view: Projection, camera: Camera, place: Floats, units_per_px: float) -> str:
    """SVG markup of the walls and the roof that another camera sees from outside."""
    corner = np.array([view.X, view.Y, view.Z])
    seen = [_image(camera, face + corner) for face, _ in FACES]
    return "".join(
        drawing.polygon(units_per_px * pixels + place, "error thin dashed fill")
        for pixels in seen
        if len(pixels) > 2 and _area(pixels) > 0.0
    )


def _painted(places: Floats, washes: int) -> Iterator[str]:
    """A face in the colour of paper, then in layers of the colour of the world."""
    if len(places) > 2:
        yield drawing.polygon(places, "casing solid")
        yield drawing.polygon(places, "world thin fill") * washes


def _area(places: Floats) -> float:
    """Twice the signed area of a polygon (n, 2); positive for clockwise on the page."""
    x, y = places.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _image(camera: Camera, face: Floats) -> Floats:
    """The image (n, 2) of the part of a face that is in front of the camera."""
    nearest = camera.centre_m + NEAR_M
    kept: list[Floats] = []
    for before, here in zip(np.roll(face, 1, axis=0), face, strict=True):
        if (before[2] < nearest) != (here[2] < nearest):
            kept.append(before + (nearest - before[2]) / (here[2] - before[2]) * (here - before))
        if here[2] >= nearest:
            kept.append(here)
    return camera.project(np.array(kept))[0] if kept else np.empty((0, 2))
