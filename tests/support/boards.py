"""Views of chequerboards for tests: the camera looks at the middle of the board."""

import numpy as np

from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry.rotations import exponential
from simulations.models.projection.pinhole import intrinsics
from simulations.pictures.chequerboard import View

BARREL = Distortion(k1=-0.3, k2=0.09)


def facing_board(
    board: Board,
    width: int,
    height: int,
    *,
    focal_px: float,
    tilt: tuple[float, float, float],
    distance_mm: float,
    aside_mm: tuple[float, float] = (0.0, 0.0),
    lens: Distortion = BARREL,
) -> View:
    """A board turned by a rotation vector about its middle, at this distance."""
    columns, rows = board.corners
    middle = 0.5 * board.side_mm * np.array([columns - 1, rows - 1, 0])
    pose = np.eye(4)
    pose[:3, :3] = exponential(np.array(tilt))
    pose[:3, 3] = np.array([*aside_mm, distance_mm]) - pose[:3, :3] @ middle
    centre = (0.5 * width + 2.2, 0.5 * height - 3.7)
    return View(width, height, intrinsics(focal_px, centre), lens, pose)
