"""The picture of the tiled floor: its tiles, its horizon and its box lie where they project."""

import math

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics, project, world_to_camera
from simulations.pictures.tiled_floor import (
    BOX_PAINT,
    CREAM,
    LIGHT,
    SHADE,
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
    """Whole pixels (N, 2) of those points that are in front."""
    seen, valid = project(world_to_camera(points, POSE), K)
    return np.rint(seen[valid]).astype(int)


def test_the_middle_of_each_tile_near_by_has_its_colour() -> None:
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


def test_far_tiles_blend_to_their_mean() -> None:
    level = tiled_floor(pose_above_ground(1.6, 0.3, 0.0), K, WIDTH, HEIGHT)
    far = level[153, :, 0]
    assert np.ptp(far) < 0.02, "no moiré"


def test_the_sky_begins_at_the_horizon() -> None:
    """Blue over red grows from there on upwards."""
    level = tiled_floor(pose_above_ground(1.6, 0.3, math.radians(10)), K, WIDTH, HEIGHT)
    row = 150 - 320 * math.tan(math.radians(10))
    blueness = level[:, 200, 2] - level[:, 200, 0]
    assert (np.diff(blueness[: math.floor(row)]) < 0).all()
    assert np.argmax(blueness <= blueness[math.ceil(row)] + 1e-6) == math.ceil(row)


def test_the_box_covers_the_area_of_its_outline() -> None:
    """By the shoelace formula on the projected corners of each side that is seen."""
    covered = np.zeros((HEIGHT, WIDTH))
    area = 0.0
    for name in BOX.seen_from((0.0, 0.0, 1.6)):
        corners = world_to_camera(BOX.side(name), POSE)
        covered += polygon_coverage(corners, K, slice(0, HEIGHT), slice(0, WIDTH))
        x, y = project(corners, K)[0].T
        area += abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert covered.sum() == pytest.approx(area, rel=0.01)


@pytest.mark.parametrize("name", ["x0", "y0", "top"])
def test_each_side_has_its_light(name: str) -> None:
    picture = with_box(FLOOR, POSE, K, BOX)
    middle = BOX.side(name).mean(axis=0)
    ((column, row),) = pixels(middle[None])
    np.testing.assert_allclose(picture[row, column], np.asarray(BOX_PAINT) * LIGHT[name], rtol=1e-5)


def test_the_shadow_lies_on_the_floor_beside_the_box() -> None:
    picture = with_box(FLOOR, POSE, K, BOX)
    ((column, row),) = pixels(np.array([[3.0, 3.9, 0.0]]))
    np.testing.assert_allclose(picture[row, column], FLOOR[row, column] * SHADE, rtol=1e-5)


def test_a_box_partly_behind_the_camera_hides_what_is_behind_it() -> None:
    """It stands to the right, from behind the camera's plane to far in front of it."""
    wall = Box(3.0, 0.0, 5.0, 3.0)
    level = pose_above_ground(1.6, 0.0, 0.0)
    picture = with_box(tiled_floor(level, K, WIDTH, HEIGHT), level, K, wall)
    side = np.asarray(BOX_PAINT) * LIGHT["x0"]
    edge, _ = project(world_to_camera([0.5, 2.5, 1.6], level), K)
    assert picture[150, math.ceil(edge[0]) + 1] == pytest.approx(side, rel=1e-5)
    assert not np.allclose(picture[150, math.floor(edge[0]) - 1], side, rtol=1e-3)


def test_a_box_behind_the_camera_leaves_the_picture_alone() -> None:
    np.testing.assert_array_equal(with_box(FLOOR, POSE, K, Box(-2.0, -9.0, 1.0, 1.0)), FLOOR)


def test_sides_that_are_seen_edge_on_cover_nothing() -> None:
    """In the planes of its top and of its left side, the eye sees the front alone."""
    level = pose_above_ground(1.6, math.radians(10), 0.0)
    floor, box = tiled_floor(level, K, WIDTH, HEIGHT), Box(0.5, 4.2, 1.0, 1.6)
    picture = with_box(floor, level, K, box)
    corners, _ = project(world_to_camera(box.side("y0"), level), K)
    low, high = np.floor(corners.min(axis=0)), np.ceil(corners.max(axis=0))
    np.testing.assert_array_equal(picture[:, : int(low[0])], floor[:, : int(low[0])])
    np.testing.assert_array_equal(picture[: int(low[1])], floor[: int(low[1])])
    below = np.s_[int(high[1]) - 2, int(high[0]) - 4]
    np.testing.assert_allclose(picture[below], floor[below] * SHADE, rtol=1e-5)


def test_a_box_has_the_colour_of_its_paint() -> None:
    pose, centred = pose_above_ground(1.5, 0.0, 0.0), intrinsics(160.0, (99.5, 74.5))
    floor = tiled_floor(pose, centred, 200, 150)
    blue = with_box(floor, pose, centred, Box(0.0, 6.0, 2.0, 3.0, (0.1, 0.2, 0.4)))
    np.testing.assert_allclose(blue[75, 100] / blue[75, 100, 2], (0.25, 0.5, 1.0), rtol=1e-3)
