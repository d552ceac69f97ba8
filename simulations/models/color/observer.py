"""From a spectrum to XYZ: the CIE's standard observer of 1931.

Spectra are arrays (..., 81) on the grid of `spectra`. The three curves are the analytic fits of
Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions",
Journal of Computer Graphics Techniques 2(2), 2013. Szeliski, 2nd ed., section 2.3.2.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_vectors
from simulations.models.color.spectra import WAVELENGTHS_NM, Bell, bells
from simulations.models.require import require

MATCHING: tuple[tuple[Bell, ...], ...] = (
    ((1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)),
    ((0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)),
    ((1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)),
)
"""The bell curves whose sums are x̄, ȳ and z̄."""


def matching_functions(wavelengths_nm: ArrayLike) -> Floats:
    """x̄, ȳ and z̄ (..., 3) at wavelengths (...): how much of X, Y and Z matches a pure colour.

    Within 0.03 of the tabulated curves, whose peaks are 1.06, 1.00 and 1.78. Beyond 650 nm, where
    all three are small, their ratios are those of the fit and not of the eye.
    """
    return np.stack([bells(wavelengths_nm, shapes) for shapes in MATCHING], axis=-1)


OBSERVER = matching_functions(WAVELENGTHS_NM)
"""(81, 3) on the grid."""


def tristimulus(stimuli: ArrayLike, light: ArrayLike) -> Floats:
    """CIE XYZ (..., 3) of spectra (..., 81) that reach the eye; white has Y = 1.

    Parameters
    ----------
    stimuli : (..., 81) what surfaces send back, or the light itself.
    light : (81,) what a white surface, which sends back everything, would send.

    Raises `ValueError` for a light that the eye does not see.
    """
    spectra, source = (as_vectors("spectrum", s, WAVELENGTHS_NM.size) for s in (stimuli, light))
    white = source @ OBSERVER[:, 1]
    require("light of luminance", white, bool(0 < white < np.inf), "above 0, finite")
    return spectra @ OBSERVER / white
