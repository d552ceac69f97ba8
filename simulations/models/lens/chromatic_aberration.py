"""Chromatic aberration of a thin lens: glass bends blue more than red.

Wavelengths in micrometres, lengths in millimetres. Szeliski, 2nd ed., §2.2.3.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require

LINE_F_UM, LINE_D_UM, LINE_C_UM = 0.4861, 0.5876, 0.6563
"""Fraunhofer lines: blue hydrogen, yellow helium, red hydrogen."""

SHORTEST_UM = 0.1
"""Shortest legal wavelength: glass is opaque long before."""

SHORTEST_FOCAL_MM, LONGEST_FOCAL_MM = 1e-9, 1e12
"""Range of focal lengths within which reciprocals and products stay finite."""


@dataclass(frozen=True, slots=True)
class Glass:
    """Glass by its catalogue numbers, with an index by Cauchy's law ``n = A + B/λ²``."""

    index_d: float = 1.5168
    """Refractive index at the d line; the default is the common crown BK7."""
    abbe_number: float = 64.2
    """(n_d − 1) / (n_F − n_C): a large number is little dispersion, inf none."""

    def __post_init__(self) -> None:
        require("index_d", self.index_d, 1.0 < self.index_d <= 10.0, "above 1, to 10")
        require("abbe_number", self.abbe_number, self.abbe_number >= 1.0, "1 or more (inf: none)")


def refractive_index(glass: Glass, wavelength_um: ArrayLike) -> Floats:
    """Index at wavelengths (...); meets n_d and the Abbe number exactly."""
    wavelength = np.asarray(wavelength_um, float)
    if not np.all(wavelength >= SHORTEST_UM):
        raise ValueError(f"wavelength_um {float(np.min(wavelength))}; legal: {SHORTEST_UM} or more")
    dispersion = (glass.index_d - 1.0) / glass.abbe_number
    b = dispersion / (LINE_F_UM**-2 - LINE_C_UM**-2)
    return glass.index_d + b * (wavelength**-2 - LINE_D_UM**-2)


def focal_length_mm(glass: Glass, focal_d_mm: float, wavelength_um: ArrayLike) -> Floats:
    """Focal length at each wavelength of a thin lens that has ``focal_d_mm`` at the d line."""
    require(
        "focal_d_mm",
        focal_d_mm,
        SHORTEST_FOCAL_MM <= focal_d_mm <= LONGEST_FOCAL_MM,
        f"{SHORTEST_FOCAL_MM:g} to {LONGEST_FOCAL_MM:g}",
    )
    power = (refractive_index(glass, wavelength_um) - 1.0) / (glass.index_d - 1.0)
    return focal_d_mm / power


def axial_chromatic_mm(
    glass: Glass, focal_d_mm: float, f_number: float, wavelength_um: ArrayLike
) -> Floats:
    """Blur diameter of a distant point at each wavelength, on a sensor focused for the d line.

    ``A |f_d − f(λ)| / f(λ)`` with aperture A = f_d/N; a pinhole (N = inf) has none.
    """
    require("f_number", f_number, f_number > 0.0, "above 0 (inf is a pinhole)")
    focal = focal_length_mm(glass, focal_d_mm, wavelength_um)
    with np.errstate(over="ignore"):
        return np.abs(focal_d_mm - focal) / focal * focal_d_mm / f_number


def lateral_chromatic_scale(
    glass: Glass, focal_d_mm: float, stop_distance_mm: float, wavelength_um: ArrayLike
) -> Floats:
    """Size of a distant object's image at each wavelength, relative to the d line.

    With the stop at distance t in front of the lens, the chief rays meet the glass off its centre
    and are deviated by dispersion: ``1 + t (1/F_d − 1/F(λ))``. With the stop in the lens (t = 0)
    every colour has the same scale.
    """
    require(
        "stop_distance_mm",
        stop_distance_mm,
        abs(stop_distance_mm) <= LONGEST_FOCAL_MM,
        f"at most {LONGEST_FOCAL_MM:g} in size",
    )
    focal = focal_length_mm(glass, focal_d_mm, wavelength_um)
    return 1.0 + stop_distance_mm * (1.0 / focal_d_mm - 1.0 / focal)
