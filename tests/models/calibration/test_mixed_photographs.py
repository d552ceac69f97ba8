"""Photographs that one camera cannot have taken are found, and those by one are not suspected."""

from dataclasses import replace

import numpy as np
import pytest
from support.chequerboards import BENT_SIZE, BOARD, BOARD_WORLDS, SIGMA_PX, bent_views

from simulations.models.arrays import Mask
from simulations.models.calibration.camera import Poses
from simulations.models.calibration.mixed import differing
from simulations.models.calibration.model_choice import (
    best_shape,
    compare,
    shapes,
    supported,
    with_shape,
)
from simulations.models.calibration.simulated import sitting
from simulations.models.calibration.views import Views

MIXES = (
    "turned",
    "quarter turned",
    "mirrored",
    "zoom of 5 %",
    "zoom of 15 %",
    "focus of 2 %",
    "focus of 5 %",
)


def mixed(kind: str, count: int, seed: int) -> tuple[Views, Mask]:
    """Photographs, a random half of which differs, and which; those that are focused each have a
    focal length of their own, longer the nearer the board."""
    rng = np.random.default_rng((seed, count, len(kind)))
    camera, _ = bent_views({}, rng, 2)
    size = BENT_SIZE
    if kind == "quarter turned":  # of a square picture
        size = (BENT_SIZE[0], BENT_SIZE[0])
        camera = replace(camera, cy=camera.cy + 0.5 * (BENT_SIZE[0] - BENT_SIZE[1]))
    poses = sitting(camera, size, count, BOARD, int(rng.integers(10**9))).poses
    odd = rng.permutation(count) < count // 2
    longer = 1.0 + odd * float(kind.split()[-2]) / 100 if "%" in kind else np.ones(count)
    if "focus" in kind:
        distance = np.linalg.norm(poses.t, axis=1)
        longer = 1.0 + float(kind.split()[-2]) / 100 * distance.min() / distance
    board = np.broadcast_to(BOARD.indices, (count, 54, 2)).copy()
    corners = Poses(poses.R, poses.t).place(board)
    middle = (camera.cx, camera.cy)
    pixels = (camera.pixels(corners) - middle) * longer[:, None, None] + middle
    pixels += rng.normal(0.0, SIGMA_PX, pixels.shape)
    last = np.array(size) - 1.0
    if kind == "quarter turned":
        pixels[odd] = np.stack((pixels[odd, :, 1], last[1] - pixels[odd, :, 0]), axis=-1)
    if kind == "turned":
        pixels[odd] = last - pixels[odd]
    if kind == "mirrored":
        pixels[odd, :, 0] = last[0] - pixels[odd, :, 0]
        board[odd, :, 0] = board[..., 0].max() - board[odd, :, 0]
    return Views(board, pixels, np.ones(pixels.shape[:2], bool)), odd


def found(views: Views) -> tuple[int, ...]:
    """The photographs that differ, by the supported lens and board."""
    flat = compare(views, BENT_SIZE)
    shape = best_shape(shapes(views, flat))
    trials = flat if shape.shape == "flat" else with_shape(views, flat, shape)
    return differing(views, supported(trials))


def is_one_kind(named: tuple[int, ...], odd: Mask) -> bool:
    """Whether some photographs but not all are named, and all of these differ, or none does."""
    return 0 < len(named) < len(odd) and odd[[*named]].all() == odd[[*named]].any()


@pytest.mark.parametrize("kind", MIXES)
def test_mixed_photographs_are_found_and_those_of_one_half_named(kind: str) -> None:
    views, odd = mixed(kind, 12, 1)
    named = found(views)
    assert len(named) == 12 if "focus" in kind else is_one_kind(named, odd) and len(named) > 4


@pytest.mark.deep
@pytest.mark.parametrize("count", [8, 12, 20, 40])
@pytest.mark.parametrize("kind", MIXES)
def test_nine_of_ten_mixed_sets_are_found_and_one_half_named(kind: str, count: int) -> None:
    sets = [mixed(kind, count, seed) for seed in range(20)]
    every = [(found(views), odd) for views, odd in sets]
    assert np.mean([bool(named) for named, _ in every]) >= 0.9
    if "focus" not in kind:
        assert np.mean([is_one_kind(*each) for each in every]) >= 0.9


@pytest.mark.deep
@pytest.mark.parametrize("count", [8, 12, 20, 40])
def test_photographs_by_one_camera_are_not_suspected(count: int) -> None:
    suspected = [
        bool(found(bent_views(world, np.random.default_rng((seed, count, 99)), count)[1]))
        for world in BOARD_WORLDS.values()
        for seed in range(16)
    ]
    assert np.mean(suspected) < 0.02
