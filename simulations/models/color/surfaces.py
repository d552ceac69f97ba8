"""Reflectances of surfaces: measured ones, a dyed cloth, and twins that match in one light only.

A reflectance is an array (..., 81) on the grid of `spectra`: the share of each wavelength that the
surface sends back, from 0 to 1.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_vectors
from simulations.models.color.observer import tristimulus
from simulations.models.color.spectra import WAVELENGTHS_NM, bell, through_knots
from simulations.models.require import require

CHART: Mapping[str, tuple[float, ...]] = {
    "dark-skin": (
        0.048, 0.068, 0.059, 0.053, 0.054, 0.062, 0.074, 0.082, 0.115,
        0.142, 0.163, 0.196, 0.242, 0.294, 0.372, 0.450, 0.421,
    ),
    "light-skin": (
        0.103, 0.192, 0.205, 0.231, 0.282, 0.310, 0.298, 0.298, 0.358,
        0.514, 0.564, 0.597, 0.652, 0.728, 0.783, 0.794, 0.734,
    ),
    "sky": (
        0.113, 0.300, 0.337, 0.327, 0.293, 0.251, 0.208, 0.188, 0.163,
        0.147, 0.130, 0.115, 0.105, 0.102, 0.102, 0.106, 0.120,
    ),
    "foliage": (
        0.048, 0.049, 0.052, 0.060, 0.067, 0.088, 0.181, 0.147, 0.122,
        0.100, 0.100, 0.095, 0.125, 0.283, 0.358, 0.364, 0.341,
    ),
    "orange": (
        0.053, 0.054, 0.052, 0.052, 0.055, 0.064, 0.120, 0.260, 0.452,
        0.543, 0.578, 0.602, 0.615, 0.630, 0.637, 0.636, 0.582,
    ),
    "purple": (
        0.101, 0.191, 0.190, 0.132, 0.086, 0.063, 0.054, 0.054, 0.052,
        0.065, 0.126, 0.182, 0.248, 0.338, 0.422, 0.481, 0.467,
    ),
    "blue": (
        0.069, 0.156, 0.244, 0.342, 0.239, 0.101, 0.054, 0.044, 0.040,
        0.039, 0.041, 0.043, 0.044, 0.050, 0.064, 0.120, 0.204,
    ),
    "green": (
        0.055, 0.058, 0.062, 0.074, 0.113, 0.208, 0.363, 0.303, 0.196,
        0.111, 0.084, 0.076, 0.078, 0.089, 0.089, 0.106, 0.112,
    ),
    "red": (
        0.052, 0.051, 0.049, 0.048, 0.045, 0.044, 0.044, 0.048, 0.072,
        0.256, 0.598, 0.694, 0.718, 0.730, 0.729, 0.724, 0.664,
    ),
    "yellow": (
        0.054, 0.053, 0.053, 0.056, 0.121, 0.351, 0.544, 0.645, 0.708,
        0.742, 0.761, 0.779, 0.785, 0.792, 0.792, 0.780, 0.710,
    ),
    "white": (
        0.153, 0.536, 0.878, 0.886, 0.888, 0.887, 0.887, 0.887, 0.887,
        0.888, 0.891, 0.889, 0.888, 0.887, 0.885, 0.882, 0.879,
    ),
}  # fmt: skip
"""Eleven patches of the colour chart of McCamy, Marcus and Davidson (1976), every 25 nm from 380,
after the measurements of N. Ohta (1997). A spline through these is within 0.3 ΔE of them."""

LEAST, MOST = 0.08, 0.85
"""Reflectance of a dyed cloth for light that the dye absorbs, and for light that it reflects."""
INKS_NM = (450.0, 540.0, 610.0)
INK_WIDTH_NM = 25.0
"""Peaks of the three bands from which twins are mixed, and their standard deviation."""


def chart_patch(name: str) -> Floats:
    """Reflectance (81,) of a patch of `CHART`."""
    return through_knots(CHART[name])


def dyed_cloth(band_nm: float, width_nm: float) -> Floats:
    """Reflectance (81,) of a cloth that sends back one band: a bell on a dark ground.

    Its standard deviation is at least that of a step of the grid, or the band falls between two.
    """
    require("width_nm", width_nm, 5.0 <= width_nm < np.inf, "5 or more, finite")
    return LEAST + (MOST - LEAST) * bell(WAVELENGTHS_NM, band_nm, width_nm, width_nm)


def metameric_twins(reflectances: ArrayLike, light: ArrayLike) -> Floats:
    """Other reflectances (..., 81) that look just the same as these in one light.

    Mix each colour from three narrow inks: the three amounts that match its X, Y and Z solve a
    linear system. The difference of the mixture to the original is a *metameric black*, which the
    eye cannot see, so any share of it can be added. The share is the largest, up to 1, for which
    the twin stays between 0 and 1 at every wavelength.

    Wyszecki and Stiles, 2nd ed., section 3.8.4. Raises `ValueError` for reflectances outside [0,
    1].
    """
    originals = as_vectors("reflectance", reflectances, WAVELENGTHS_NM.size)
    inside = bool(np.all((originals >= 0.0) & (originals <= 1.0)))
    require("reflectance", "outside [0, 1]", inside, "0 to 1")
    inks = np.stack([bell(WAVELENGTHS_NM, peak, INK_WIDTH_NM, INK_WIDTH_NM) for peak in INKS_NM])
    source = as_vectors("light", light, WAVELENGTHS_NM.size)
    wanted, of_inks = (tristimulus(each * source, source) for each in (originals, inks))
    black = wanted @ np.linalg.inv(of_inks) @ inks - originals
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(black > 0, (1.0 - originals) / black, -originals / black)
    room = np.where(black == 0, np.inf, room)
    share = np.minimum(room.min(axis=-1, keepdims=True), 1.0)
    return np.clip(originals + share * black, 0.0, 1.0)
