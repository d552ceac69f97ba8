"""Simulated photographs of a chequerboard for the tests of calibration."""

from simulations.models.calibration.bundle_adjustment import Adjusted, refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import closed_form
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion

SIZE = (640, 480)
TRUTH = Camera(600.0, 603.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08, p1=6e-4, p2=-4e-4))


def photographs(count: int, seed: int = 0, camera: Camera = TRUTH) -> Sitting:
    """Photographs of a board with 9 × 6 inner corners."""
    return sitting(camera, SIZE, count, Board(), seed)


def calibrate(views: Views, lens: str = "k3") -> Adjusted:
    """The camera by least squares, from nothing but corners."""
    return refine(views, *closed_form(views, SIZE), PINHOLE + LENSES[lens])
