"""Simulated photographs of a chequerboard, beside samples within each pixel and OpenCV."""

import cv2
import numpy as np
import pytest
from support.boards import facing_board

from simulations.models.chequerboard.board import Board
from simulations.models.color.srgb import decode_srgb
from simulations.models.distortion.lens_model import Distortion, undistort
from simulations.models.geometry.rotations import logarithm
from simulations.pictures.chequerboard import Glare, Look, photograph_of, true_corners

BOARD = Board(5, 4, 20.0)
SLANTED = facing_board(BOARD, 96, 72, focal_px=90.0, tilt=(0.6, -0.5, 0.2), distance_mm=160.0)


def test_corners_are_where_opencv_projects_them() -> None:
    rotation = logarithm(SLANTED.board_to_camera[:3, :3])
    lens = np.array(SLANTED.lens.opencv)
    oracle, _ = cv2.projectPoints(
        BOARD.points_mm, rotation, SLANTED.board_to_camera[:3, 3], SLANTED.K, lens
    )
    assert np.abs(oracle[:, 0] - true_corners(BOARD, SLANTED)).max() < 1e-9


def test_pixels_are_the_mean_of_samples_under_the_blur() -> None:
    """Normal offsets about each pixel, and the board looked up point by point."""
    look = Look(blur_px=0.8)
    light = decode_srgb(photograph_of(BOARD, SLANTED, look) / 255.0)
    x, y = np.meshgrid(np.arange(30.0, 46.0), np.arange(25.0, 41.0))
    total, weight = np.zeros_like(x), 0.0
    offsets = np.linspace(-3.0, 3.0, 42)
    for dx in offsets:
        for dy in offsets:
            share = np.exp(-0.5 * (dx * dx + dy * dy) / 0.8**2)
            total += share * _looked_up(x + dx, y + dy, look)
            weight += share
    error = light[25:41, 30:46] - total / weight
    assert np.sqrt(np.mean(error**2)) < 0.01


def _looked_up(x: np.ndarray, y: np.ndarray, look: Look) -> np.ndarray:
    ideal, _ = undistort((np.stack([x, y], -1) - SLANTED.K[:2, 2]) / SLANTED.K[0, 0], SLANTED.lens)
    pose = SLANTED.board_to_camera
    place = (
        np.concatenate([ideal, np.ones((*x.shape, 1))], -1)
        @ np.linalg.inv(pose[:, [0, 1, 3]][:3]).T
    )
    u, v = (place[..., axis] / place[..., 2] / BOARD.side_mm + 1.0 for axis in range(2))
    dark = (np.floor(u) + np.floor(v)) % 2 == 0
    board = (u > 0) & (u < BOARD.across) & (v > 0) & (v < BOARD.down)
    sheet = (u > -1) & (u < BOARD.across + 1) & (v > -1) & (v < BOARD.down + 1)
    return np.where(board & dark, look.ink, np.where(sheet, look.paper, look.around))


def test_the_square_before_the_first_corner_is_dark() -> None:
    view = facing_board(BOARD, 96, 72, focal_px=90.0, tilt=(0.0, 0.0, 0.0), distance_mm=150.0)
    picture = photograph_of(BOARD, view)
    x, y = np.rint(true_corners(BOARD, view)[0] - 3.0).astype(int)
    assert picture[y, x] < 80 < picture[y, x + 6]


def test_glare_and_shading_change_the_light_where_they_are() -> None:
    plain = photograph_of(BOARD, SLANTED).astype(int)
    glared = photograph_of(BOARD, SLANTED, Look(glare=Glare(20.0, 30.0, 4.0)))
    assert glared[30, 20] == 255
    assert np.array_equal(glared[:, 60:], plain[:, 60:])
    shaded = photograph_of(BOARD, SLANTED, Look(shading=0.5))
    assert np.array_equal(shaded[:, 0], plain[:, 0])
    assert np.all(shaded[:, -1] < plain[:, -1])


def test_noise_follows_its_seed_and_has_its_size() -> None:
    first, again, other = (
        photograph_of(BOARD, SLANTED, Look(noise_codes=2.0, seed=seed)) for seed in (1, 1, 2)
    )
    assert np.array_equal(first, again)
    assert np.std(first.astype(float) - other) == pytest.approx(2.0 * np.sqrt(2.0), rel=0.05)


def test_a_board_behind_the_camera_is_not_in_the_picture() -> None:
    view = facing_board(BOARD, 64, 48, focal_px=60.0, tilt=(0.1, 0.1, 0.0), distance_mm=-200.0)
    picture = photograph_of(BOARD, view)
    assert np.ptp(picture) == 0
    assert np.isnan(true_corners(BOARD, view)).all()


def test_a_strong_barrel_that_folds_leaves_its_surroundings_plain() -> None:
    view = facing_board(
        BOARD,
        96,
        72,
        focal_px=40.0,
        tilt=(0.0, 0.0, 0.0),
        distance_mm=150.0,
        lens=Distortion(k1=-0.3),
    )
    assert photograph_of(BOARD, view)[0, 0] == photograph_of(BOARD, view)[0, -1]


@pytest.mark.parametrize("blur", [0.0, -1.0, np.nan])
def test_a_blur_that_is_none_is_refused(blur: float) -> None:
    with pytest.raises(ValueError, match="blur_px"):
        photograph_of(BOARD, SLANTED, Look(blur_px=blur))
