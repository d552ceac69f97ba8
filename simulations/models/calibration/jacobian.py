"""How the predicted corners change with the camera and with each pose, in closed form.

A corner P of the board lies at Q = R P + t in the camera frame, at (x, y) = (Q₁, Q₂) / Q₃ in
normalised coordinates, and at (f_x x_d + c_x, f_y y_d + c_y) in the picture, where (x_d, y_d) is
the distorted point. Each picture's corners depend on its own pose alone, so that the Jacobian of
P pictures is sparse: a block (2N, m) for the camera and one (2N, 6) for the pose of each.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera, Poses
from simulations.models.calibration.views import Views
from simulations.models.distortion.decentring import DecentredLens


@dataclass(frozen=True, slots=True)
class Linearised:
    """Residuals and their derivatives; rows are the N corners' x, then their y."""

    residual: Floats
    """(P, 2N): predicted minus found, px; 0 where no corner was found, infinite behind the
    camera."""
    by_camera: Floats
    """(P, 2N, m): by the free parameters of the camera."""
    by_pose: Floats
    """(P, 2N, 6): by a small turn in the camera frame (radians) and a shift (squares)."""


def linearise(views: Views, camera: Camera, poses: Poses, free: tuple[str, ...]) -> Linearised:
    """Residuals and derivatives with respect to the parameters ``free`` of the camera."""
    X, Y, Z = np.moveaxis(poses.place(views.board), -1, 0)
    ahead = Z > 0.0
    Z = np.where(ahead, Z, 1.0)
    x, y = X / Z, Y / Z
    lens = camera.lens
    xd, yd, xx, xy, yy = DecentredLens(lens.radial, lens.p1, lens.p2).linearised(x, y)
    fx, fy = camera.fx, camera.fy
    off = np.stack((fx * xd + camera.cx, fy * yd + camera.cy), 1) - np.moveaxis(views.pixels, -1, 1)
    seen = np.repeat(views.found[:, None], 2, axis=1)
    off = np.where(np.repeat(ahead[:, None], 2, axis=1), off, np.inf)
    residual = np.where(seen, off, 0.0)
    by_camera = _by_camera(x, y, xd, yd, camera, free)
    by_point = np.stack(  # (P, 2, N, 3), by Q
        (
            np.stack((xx / Z, xy / Z, -(xx * x + xy * y) / Z), -1) * fx,
            np.stack((xy / Z, yy / Z, -(xy * x + yy * y) / Z), -1) * fy,
        ),
        1,
    )
    turned = np.stack((X, Y, Z), -1) - poses.t[:, None]  # R P, which the small turn moves
    by_turn = np.cross(turned[:, None], by_point)  # d (ω × RP)·q = ω · (RP × q)
    by_pose = np.concatenate((by_turn, by_point), axis=-1)
    weight = seen[..., None]
    pictures, _, corners, _ = by_pose.shape
    rows = (pictures, 2 * corners)
    return Linearised(
        residual.reshape(rows),
        (by_camera * weight).reshape(*rows, len(free)),
        (by_pose * weight).reshape(*rows, 6),
    )


def _by_camera(
    x: Floats, y: Floats, xd: Floats, yd: Floats, camera: Camera, free: tuple[str, ...]
) -> Floats:
    """(P, 2, N, m) derivatives by the free parameters of the camera."""
    r2 = x * x + y * y
    none, one = np.zeros_like(x), np.ones_like(x)
    across, twice = 2.0 * x * y, r2 * r2
    moved = {  # of the distorted point
        "k1": (x * r2, y * r2),
        "k2": (x * twice, y * twice),
        "p1": (across, r2 + 2.0 * y * y),
        "p2": (r2 + 2.0 * x * x, across),
        "k3": (x * twice * r2, y * twice * r2),
    }
    columns = {
        "fx": (xd, none),
        "fy": (none, yd),
        "cx": (one, none),
        "cy": (none, one),
        **{name: (camera.fx * u, camera.fy * v) for name, (u, v) in moved.items()},
    }
    derivatives = np.empty((len(x), 2, x.shape[1], len(free)))
    for index, name in enumerate(free):
        derivatives[:, 0, :, index], derivatives[:, 1, :, index] = columns[name]
    return derivatives
