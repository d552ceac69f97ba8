"""A corner as the saddle of a parabola through the brightness about it.

L. Lucchese and S. K. Mitra, *Using saddle points for subpixel feature detection in camera
calibration targets*, 2002; with the weights of S. Placht and others, *ROCHADE: robust checkerboard
advanced detection*, 2014, §3.3. Around a corner the brightness is even, so that its saddle is the
corner, whatever the blur and the response curve are.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.chequerboard.corner_windows import Picture, cone, windows


def quadratic_saddle(picture: Picture, places: Floats, radius: int, steps: int = 4) -> Floats:
    """(N, 2) saddles near places (N, 2) in px; NaN where there is none within ``radius``.

    Least squares in a window of that radius, which then moves to the saddle; at most ``steps``
    times.
    """
    found = np.array(places, float)
    for _ in range(steps):
        sight = windows(picture, np.nan_to_num(found), radius)
        middle = np.rint(np.nan_to_num(found))
        dx, dy = sight.x - middle[:, :1], sight.y - middle[:, 1:]
        weight = cone(sight.x - found[:, :1], sight.y - found[:, 1:], radius)
        terms = np.stack([dx * dx, dx * dy, dy * dy, dx, dy, np.ones_like(dx)], axis=-1)
        weighted = np.swapaxes(np.nan_to_num(weight)[..., None] * terms, 1, 2)
        normal = weighted @ terms + 1e-9 * np.eye(6)
        fit = np.linalg.solve(normal, weighted @ sight.values[..., None])[..., 0]
        found = middle + _saddle(*fit.T[:5])
        lost = ~(np.hypot(*(found - places).T) <= radius)
        found[lost] = np.nan
    return found


def _saddle(xx: Floats, xy: Floats, yy: Floats, x: Floats, y: Floats) -> Floats:
    """(N, 2) where both slopes are zero; NaN unless curvatures differ in sign."""
    size = xy * xy - 4.0 * xx * yy
    size = np.where(size > 0.0, size, np.nan)
    return np.stack([2.0 * yy * x - xy * y, 2.0 * xx * y - xy * x], axis=-1) / size[:, None]
