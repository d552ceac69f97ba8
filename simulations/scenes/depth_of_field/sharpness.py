"""The depth of field of a thin lens, and its blur of the still life."""

from dataclasses import dataclass

import numpy as np

from simulations.models.lens import thin_lens
from simulations.pictures.still_life.things import THINGS, WALL_DISTANCE, thing_depth
from simulations.scenes._still_life_camera.rays import PITCH_MM

NEAR_M, FAR_M = thing_depth(THINGS[0]), WALL_DISTANCE
"""The red ball in front and the wall behind: the two ends of the still life."""


@dataclass(frozen=True, slots=True)
class Sharpness:
    """Sharpness and blur of the still life at one setting; lengths in millimetres."""

    aperture_mm: float
    """Diameter of the opening."""
    image_mm: float
    """Distance from the lens to the sensor."""
    near_blur_mm: float
    """Disc of the red ball on the sensor."""
    far_blur_mm: float
    """Disc of the wall."""
    near_limit_m: float
    """Nearest distance whose disc is at most a pixel."""
    far_limit_m: float
    """Farthest; ∞ from the hyperfocal distance on."""


def sharpness(focal_mm: float, f_number: float, focus_m: float) -> Sharpness:
    """Raises ValueError for a focus at the focal length or nearer, which has no real image."""
    focus_mm = 1000 * focus_m
    blur = thin_lens.circle_of_confusion_mm(
        focal_mm, f_number, focus_mm, np.array([1000 * NEAR_M, 1000 * FAR_M])
    )
    limits = thin_lens.depth_of_field(focal_mm, f_number, focus_mm, PITCH_MM)
    return Sharpness(
        focal_mm / f_number,
        float(thin_lens.thin_lens_image_distance(focal_mm, focus_mm)),
        float(blur[0]),
        float(blur[1]),
        limits[0] / 1000,
        limits[1] / 1000,
    )
