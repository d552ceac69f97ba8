"""From light to a camera's raw values, and from these to colour.

Spectra are arrays (..., 81) on the grid of `simulations.models.color.spectra`. Szeliski, 2nd ed.,
section 2.3.2.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_colours, as_vectors
from simulations.models.color.spectra import WAVELENGTHS_NM, Bell, bells
from simulations.models.require import require

CAMERA: tuple[tuple[Bell, ...], ...] = (
    ((0.979, 589.8, 9.2, 39.1), (0.082, 532.4, 76.1, 19.8)),
    ((1.001, 531.1, 31.1, 40.0), (0.226, 474.7, 34.0, 10.2)),
    ((0.651, 427.7, 5.9, 55.2), (0.512, 471.5, 24.5, 26.6)),
)
"""The bell curves whose sums are the sensitivities to red, green and blue: fitted, within 0.05, to
those of a single-lens reflex camera (Nikon D5100) that the National Physical Laboratory measured
(Darrodi, Finlayson, Goodman and Mackiewicz, JOSA A 32, 2015), each with a peak of 1."""


def camera_curves(wavelengths_nm: ArrayLike) -> Floats:
    """Sensitivities (..., 3) of the camera's red, green and blue cells at wavelengths (...)."""
    return np.stack([bells(wavelengths_nm, shapes) for shapes in CAMERA], axis=-1)


def exposed(stimuli: ArrayLike, curves: ArrayLike, light: ArrayLike) -> Floats:
    """Raw values (..., 3) of spectra (..., 81), exposed so that white has a green of 1.

    Each is the sum over all wavelengths of the light times the sensitivity. ``curves`` (81, 3),
    ``light`` (81,). Raises `ValueError` if the light has no green.
    """
    spectra, source = (as_vectors("spectrum", s, WAVELENGTHS_NM.size) for s in (stimuli, light))
    sensitivity = np.asarray(curves, float)
    green = source @ sensitivity[:, 1]
    require("light of which green sees", green, 0 < green < np.inf, "above 0, finite")
    return spectra @ sensitivity / green


def fit_colour_matrix(balanced: ArrayLike, xyz: ArrayLike, white_xyz: ArrayLike) -> Floats:
    """The (3, 3) matrix from balanced raw values to XYZ with the least squared error on some
    patches.

    White, (1, 1, 1), is mapped to ``white_xyz`` exactly.

    Parameters
    ----------
    balanced, xyz : (N, 3)
        Colours of the same patches; at least two, which differ in colour and not in brightness
        alone.
    white_xyz : (3,)

    Raises
    ------
    ValueError
        For patches that do not determine the matrix.
    """
    known, wanted = as_colours(balanced), as_colours(xyz)
    white = np.asarray(white_xyz, float)
    # With rows that sum to the white, two columns are free: the weights of the differences to blue.
    differences = known[:, :2] - known[:, 2:]
    if np.linalg.matrix_rank(differences, tol=1e-9) < 2:
        raise ValueError(f"{len(known)} patches of too few colours; legal: two hues or more")
    free = np.linalg.lstsq(differences, wanted - known[:, 2:] * white, rcond=None)[0]
    return np.column_stack([free[0], free[1], white - free[0] - free[1]])
