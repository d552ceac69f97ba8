"""A pinhole instead of a lens: its image of a distant point.

Far behind the hole the light of a point forms a spot as wide as the hole, with blurred rims; a
narrow hole spreads it by diffraction. Both follow from one formula: a hole acts like a perfect lens
focused at infinity whose defocus is as large as its focal length. Paraxial, for incoherent light
and a scene far away.

Source: Goodman, Introduction to Fourier Optics, 3rd ed., 2005, §§ 4.2 and 6.4; Young, Pinhole
optics, 1971.
"""

import math

from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.lens.diffraction import (
    MOST_WAVES,
    defocus_waves,
    lens_transfer,
    spot_diameter_um,
)
from simulations.models.require import require, require_positive


def pinhole_transfer(
    frequency_per_mm: ArrayLike, hole_mm: float, distance_mm: float, wavelength_um: float
) -> Floats:
    """Transfer factor (...) at frequencies (...) in cycles/mm, on a wall behind the hole.

    ``hole_mm`` is the hole's diameter, ``distance_mm`` its distance from the wall. Where the factor
    is negative, dark and light are exchanged. Raises `ValueError` for holes so wide that
    `simulations.models.lens.diffraction.MOST_WAVES` are exceeded: 2.3 mm in a box 100 mm deep.
    """
    require_positive("hole_mm", hole_mm)
    require("distance_mm", distance_mm, 0 < distance_mm <= 1e300, "above 0, to 1e300")
    f_number = float(distance_mm) / float(hole_mm)
    waves = defocus_waves(1000.0 * distance_mm, wavelength_um, f_number)
    require("hole_mm", hole_mm, waves <= MOST_WAVES, f"at most {MOST_WAVES:g} waves of defocus")
    return lens_transfer(frequency_per_mm, wavelength_um, f_number, 1000.0 * distance_mm)


def spread_mm(hole_mm: float, distance_mm: float, wavelength_um: float) -> float:
    """Width of the spot of a very narrow hole: 2.44 λ z_s / A, of Airy's disc."""
    require_positive("hole_mm", hole_mm)
    return spot_diameter_um(wavelength_um, float(distance_mm) / float(hole_mm)) / 1000.0


def sharpest_hole_mm(distance_mm: float, wavelength_um: float) -> float:
    """The diameter of a hole that is as wide as its diffraction spot: √(2.44 λ z_s)."""
    return math.sqrt(spread_mm(1.0, distance_mm, wavelength_um))
