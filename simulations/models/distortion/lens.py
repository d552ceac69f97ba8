"""Any lens as a map of the plane: where it puts what a pinhole would image at (x, y), and back.

A fisheye's image radius is a polynomial of the angle to the axis, θ = arctan r. In the plane, at
z = 1, it is one more factor along the radius, g(r²) = (θ / r)(1 + k₁θ² + …): the derivatives have
the form of Brown's. The plane holds what is in front of the camera, up to `WIDEST_RAD`.
"""

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.distortion import lens_model, radial_inverse, radial_profile
from simulations.models.distortion.decentring import DecentredLens, Linearisation
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_profile import RadialProfile

type Lens = Distortion | Fisheye

WIDEST_RAD = 1.55
"""Angle to the axis, 88.8°, up to which a point of a fisheye's picture has one in the plane."""
ON_AXIS = 1e-12
"""Smaller r² count as this, so that θ / r needs no limit."""


def distorted(xy: Floats, lens: Lens) -> Floats:
    """The image (..., 2) of points (..., 2) of the plane."""
    if isinstance(lens, Distortion):
        return lens_model.distort(xy, lens)
    g, _, _ = _by_angle(xy[..., 0], xy[..., 1], lens)
    return xy * g[..., None]


def ideal(xy: Floats, lens: Lens) -> tuple[Floats, Mask]:
    """The points (..., 2) of the plane with these images, finite where there are none; and where
    there are."""
    if isinstance(lens, Distortion):
        return lens_model.undistort_clamped(xy, lens)
    radius = np.hypot(xy[..., 0], xy[..., 1])
    angle, valid = radial_inverse.invert_bracketed(lens.radial, radius)
    valid &= angle < WIDEST_RAD
    stretch = np.tan(np.minimum(angle, WIDEST_RAD)) / np.maximum(radius, ON_AXIS)
    return xy * np.where(radius > ON_AXIS, stretch, 1.0)[..., None], valid


def fold_radius(lens: Lens) -> float:
    """Radius in the plane from which on the map along the radius does not increase, or ends."""
    if isinstance(lens, Distortion):
        return lens_model.fold_radius(lens)
    return float(np.tan(min(radial_profile.fold_radius(lens.radial), WIDEST_RAD)))


def linearised(x: Floats, y: Floats, lens: Lens) -> Linearisation:
    """Images of points (...) and the derivatives there."""
    if isinstance(lens, Distortion):
        return DecentredLens(lens.radial, lens.p1, lens.p2).linearised(x, y)
    g, slope, _ = _by_angle(x, y, lens)
    return x * g, y * g, g + 2.0 * x * x * slope, 2.0 * x * y * slope, g + 2.0 * y * y * slope


def coefficient_derivatives(x: Floats, y: Floats, lens: Lens) -> dict[str, tuple[Floats, Floats]]:
    """The derivatives of images by each coefficient, across and down."""
    r2 = x * x + y * y
    if isinstance(lens, Fisheye):
        _, _, angle = _by_angle(x, y, lens)
        shares = {f"k{n}": angle ** (2 * n + 1) / np.sqrt(r2 + ON_AXIS) for n in range(1, 5)}
        return {name: (x * share, y * share) for name, share in shares.items()}
    below = radial_profile.scale(RadialProfile(lens.radial.denominator), r2)
    above = radial_profile.scale(lens.radial, r2)
    shares = {f"k{n}": r2**n / below for n in range(1, 4)}
    shares |= {f"k{n + 3}": -above * shares[f"k{n}"] for n in range(1, 4)}
    return {
        **{name: (x * share, y * share) for name, share in shares.items()},
        "p1": (2.0 * x * y, r2 + 2.0 * y * y),
        "p2": (r2 + 2.0 * x * x, 2.0 * x * y),
    }


def _by_angle(x: Floats, y: Floats, lens: Fisheye) -> tuple[Floats, Floats, Floats]:
    """g, its derivative by r², and the angle."""
    r2 = np.maximum(x * x + y * y, ON_AXIS)
    r = np.sqrt(r2)
    angle = np.arctan(r)
    g = radial_profile.evaluate(lens.radial, angle) / r
    along = radial_profile.slope(lens.radial, angle) / (1.0 + r2)  # of the image by r
    return g, 0.5 * (along - g) / r2, angle
