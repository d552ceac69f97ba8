"""Chequerboards for tests: views of a board, simulated photographs, and boards that are bent."""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import Adjusted, refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.calibration.views import Views
from simulations.models.calibration.zhang import closed_form
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens import Lens
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
) -> View:
    """A camera that looks at the middle of a board, which is turned about it by the rotation vector
    ``tilt``."""
    columns, rows = board.corners
    middle = 0.5 * board.side_mm * np.array([columns - 1, rows - 1, 0])
    pose = np.eye(4)
    pose[:3, :3] = exponential(np.array(tilt))
    pose[:3, 3] = np.array([0.0, 0.0, distance_mm]) - pose[:3, :3] @ middle
    centre = (0.5 * width + 2.2, 0.5 * height - 3.7)
    return View(width, height, intrinsics(focal_px, centre), BARREL, pose)


SIZE = (640, 480)
TRUTH = Camera(600.0, 603.0, 322.0, 236.0, Distortion(k1=-0.25, k2=0.08, p1=6e-4, p2=-4e-4))


def photographs(count: int, seed: int = 0, camera: Camera = TRUTH) -> Sitting:
    """Photographs of a board with 9 × 6 inner corners."""
    return sitting(camera, SIZE, count, Board(), seed)


def calibrate(views: Views, lens: str = "k3") -> Adjusted:
    """The camera by least squares, from the corners alone."""
    return refine(views, *closed_form(views, SIZE), PINHOLE + LENSES[lens])


BENT_SIZE = (1600, 1200)
BOARD = Board(10, 7, 20.0)  # 200 mm wide
SIDE_MM, SIGMA_PX = 20.0, 0.05

type World = dict[str, float]
"""Departures from a flat board and a simple lens, by name."""

BOARD_WORLDS: dict[str, World] = {
    "flat": {},
    "sag of 0.5 mm": {"sag_mm": 0.5},
    "sag of 2 mm": {"sag_mm": 2.0},
    "squares 2 % too high": {"aspect": 1.02},
    "buckled by 2 mm": {"buckle_mm": 1.0},
    "lens of higher order": {"order": 1.0},
    "fisheye": {"fisheye": 1.0},
    "rational lens": {"rational": 1.0},
    "correlated noise": {"correlated": 1.0},
}


def corners_of(world: World, rng: np.random.Generator) -> Floats:
    """The corners (N, 3) of the board, in squares."""
    u, v = BOARD.indices.T
    x, y = (u - 4.0) / 5.0, (v - 2.5) / 3.5
    turn = rng.uniform(0.0, np.pi)
    along = x * np.cos(turn) + 0.7 * y * np.sin(turn)
    z = world.get("sag_mm", 0.0) / SIDE_MM * along**2 * rng.choice((-1.0, 1.0))
    waves = np.sin(2.0 * x + rng.normal()) * np.cos(1.5 * y) + 0.3 * x * y
    z = z + world.get("buckle_mm", 0.0) / SIDE_MM * waves
    return np.column_stack((u, v * world.get("aspect", 1.0), z))


def bent_views(world: World, rng: np.random.Generator, count: int = 12) -> tuple[Camera, Views]:
    """A camera, and its photographs of one board; lengths in squares."""
    focal = rng.uniform(1000.0, 1500.0)
    terms = {
        "k1": rng.uniform(-0.25, 0.05),
        "k2": rng.uniform(-0.05, 0.1),
        "p1": rng.normal(0.0, 3e-4),
        "p2": rng.normal(0.0, 3e-4),
    }
    if "order" in world:
        terms |= {"k3": 0.03, "k4": rng.normal(0.0, 0.02), "k5": rng.normal(0.0, 0.01)}
    middle = rng.normal((799.5, 599.5), 15.0)
    x, y = middle.tolist()
    lens: Lens = Distortion(**terms)
    if "fisheye" in world:  # sees 110° to 160° across
        focal *= 0.55
        lens = Fisheye(*rng.normal((0.0, 0.0, 0.0, 0.0), (0.03, 0.01, 3e-3, 1e-3)))
    if "rational" in world:  # sees 80° to 130° across
        focal = rng.uniform(650.0, 1050.0)
        lens = Distortion(k1=0.61, k2=0.05, p1=3e-4, p2=-2e-4, k4=0.86, k5=0.16, k6=2e-3)
    camera = Camera(focal, focal * rng.normal(1.0, 1e-3), x, y, lens)
    poses = sitting(camera, BENT_SIZE, count, BOARD, int(rng.integers(10**9))).poses
    corners = corners_of(world, rng)
    pixels = camera.pixels(corners @ np.swapaxes(poses.R, -1, -2) + poses.t[:, None])
    noise = rng.normal(0.0, SIGMA_PX, (count, 6, 9, 2))
    if "correlated" in world:
        noise[:, 1:] += noise[:, :-1].copy()
        noise[:, :, 1:] += 0.8 * noise[:, :, :-1].copy()
    noisy = pixels + noise.reshape(pixels.shape)
    board = np.broadcast_to(BOARD.indices, pixels.shape).copy()
    return camera, Views(board, noisy, np.ones(pixels.shape[:2], bool))
