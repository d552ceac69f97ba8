"""Zhang's closed form: the intrinsic matrix and the poses from homographies of a flat board.

With H = [h₁ h₂ h₃] ~ K [r₁ r₂ t], the columns r₁ and r₂ of a rotation are orthonormal::

    h₁ᵀ B h₂ = 0        h₁ᵀ B h₁ = h₂ᵀ B h₂        B = K⁻ᵀ K⁻¹

Two linear equations in B from each photograph. Without skew B has five unknown entries up to
scale, so that three photographs are enough. The lens is taken for ideal; distorted corners make
the result a starting value. Z. Zhang, *A flexible new technique for camera calibration*, 2000,
§2.3, §3.1 and §3.3.
"""

from collections.abc import Sequence

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera, Poses
from simulations.models.calibration.views import Views
from simulations.models.geometry.homography_estimation import estimate_homography
from simulations.models.geometry.rotations import nearest_rotation

LEAST_PHOTOGRAPHS = 3


class UndeterminedError(ValueError):
    """The photographs do not determine the camera; says what to do about it."""

    def __init__(self, words: str, photograph: int | None = None):
        """``photograph`` is the index of the one that is the cause."""
        super().__init__(words if photograph is None else f"Photograph {photograph + 1}: {words}")
        self.words, self.photograph = words, photograph

    def naming(self, names: Sequence[str]) -> str:
        """The message with the name of the photograph."""
        if self.photograph is None:
            return self.words
        return f"{names[self.photograph]}: {self.words}"


TILT = "The photographs do not tell the focal length: take some with the board tilted by 30° to 45°"
FLAT = "its corners lie on one line; leave it out"
BEYOND = "this lens sees fewer than four of its corners; leave it out"
FEW = "At least {} photographs are needed, from different sides"


def closed_form(views: Views, size: tuple[int, int]) -> tuple[Camera, Poses]:
    """A starting value for the camera and the poses; ``size`` is the pictures' (width, height).

    Raises `UndeterminedError` for fewer than three photographs, for one whose corners lie on a
    line. Boards that are all parallel are found out by their standard errors.
    """
    if len(views) < LEAST_PHOTOGRAPHS:
        raise UndeterminedError(FEW.format(LEAST_PHOTOGRAPHS))
    H = homographies(views)
    camera = _camera(H, size)
    return camera, poses_of(H, camera.matrix)


def homographies(views: Views) -> Floats:
    """(P, 3, 3) from each board to its picture.

    Raises `UndeterminedError` for a photograph with fewer than four corners, or with all of them
    on a line.
    """
    found = []
    for index in range(len(views)):
        board, pixels = views.of(index)
        if len(board) < 4:
            raise UndeterminedError(BEYOND, index)
        H, valid = estimate_homography(board, pixels)
        if not valid:
            raise UndeterminedError(FLAT, index)
        found.append(H)
    return np.array(found)


def _camera(H: Floats, size: tuple[int, int]) -> Camera:
    """Zhang's camera; where noise or the lens leave B without a likely one, that with its axis in
    the middle, and last one that sees 53° across, from which the search arrives too."""
    unit, middle = 0.5 * max(size), 0.5 * (np.array(size, float) - 1.0)
    scaled = np.diag((1.0 / unit, 1.0 / unit, 1.0)) @ np.array(
        [[1.0, 0.0, -middle[0]], [0.0, 1.0, -middle[1]], [0.0, 0.0, 1.0]]
    )
    rows = constraints(scaled @ H)
    for unknowns in ((0, 2, 3, 4, 5), (0, 2, 5)):
        system = rows[:, unknowns]
        _, sizes, Vt = np.linalg.svd(system, full_matrices=False)
        if sizes[-2] <= 1e-9 * sizes[0]:
            continue
        b = np.zeros(6)
        b[list(unknowns)] = Vt[-1] * np.sign(Vt[-1][0])
        fx2, fy2, x, y = _from_b(b)
        if min(fx2, fy2) > 0.25 * max(fx2, fy2) and max(abs(x), abs(y)) < 1.0:
            return Camera(
                unit * float(np.sqrt(fx2)),
                unit * float(np.sqrt(fy2)),
                unit * x + float(middle[0]),
                unit * y + float(middle[1]),
            )
    x, y = middle.tolist()
    return Camera(2.0 * unit, 2.0 * unit, x, y)


def constraints(H: Floats) -> Floats:
    """Rows (2P, 6): the two equations of each homography in b = (B₁₁, B₁₂, B₂₂, B₁₃, B₂₃, B₃₃)."""
    H = H / np.linalg.norm(H, axis=(-2, -1), keepdims=True)
    across, first, second = _products(H, 0, 1), _products(H, 0, 0), _products(H, 1, 1)
    return np.concatenate((across, first - second))


def _products(H: Floats, i: int, j: int) -> Floats:
    """v (P, 6) with vᵀ b = hᵢᵀ B hⱼ."""
    p, q = H[..., i], H[..., j]
    pairs = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))
    columns = [
        p[:, a] * q[:, b] if a == b else p[:, a] * q[:, b] + p[:, b] * q[:, a] for a, b in pairs
    ]
    return np.stack(columns, axis=-1)


def _from_b(b: Floats) -> tuple[float, float, float, float]:
    """f_x², f_y², c_x and c_y of B without skew, in the units of the homographies."""
    if b[0] == 0.0 or b[2] == 0.0:
        return -1.0, -1.0, 0.0, 0.0
    x, y = -b[3] / b[0], -b[4] / b[2]
    scale = b[5] - b[0] * x * x - b[2] * y * y
    return float(scale / b[0]), float(scale / b[2]), float(x), float(y)


def estimate_poses(views: Views, camera: Camera) -> Poses:
    """The poses of boards by corners that the camera's lens is taken out of.

    Raises `UndeterminedError` where the lens cannot have seen a board.
    """
    ideal, valid = camera.ideal(views.pixels)
    straight = Views(views.board, ideal, views.found & valid)
    return poses_of(homographies(straight), np.eye(3))


def poses_of(H: Floats, K: Floats) -> Poses:
    """The poses (P) of boards, all in front of the camera, from homographies (P, 3, 3)."""
    columns = np.linalg.solve(K, H)
    length = 0.5 * np.linalg.norm(columns[..., :2], axis=-2).sum(axis=-1)
    columns = columns * (np.sign(columns[:, 2, 2]) / length)[:, None, None]
    r1, r2 = columns[..., 0], columns[..., 1]
    loose = np.stack((r1, r2, np.cross(r1, r2)), axis=-1)
    return Poses(np.array([nearest_rotation(R) for R in loose]), columns[..., 2])


def linear_lens(views: Views, camera: Camera, poses: Poses) -> Camera:
    """The camera with k₁ and k₂ that fit best while everything else stays (§3.3).

    The shift of a corner is k₁ r² + k₂ r⁴ times its vector from the principal point: linear.
    """
    points = poses.place(views.board)
    xy = points[..., :2] / points[..., 2:]
    r2 = (xy * xy).sum(axis=-1, keepdims=True)
    pinhole = Camera(camera.fx, camera.fy, camera.cx, camera.cy)
    away = xy * (camera.fx, camera.fy)
    seen = views.found
    shift = (views.pixels - pinhole.pixels(points))[seen]
    system = np.stack((away * r2, away * r2 * r2), axis=-1)[seen]
    (k1, k2), *_ = np.linalg.lstsq(system.reshape(-1, 2), shift.ravel(), rcond=None)
    return pinhole.changed(("k1", "k2"), (k1, k2)) if np.isfinite((k1, k2)).all() else pinhole
