"""Simulated photographs of a board: poses as a photographer would choose them, true corners, noise.

The n-th photograph does not depend on how many there are.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera, Poses, predicted
from simulations.models.calibration.views import Views
from simulations.models.chequerboard.board import Board
from simulations.models.geometry import rotations

MOST_TILT, MOST_ROLL = 0.75, 0.5
"""Radians about the axes in the board and about the camera's."""
DRAWN, MOST_DRAWS = 64, 200
"""Poses that are drawn at once, and how often."""


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
    they fill between half and all of its width.
    """
    placed = [_placed(camera, size, board, (seed, index), margin_px) for index in range(count)]
    R, t = zip(*placed, strict=True) if placed else ((), ())
    poses = Poses(np.array(R).reshape(-1, 3, 3), np.array(t).reshape(-1, 3))
    return Sitting(camera, size, board, poses)


def _placed(
    camera: Camera, size: tuple[int, int], board: Board, seed: tuple[int, int], margin_px: float
) -> tuple[Floats, Floats]:
    """One pose: the first of many drawn from which the whole board is in view."""
    rng = np.random.default_rng(seed)
    middle = 0.5 * (np.array(board.corners) - 1.0)
    rim = np.broadcast_to(_rim(board), (DRAWN, 8, 2))
    last = np.array(size) - 1.0
    for _ in range(MOST_DRAWS):
        turns = rng.uniform(-1.0, 1.0, (DRAWN, 3)) * (MOST_TILT, MOST_TILT, MOST_ROLL)
        R = rotations.exponential(turns)
        Z = board.across * camera.fx / size[0] / rng.uniform(0.6, 1.15, (DRAWN, 1))
        aim = (rng.uniform(size=(DRAWN, 2)) * last - (camera.cx, camera.cy)) / (
            camera.fx,
            camera.fy,
        )
        t = np.concatenate((aim * Z, Z), axis=1) - R[..., :2] @ middle
        pixels = predicted(camera, Poses(R, t), rim)
        inside = ((pixels >= margin_px) & (pixels <= last - margin_px)).all(axis=(1, 2))
        if inside.any():
            first = int(inside.argmax())
            return R[first], t[first]
    raise ValueError(f"board {board}; legal: one that fits into the picture")


def _rim(board: Board) -> Floats:
    """(8, 2) corners and middles of the sides of the board's border, in squares."""
    middle = 0.5 * (np.array(board.corners) - 1.0)
    ways = [(x, y) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0) if x or y]
    return middle + np.array(ways) * (middle + 1.0)
