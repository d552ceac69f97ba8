"""Errors of depth and pose caused by errors in a picture: the table of appendix A."""

import numpy as np
from support.worked_numbers import Phrases

from simulations.models.arrays import Floats
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.rotations import exponential

CHAPTER = "10-speed-and-accuracy"
FOCAL_PX, BASELINE_M, DEPTH_M = 800.0, 0.5, 10.0
NOISE_PX, POINTS = 0.3, 50

type Kind = type[np.floating]


def depth_m(disparity_px: float) -> float:
    return FOCAL_PX * BASELINE_M / disparity_px


def pose(world: Floats, seen_px: Floats, centre: Floats, kind: Kind) -> tuple[Floats, Floats]:
    """Rotation and place of the camera after ten Gauss–Newton steps, all in one number format."""
    R, c, f = np.eye(3, dtype=kind), centre.astype(kind), kind(FOCAL_PX)
    p, seen = world.astype(kind), seen_px.astype(kind)
    for _ in range(10):
        q = (p - c) @ R.T
        x, y, z = q.T
        nothing = np.zeros_like(z)
        of_place = np.array([[f / z, nothing, -f * x / z**2], [nothing, f / z, -f * y / z**2]])
        of_turn = np.array([[nothing, z, -y], [-z, nothing, x], [y, -x, nothing]])
        by_point = np.moveaxis(of_place, -1, 0)
        columns = (by_point @ np.moveaxis(of_turn, -1, 0), -by_point @ R)
        slopes = np.concatenate(columns, axis=-1).reshape(-1, 6)
        off = (seen - f * q[:, :2] / z[:, None]).reshape(-1)
        step = np.linalg.lstsq(slopes, off, rcond=None)[0]
        R, c = exponential(step[:3].astype(float)).astype(kind) @ R, c + step[3:]
    return R.astype(float), c.astype(float)


def pose_errors(origin_m: Floats, kind: Kind, noise_px: float) -> tuple[float, float]:
    """RMS errors over a hundred cameras: of place in m, of rotation in degrees."""
    rng = np.random.default_rng(0)
    places, turns = [], []
    for _ in range(100):
        depth = rng.uniform(5, 20, POINTS)
        across = rng.uniform([-0.4, -0.3], [0.4, 0.3], (POINTS, 2))
        q = np.column_stack([across * depth[:, None], depth])
        R = exponential(rng.normal(0, 0.1, 3))
        c = origin_m + rng.uniform(-1, 1, 3)
        seen = FOCAL_PX * across + noise_px * rng.standard_normal((POINTS, 2))
        found, place = pose(q @ R + c, seen, c + rng.normal(0, 0.05, 3), kind)
        apart = found @ R.T
        places.append(np.linalg.norm(place - c))
        turns.append(np.degrees(np.linalg.norm(apart - apart.T) / np.sqrt(8)))
    return root_mean_square(places), root_mean_square(turns)


def depth_errors() -> Phrases:
    disparity = FOCAL_PX * BASELINE_M / DEPTH_M
    yield f"has a disparity of {disparity:.0f} px"
    lens = depth_m(disparity - 0.1) - DEPTH_M
    yield f"in one picture | {100 * lens:.1f} cm in depth at 10 m |"
    noise = DEPTH_M / disparity * np.sqrt(2) * NOISE_PX
    yield f"| {100 * noise:.0f} cm for one point, {10 * noise:.1f} cm for the mean of 100 |"
    enough = next(n for n in range(1, 100) if noise / np.sqrt(n) < lens)
    yield f"From {enough} points on, the 0.1 px"


def errors_of_a_pose() -> Phrases:
    near, far = np.zeros(3), np.array([4e5, 4e6, 100.0])
    place, turn = pose_errors(near, np.float64, NOISE_PX)
    yield f"| noise of 0.3 px in one picture | {1000 * place:.0f} mm and {turn:.2f}° in pose |"
    exact, _ = pose_errors(near, np.float64, 0.0)
    assert exact < 1e-12
    single, _ = pose_errors(near, np.float32, 0.0)
    assert 0.0003 < 1000 * single < 0.0007
    yield "| float32, the origin near the camera | 0.0005 mm in pose |"
    far_off, turned = pose_errors(far, np.float32, 0.0)
    yield f"| float32, the origin 4000 km away | {100 * far_off:.0f} cm and {turned:.1f}° in pose |"
