"""Simulated photographs of a chequerboard for the tests of calibration."""

from simulations.models.calibration.camera import Camera
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion

SIZE = (640, 480)
TRUTH = Camera(600.0, 603.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08, p1=6e-4, p2=-4e-4))


def photographs(count: int, seed: int = 0, camera: Camera = TRUTH) -> Sitting:
    """Photographs of a board with 9 × 6 inner corners."""
    return sitting(camera, SIZE, count, Board(), seed)
