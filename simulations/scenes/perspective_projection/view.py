"""The point and the three cameras of the projection figure."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import format_number
from simulations.models.arrays import Floats, Mask
from simulations.models.projection.affine_cameras import (
    orthographic_camera,
    project_affine,
    scaled_orthographic_camera,
)
from simulations.models.projection.pinhole import intrinsics, project

PERSPECTIVE, SCALED, PARALLEL = "perspective", "scaled-orthographic", "orthographic"
"""The cameras: through a centre; along the axis to a plane, then through the centre; along it."""

HALF_WIDTH_PX, HALF_HEIGHT_PX = 100.0, 75.0
"""Half the picture, in pixels from the principal point."""
METRES_PER_PX = 0.03
"""Size of a pixel of the image plane, as drawn and for parallel rays."""
REFERENCE_DEPTH_M = 5.0
"""The depth by which scaled orthography divides."""


@dataclass(frozen=True, slots=True)
class Camera:
    """One of the three cameras."""

    label: str
    project: Callable[[Floats, Floats], tuple[Floats, Mask]]
    """Maps a point of the camera frame and K to its pixel, and whether it has one."""


def _scaled(point: Floats, K: Floats) -> tuple[Floats, Mask]:
    return project_affine(point, scaled_orthographic_camera(K, REFERENCE_DEPTH_M))


def _parallel(point: Floats, _K: Floats) -> tuple[Floats, Mask]:
    return project_affine(point, orthographic_camera(1.0 / METRES_PER_PX))


CAMERAS: Mapping[str, Camera] = {
    PERSPECTIVE: Camera("Perspective", project),
    SCALED: Camera("Scaled orthography", _scaled),
    PARALLEL: Camera("Orthography", _parallel),
}


@dataclass(frozen=True, slots=True)
class View:
    """A point in the camera frame and its image."""

    X: float
    """Metres to the right."""
    Y: float
    """Metres down."""
    Z: float
    """Metres along the optical axis; negative behind the camera."""
    focal_px: float
    x: float
    """Pixels right of the principal point; NaN where there is no image."""
    y: float
    """Pixels below the principal point; NaN where there is no image."""
    visible: bool
    """Whether the point has an image; for the camera with a centre, whether it is in front."""
    camera: str
    """One of `CAMERAS`."""

    @property
    def in_picture(self) -> bool:
        """Whether the image falls within the edges of the picture."""
        return self.visible and in_picture(self.x, self.y)

    @property
    def formula_only(self) -> tuple[float, float]:
        """x = f X / Z, also for points behind the camera; Z must not be 0."""
        return self.focal_px * self.X / self.Z, self.focal_px * self.Y / self.Z

    @property
    def scale(self) -> float:
        """Pixels per metre of the cameras with parallel rays."""
        return self.focal_px / REFERENCE_DEPTH_M if self.camera == SCALED else 1.0 / METRES_PER_PX


def in_picture(x: float, y: float) -> bool:
    """Whether pixel (x, y), counted from the principal point, lies in the picture."""
    return abs(x) <= HALF_WIDTH_PX and abs(y) <= HALF_HEIGHT_PX


def metres(value: float) -> str:
    """A length to the decimetre, or to the centimetre if needed."""
    return format_number(value, 1 if abs(10.0 * value - round(10.0 * value)) < 1e-6 else 2)


def view_of_point(X: float, Y: float, Z: float, focal_px: float, camera: str) -> View:
    """Project the point (X, Y, Z) with the principal point at (0, 0).

    Depth is rounded to the millimetre, so that Z = 0 is exact.
    """
    Z = round(Z, 3)
    point, K = np.array([X, Y, Z]), intrinsics(focal_px, (0.0, 0.0))
    pixels, valid = CAMERAS[camera].project(point, K)
    return View(X, Y, Z, focal_px, float(pixels[0]), float(pixels[1]), bool(valid), camera)
