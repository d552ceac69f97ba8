"""Chromatic aberration at the middle wavelength of each channel."""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.lens.chromatic_aberration import axial_chromatic_mm, lateral_chromatic_scale
from simulations.scenes.lens_aberrations.spectrum import LINES_UM
from simulations.scenes.lens_aberrations.stages import FOCAL_MM, GLASSES, PITCH_MM

CORNER_PX = 200.0
"""Distance from the centre to the corners."""


@dataclass(frozen=True, slots=True)
class Colours:
    """Aberrations at the middle of each channel; three entries for red, green, blue."""

    scale: Floats
    """Size of the image relative to the green one."""
    disc_px: Floats
    """Diameter of the disc that a point becomes."""


def colours(glass: str, stop_mm: float, f_number: float) -> Colours:
    """Lateral and axial chromatic aberration of the lens at the three lines."""
    kind, lines = GLASSES[glass], np.array(LINES_UM)
    return Colours(
        lateral_chromatic_scale(kind, FOCAL_MM, stop_mm, lines),
        axial_chromatic_mm(kind, FOCAL_MM, f_number, lines) / PITCH_MM,
    )


def shifts_px(glass: str, stop_mm: float) -> Floats:
    """Outward shift of the corner in red, green and blue, relative to green."""
    lines = np.array(LINES_UM)
    scale = lateral_chromatic_scale(GLASSES[glass], FOCAL_MM, stop_mm, lines)
    return CORNER_PX * (scale - 1.0)
