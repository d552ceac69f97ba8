"""Homographies from the pixels of one picture to those of another.

They exist for a camera that only rotates about its centre, and for a flat scene. In all other cases
the map depends on the depth of each pixel.

Pixels and frames as in `simulations.models.projection.pinhole`. Use the matrices with
`transforms.apply_homography`, which also maps points behind the second camera. They are scaled so
that w is the depth in the second camera over the depth in the first; `in_front` tests its sign.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.4 (mapping from one camera to another), §8.2.3.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.geometry.quaternions import check_rotation
from simulations.models.geometry.transforms import sign_of_w
from simulations.models.require import require


def turned_camera(K_first: ArrayLike, K_second: ArrayLike, R: ArrayLike) -> Floats:
    """H = K₂ R K₁⁻¹, (3, 3): both pictures from the same place, at any depth.

    ``R`` (3, 3) takes directions in the first camera's frame to the second's. With R = I it is the
    effect of a change of the lens or of the sensor.
    """
    return _between(K_first, K_second, check_rotation(R))


def plane_between_views(
    K_first: ArrayLike, K_second: ArrayLike, first_to_second: ArrayLike, plane: ArrayLike
) -> Floats:
    """H = K₂ (R − t nᵀ/d) K₁⁻¹, (3, 3): two pictures of one plane.

    Parameters
    ----------
    K_first, K_second : (3, 3) from `pinhole.intrinsics`.
    first_to_second : (4, 4), the motion [R t; 0 1] from the first camera's frame to the second's.
    plane : (4,) n and d with n·X + d = 0 in the first camera's frame, of any scale.

    Raises
    ------
    ValueError
        If the plane is invalid, or passes through the first camera's centre, so that it is seen as
        a line.
    """
    pose = np.asarray(first_to_second, float)
    numbers = as_vectors("plane", plane, 4)
    normal, offset = numbers[:3], float(numbers[3])
    require(
        "plane",
        numbers,
        np.isfinite(numbers).all() and abs(offset) > 1e-12 * float(np.linalg.norm(normal)),
        "finite, not through the first camera",
    )
    R = check_rotation(pose[:3, :3])
    return _between(K_first, K_second, R - np.outer(pose[:3, 3], normal / offset))


def in_front(H: ArrayLike, pixels: ArrayLike) -> Mask:
    """Whether the points at pixels (..., 2) of the first picture are in front of the second camera.

    ``H`` (3, 3) is one of this module, with its sign: −H is the same map, but reverses the answer.
    """
    return np.asarray(sign_of_w(H, pixels) > 0.0)


def _between(K_first: ArrayLike, K_second: ArrayLike, motion: Floats) -> Floats:
    before, after = np.asarray(K_first, float), np.asarray(K_second, float)
    if before.shape != (3, 3) or after.shape != (3, 3):
        raise ValueError(f"K of shapes {before.shape} and {after.shape}; legal: (3, 3)")
    return np.linalg.solve(before.T, (after @ motion).T).T
