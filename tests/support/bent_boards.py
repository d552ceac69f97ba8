"""Cameras and boards that are bent as real ones are, and what they show; lengths in squares."""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.camera import Camera
from simulations.models.calibration.simulated import sitting
from simulations.models.calibration.views import Views
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.fisheye import Fisheye
from simulations.models.distortion.lens import Lens
from simulations.models.distortion.lens_model import Distortion

SIZE = (1600, 1200)
BOARD = Board(10, 7, 20.0)  # 200 mm wide
SIDE_MM, SIGMA_PX = 20.0, 0.05

type World = dict[str, float]

LENSES: dict[str, World] = {
    "flat": {},
    "sag of 0.5 mm": {"sag_mm": 0.5},
    "sag of 2 mm": {"sag_mm": 2.0},
    "squares 2 % too high": {"aspect": 1.02},
    "buckled by 2 mm": {"buckle_mm": 1.0},
    "lens of higher order": {"order": 1.0},
    "fisheye": {"fisheye": 1.0},
    "correlated noise": {"correlated": 1.0},
}


def corners_of(world: World, rng: np.random.Generator) -> Floats:
    """(N, 3) of the board."""
    u, v = BOARD.indices.T
    x, y = (u - 4.0) / 5.0, (v - 2.5) / 3.5
    turn = rng.uniform(0.0, np.pi)
    along = x * np.cos(turn) + 0.7 * y * np.sin(turn)
    z = world.get("sag_mm", 0.0) / SIDE_MM * along**2 * rng.choice((-1.0, 1.0))
    waves = np.sin(2.0 * x + rng.normal()) * np.cos(1.5 * y) + 0.3 * x * y
    z = z + world.get("buckle_mm", 0.0) / SIDE_MM * waves
    return np.column_stack((u, v * world.get("aspect", 1.0), z))


def bent_views(world: World, rng: np.random.Generator, count: int = 12) -> tuple[Camera, Views]:
    """A camera, and its photographs of one board."""
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
    camera = Camera(focal, focal * rng.normal(1.0, 1e-3), x, y, lens)
    poses = sitting(camera, SIZE, count, BOARD, int(rng.integers(10**9))).poses
    corners = corners_of(world, rng)
    pixels = camera.pixels(corners @ np.swapaxes(poses.R, -1, -2) + poses.t[:, None])
    noise = rng.normal(0.0, SIGMA_PX, (count, 6, 9, 2))
    if "correlated" in world:
        noise[:, 1:] += noise[:, :-1].copy()
        noise[:, :, 1:] += 0.8 * noise[:, :, :-1].copy()
    noisy = pixels + noise.reshape(pixels.shape)
    board = np.broadcast_to(BOARD.indices, pixels.shape).copy()
    return camera, Views(board, noisy, np.ones(pixels.shape[:2], bool))
