"""Other ways to undo a lens that is off centre, to be compared with `lens_model.undistort`.

All take distorted points (..., 2) in normalised coordinates and return ideal ones. They assume
points well inside the fold, and none notices when it fails.

Source: Szeliski, 2nd ed., section 2.1.5; the fixed point is the method of OpenCV's undistortPoints.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.distortion.decentring import DecentredLens
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.plane_newton import newton_step
from simulations.models.distortion.radial_profile import scale


def undistort_decentred_fixed_point(xy: ArrayLike, d: Distortion, steps: int) -> Floats:
    """Subtract what decentring adds at the latest guess, divide by the radial factor there.

    ``steps`` times, from the distorted point: x ← (x_d − δ(x)) / g(|x|²).
    """
    seen = np.asarray(xy, float)
    seen_x, seen_y = seen[..., 0], seen[..., 1]
    x, y = seen_x, seen_y
    for _ in range(steps):
        r2, cross = x * x + y * y, 2.0 * x * y
        shrink = 1.0 / scale(d.radial, r2)
        x, y = (
            (seen_x - d.p1 * cross - d.p2 * (r2 + 2.0 * x * x)) * shrink,
            (seen_y - d.p2 * cross - d.p1 * (r2 + 2.0 * y * y)) * shrink,
        )
    return np.stack((x, y), axis=-1)


def undistort_decentred_newton(
    xy: ArrayLike, d: Distortion, steps: int, start: ArrayLike | None = None
) -> Floats:
    """``steps`` of Newton's method in the plane, from ``start`` or else the distorted points."""
    seen = np.asarray(xy, float)
    lens = DecentredLens(d.radial, d.p1, d.p2)
    begin = seen if start is None else np.asarray(start, float)
    x, y = begin[..., 0], begin[..., 1]
    for _ in range(steps):
        right, down = newton_step(lens.linearised, x, y, seen[..., 0], seen[..., 1])
        x, y = x - right, y - down
    return np.stack((x, y), axis=-1)
