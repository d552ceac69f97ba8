"""Calibrations from too few photographs, from parallel boards, and through extreme lenses."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, near, refused
from simulations.models.calibration import bundle_adjustment, standard_errors, zhang
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.calibration.views import Views
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry.rotations import exponential

SIZE = (640, 480)
BARREL = Camera(600.0, 600.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08))


def _views(count: int, camera: Camera = BARREL, sigma_px: float = 0.0) -> Views:
    return sitting(camera, SIZE, count, Board(), seed=1).views(sigma_px)


def _parallel(tilt_rad: float, sigma_px: float) -> Views:
    """Five boards, all turned alike."""
    R = np.broadcast_to(exponential(np.array([0.0, tilt_rad, 0.0])), (5, 3, 3))
    middle = np.array([4.0, 2.5, 0.0])
    places = np.array([(0.3 * n, 0.2 * n, 14.0 + n) for n in range(5)])
    return Sitting(BARREL, SIZE, Board(), Poses(R, places - R @ middle)).views(sigma_px)


def _partial() -> Views:
    """The first photograph shows four corners, the others half of the board."""
    views = _views(6)
    views.found[:, 27:] = False
    views.found[0] = False
    views.found[0, [0, 8, 45, 53]] = True
    return views


def _on_a_line() -> Views:
    views = _views(4)
    views.found[1, 9:] = False
    return views


def focal_px(views: Views, lens: str = "k1k2") -> float:
    """f_x, if the photographs determine it."""
    fit = bundle_adjustment.calibrate(views, SIZE, lens)
    standard_errors.uncertainty(views, fit, PINHOLE + LENSES[lens])
    return fit.camera.fx


TABLE = HardCases(
    id="calibration",
    title="Calibrating a camera",
    names={
        **vars(zhang),
        "focal_px": focal_px,
        "SIZE": SIZE,
        "views": _views,
        "parallel": _parallel,
        "PARTIAL": _partial(),
        "LINE": _on_a_line(),
        "TELE": Camera(20_000.0, 20_000.0, 319.5, 239.5),
        "WIDE": Camera(180.0, 180.0, 319.5, 239.5, Distortion(k1=-0.09, k2=0.004)),
    },
    cases=(
        HardCase(
            id="two",
            call="focal_px(views(2))",
            why="Two photographs are enough for the equations, and for nothing to check them by.",
            returns="A refusal: at least three, from different sides.",
            expected=refused("At least 3"),
        ),
        HardCase(
            id="facing",
            call="focal_px(parallel(0.0, 0.1))",
            why="All boards face the camera: twice the focal length at twice the distance looks "
            "the same.",
            returns="A refusal, with what to do.",
            expected=refused("tilted"),
        ),
        HardCase(
            id="alike",
            call="focal_px(parallel(0.6, 0.1))",
            why="All boards are tilted, but all alike, so that each photograph says the same.",
            returns="A refusal as well. The lens alone would tell them apart, and not well enough.",
            expected=refused("tilted"),
        ),
        HardCase(
            id="line",
            call="focal_px(LINE)",
            why="The second photograph shows a single row of corners.",
            returns="A refusal that names the photograph: a row has no homography.",
            expected=refused("Photograph 2"),
        ),
        HardCase(
            id="partial",
            call="focal_px(PARTIAL)",
            why="One photograph shows four corners, exactly enough for its pose; the others half "
            "of the board.",
            returns="The focal length, since corners need not be the same in all photographs.",
            expected=near(600.0, 1e-6),
        ),
        HardCase(
            id="tele",
            call="focal_px(views(6, TELE), 'none')",
            why="Through 20 000 px, a field of view under 2°, hardly any perspective is left.",
            returns="The focal length, from corners without error.",
            expected=near(20_000.0, 1e-6),
        ),
        HardCase(
            id="tele-noise",
            call="focal_px(views(6, TELE, 0.2), 'none')",
            why="Corners err by 0.2 px, and the perspective within a board is a few pixels.",
            returns="The focal length to about one per cent: 54 corners average the noise.",
            expected=near(20_000.0, 0.03),
        ),
        HardCase(
            id="wide",
            call="focal_px(views(8, WIDE))",
            why="A field of view of 120°, in which the closed form takes the lens for ideal.",
            returns="The focal length: the search mends what the start has wrong.",
            expected=near(180.0, 1e-6),
        ),
    ),
)
