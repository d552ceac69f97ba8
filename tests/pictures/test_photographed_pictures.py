"""A tiled floor and a chequerboard, against projected points, samples and OpenCV."""

import math

import numpy as np
import pytest
from support.chequerboards import facing_board

from simulations.models.arrays import Floats
from simulations.models.chequerboard.board import Board
from simulations.models.color.srgb import decode_srgb
from simulations.models.distortion.lens_model import undistort
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics, project, world_to_camera
from simulations.pictures.chequerboard import Look, photograph_of
from simulations.pictures.tiled_floor import (
    BOX_PAINT,
    CREAM,
    LIGHT,
    SLATE,
    TILE_M,
    Box,
    polygon_coverage,
    tiled_floor,
    with_box,
)

WIDTH, HEIGHT = 400, 300
K = intrinsics(320.0, (200.0, 150.0))
POSE = pose_above_ground(1.6, math.radians(30), math.radians(25), math.radians(5))
FLOOR = tiled_floor(POSE, K, WIDTH, HEIGHT)
BOX = Box(2.2, 4.2, 1.0, 1.0)


def pixels(points: Floats) -> np.ndarray:
    """Rounded pixels (N, 2) of the points in front."""
    seen, valid = project(world_to_camera(points, POSE), K)
    return np.rint(seen[valid]).astype(int)


def test_centre_of_each_near_tile_has_its_colour() -> None:
    column, row = np.mgrid[-4:12, 2:14]
    middles = np.stack([column, row, np.zeros_like(row)], axis=-1).reshape(-1, 3) * TILE_M
    seen, valid = project(world_to_camera(middles, POSE), K)
    whole = np.rint(np.where(valid[:, None], seen, -9)).astype(int)
    shown = np.all((whole > 3) & (whole < (WIDTH - 4, HEIGHT - 4)), axis=-1)
    assert shown.sum() > 30
    colours = FLOOR[whole[shown, 1], whole[shown, 0]]
    light = (column + row).ravel()[shown] % 2 == 0
    nearer_cream = np.linalg.norm(colours - CREAM, axis=1) < np.linalg.norm(colours - SLATE, axis=1)
    np.testing.assert_array_equal(nearer_cream, light)


def test_picture_above_the_horizon_does_not_depend_on_the_height() -> None:
    low, high = (
        tiled_floor(pose_above_ground(height, 0.3, math.radians(10)), K, WIDTH, HEIGHT)
        for height in (1.6, 3.0)
    )
    row = 150 - 320 * math.tan(math.radians(10))
    apart = np.abs(low - high).max(axis=(1, 2))
    assert (apart[: math.floor(row)] < 1e-5).all()
    assert (apart[math.ceil(row) :] > 0.01).all()


def test_box_covers_the_area_of_its_outline() -> None:
    """The shoelace formula for the projected corners of each visible side."""
    covered = np.zeros((HEIGHT, WIDTH))
    area = 0.0
    for name in BOX.seen_from((0.0, 0.0, 1.6)):
        corners = world_to_camera(BOX.side(name), POSE)
        covered += polygon_coverage(corners, K, slice(0, HEIGHT), slice(0, WIDTH))
        x, y = project(corners, K)[0].T
        area += abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert covered.sum() == pytest.approx(area, rel=0.01)


@pytest.mark.parametrize("name", ["x0", "y0", "top"])
def test_each_side_of_the_box_has_its_light(name: str) -> None:
    picture = with_box(FLOOR, POSE, K, BOX)
    middle = BOX.side(name).mean(axis=0)
    ((column, row),) = pixels(middle[None])
    np.testing.assert_allclose(picture[row, column], np.asarray(BOX_PAINT) * LIGHT[name], rtol=1e-5)


BOARD = Board(5, 4, 20.0)
SLANTED = facing_board(BOARD, 96, 72, focal_px=90.0, tilt=(0.6, -0.5, 0.2), distance_mm=160.0)


def test_pixel_is_the_mean_of_samples_weighted_by_the_blur() -> None:
    """Gaussian weights around each pixel, with the board evaluated point by point."""
    look = Look(blur_px=0.8)
    light = decode_srgb(photograph_of(BOARD, SLANTED, look) / 255.0)
    x, y = np.meshgrid(np.arange(30.0, 46.0), np.arange(25.0, 41.0))
    total, weight = np.zeros_like(x), 0.0
    offsets = np.linspace(-3.0, 3.0, 42)
    for dx in offsets:
        for dy in offsets:
            share = np.exp(-0.5 * (dx * dx + dy * dy) / 0.8**2)
            total += share * _board_at(x + dx, y + dy, look)
            weight += share
    error = light[25:41, 30:46] - total / weight
    assert np.sqrt(np.mean(error**2)) < 0.01


def _board_at(x: np.ndarray, y: np.ndarray, look: Look) -> np.ndarray:
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
