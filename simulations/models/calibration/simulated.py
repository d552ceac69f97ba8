"""Simulated photographs of a board: poses as a photographer would choose them, true corners, noise.

The n-th photograph does not depend on how many there are.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.board import Board
from simulations.models.calibration.camera import Camera, Poses, predicted
from simulations.models.calibration.views import Views
from simulations.models.geometry import rotations

MOST_TILT, MOST_ROLL = 0.75, 0.5
"""Radians about the axes in the board and about the camera's."""
MOST_TRIES = 10_000


@dataclass(frozen=True, slots=True)
class Sitting:
    """A camera, a board, and the place of the board in each photograph."""

    camera: Camera
    size: tuple[int, int]
    """Width and height of the pictures in px."""
    board: Board
    poses: Poses

    @property
    def pixels(self) -> Floats:
        """(P, N, 2) true corners in the pictures."""
        return predicted(self.camera, self.poses, self.corners)

    @property
    def corners(self) -> Floats:
        """(P, N, 2) the same corners of the board for each picture, in squares."""
        indices = self.board.indices
        return np.broadcast_to(indices, (len(self.poses.t), *indices.shape))

    def views(self, sigma_px: float, seed: int = 0) -> Views:
        """What a finder of corners with this standard deviation in x and in y would find."""
        corners = self.corners
        noise = np.empty(corners.shape)
        for index, of_one in enumerate(noise):
            of_one[:] = np.random.default_rng((seed, index)).normal(size=of_one.shape)
        return Views(corners, self.pixels + sigma_px * noise, np.ones(corners.shape[:2], bool))


def sitting(
    camera: Camera,
    size: tuple[int, int],
    count: int,
    board: Board,
    seed: int = 0,
    margin_px: float = 12.0,
) -> Sitting:
    """``count`` photographs that show the whole board, a margin included.

    The boards are tilted by up to 43° about each of their axes, and stand at distances from which
    they fill between a third and nearly all of the picture.
    """
    placed = [_placed(camera, size, board, (seed, index), margin_px) for index in range(count)]
    R, t = zip(*placed, strict=True) if placed else ((), ())
    poses = Poses(np.array(R).reshape(-1, 3, 3), np.array(t).reshape(-1, 3))
    return Sitting(camera, size, board, poses)


def _placed(
    camera: Camera, size: tuple[int, int], board: Board, seed: tuple[int, int], margin_px: float
) -> tuple[Floats, Floats]:
    """One pose, drawn until the whole board is in view."""
    rng = np.random.default_rng(seed)
    middle = 0.5 * (np.array(board.corners) - 1.0)
    # The border of the board is a square beyond its corners.
    border = middle + (board.indices - middle) * (1.0 + 1.0 / middle)
    for _ in range(MOST_TRIES):
        turn = rng.uniform(-1.0, 1.0, 3) * (MOST_TILT, MOST_TILT, MOST_ROLL)
        R = rotations.exponential(turn)
        Z = board.across * camera.fx / size[0] / rng.uniform(0.35, 1.0)
        aim = rng.uniform(0.0, 1.0, 2) * (np.array(size) - 1.0)
        centre = np.append((aim - (camera.cx, camera.cy)) / (camera.fx, camera.fy), 1.0) * Z
        t = centre - R[:, :2] @ middle
        pixels = predicted(camera, Poses(R[None], t[None]), border[None])[0]
        if np.all(pixels >= margin_px) and np.all(pixels <= np.array(size) - 1.0 - margin_px):
            return R, t
    raise ValueError(f"board {board}; legal: one that fits into the picture")
