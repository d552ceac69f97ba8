"""Calibration with a bent board against OpenCV with freed corners, and its derivatives."""

import cv2
import numpy as np
import pytest
from support.chequerboards import BENT_SIZE, BOARD_WORLDS, SIDE_MM, bent_views

from simulations.models.arrays import Floats
from simulations.models.calibration.board_shape import SHAPES, Shape, flat_shape
from simulations.models.calibration.bundle_adjustment import linearise
from simulations.models.calibration.camera import PINHOLE, Poses
from simulations.models.calibration.model_choice import (
    best_shape,
    compare,
    shapes,
    supported,
    with_shape,
)
from simulations.models.calibration.shape_size import measure_shape, stretched
from simulations.models.calibration.simulated import sitting
from simulations.models.chequerboard.board import Board


@pytest.mark.parametrize(
    ("world", "shape"),
    [
        ("sag of 0.5 mm", "bent"),
        ("sag of 2 mm", "bent"),
        ("squares 2 % too high", "bent"),
        ("buckled by 2 mm", "warped"),
    ],
)
def test_board_shape_is_found_and_fits_as_well_as_freed_corners(world: str, shape: str) -> None:
    camera, views = bent_views(BOARD_WORLDS[world], np.random.default_rng(11))
    flat = compare(views, BENT_SIZE)
    chosen = best_shape(shapes(views, flat))
    assert chosen.shape == shape
    trial = supported(with_shape(views, flat, chosen))
    off = abs(supported(flat).fit.camera.fx - camera.fx)
    assert off > 3.0 * np.sqrt(supported(flat).uncertainty.covariance[0, 0])
    board = [np.c_[b, np.zeros(len(b))].astype(np.float32) for b in views.board]
    found = [p.astype(np.float32) for p in views.pixels]
    rms, K, *_ = cv2.calibrateCameraRO(
        board, found, BENT_SIZE, 8, None, None, flags=cv2.CALIB_FIX_K3, criteria=(3, 200, 1e-12)
    )
    error = trial.uncertainty.errors["fx"]
    assert trial.fit.camera.fx == pytest.approx(camera.fx, abs=3.0 * error)
    # freed corners absorb some of the noise too, and three of them are fixed to a plane
    assert rms * 0.95 < trial.rms_px < 1.15 * rms
    assert trial.fit.camera.fx == pytest.approx(K[0, 0], abs=4.0 * error)


def test_sag_and_aspect_are_measured_and_a_stretched_picture_is_noted() -> None:
    rng = np.random.default_rng(3)
    for world, height_mm, aspect in (("sag of 2 mm", None, 1.0), ("squares 2 % too high", 0, 1.02)):
        _, views = bent_views(BOARD_WORLDS[world], rng)
        flat = compare(views, BENT_SIZE)
        board = measure_shape(views, best_shape(shapes(views, flat)))
        assert board.aspect == pytest.approx(aspect, abs=4.0 * board.aspect_error)
        if height_mm is None:
            assert 0.5 < SIDE_MM * board.height < 2.5
        else:
            assert board.height < 5.0 * board.height_error
        assert bool(stretched(flat[-1])) == (aspect != 1.0)


STEP = 1e-6


@pytest.mark.parametrize("name", ["bent", "warped"])
def test_shape_derivatives_agree_with_differences_of_residuals(name: str) -> None:
    camera, views = bent_views({}, np.random.default_rng(1), count=3)
    start = flat_shape(name, views)
    poses = sitting(camera, BENT_SIZE, 3, Board(), 2).poses
    values = np.random.default_rng(0).normal(0.0, 0.02, len(start.terms))

    def at(step: np.ndarray) -> Poses:
        return Poses(poses.R, poses.t, start.moved(values + step))

    free = PINHOLE + start.names
    exact = linearise(views, camera, at(0.0 * values), free).by_camera[..., len(PINHOLE) :]
    for index, step in enumerate(STEP * np.eye(len(values))):
        ahead, back = (linearise(views, camera, at(s), free).residual for s in (step, -step))
        assert exact[..., index] == pytest.approx((ahead - back) / (2 * STEP), rel=1e-5, abs=1e-4)


def test_shape_terms_are_independent_of_shift_rotation_and_scale() -> None:
    board = Board().indices
    u, v, one = board[:, 0] - 4.0, board[:, 1] - 2.5, np.ones(54)
    none = 0.0 * one
    moves: list[tuple[Floats, ...]] = [
        (one, none, none),
        (none, one, none),
        (none, none, one),
        (none, none, u),
    ]
    moves += [(none, none, v), (-v, u, none), (u, v, none)]
    for terms in filter(None, SHAPES.values()):
        shape = Shape(terms, (1.0,) * len(terms), (4.0, 2.5), 4.0)
        columns = [np.concatenate(move) for move in moves]
        for (axis, _, _), power in zip(terms, shape.powers(board).T, strict=True):
            columns.append(np.concatenate([power * (axis == along) for along in range(3)]))
        system = np.stack([column / np.linalg.norm(column) for column in columns], axis=-1)
        assert np.linalg.matrix_rank(system, tol=1e-3) == 7 + len(terms)
