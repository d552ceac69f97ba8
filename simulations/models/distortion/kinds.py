"""The kind of a distortion, and how far it bows straight lines."""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_vectors
from simulations.models.distortion import radial_profile
from simulations.models.distortion.lens_model import FAR, Distortion, fold_radius
from simulations.models.require import require

KINDS = ("none", "barrel", "pincushion", "moustache")


def classify(d: Distortion, corner_radius: float, tolerance: float) -> str:
    """The kind of a radial distortion, from its profile over the picture and not from one sign.

    If the magnification ``g(r) = f(r) / r`` falls all the way from the axis to the corner, it is a
    barrel; if it rises, a pincushion; if it does both, a moustache.

    Parameters
    ----------
    d : Distortion
        Only its radial part counts.
    corner_radius : float
        Normalised radius of the picture's corners; the part past a fold is ignored.
    tolerance : float
        Changes of g up to this are ignored: a fraction, for displacements of ``tolerance · r``.

    Returns
    -------
    One of `KINDS`.
    """
    require("corner_radius", corner_radius, 0.0 <= corner_radius <= FAR, f"0 to {FAR:g}")
    radius = np.linspace(0.0, min(corner_radius, fold_radius(d)), 257)
    change = np.diff(radial_profile.scale(d.radial, radius * radius))
    rises = float(np.maximum(change, 0.0).sum()) > tolerance
    falls = float(np.maximum(-change, 0.0).sum()) > tolerance
    return KINDS[falls + 2 * rises]


def line_bow(points: ArrayLike) -> Floats:
    """The largest distance (...) of curves (..., N, 2) from their chords.

    A curve whose ends coincide is measured from that point; fewer than three points are straight.
    Raises `ValueError` for a curve without points, and where one is not finite, or beyond 1e150.
    """
    curve = as_vectors("points", points, 2)
    if curve.ndim < 2 or not curve.shape[-2] or not np.all(np.abs(curve) <= 1e150):
        raise ValueError(f"points of shape {curve.shape}; legal: (..., N, 2), finite, to 1e150")
    chord = curve[..., -1, :] - curve[..., 0, :]
    offset = curve - curve[..., :1, :]
    length = np.hypot(chord[..., 0], chord[..., 1])[..., None]
    across = np.abs(chord[..., 1, None] * offset[..., 0] - chord[..., 0, None] * offset[..., 1])
    away = np.hypot(offset[..., 0], offset[..., 1])
    distance = np.divide(across, length, out=away, where=length > 0.0)
    return distance.max(axis=-1)
