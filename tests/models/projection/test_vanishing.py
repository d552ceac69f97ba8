"""Where parallel lines and planes vanish: points, horizons, and those that have none."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from simulations.models.projection import pinhole, vanishing

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
RNG = np.random.default_rng(2)


def test_parallel_lines_meet_in_their_vanishing_point() -> None:
    direction = np.array([1.0, -0.3, 2.0])
    expected, valid = vanishing.vanishing_point(direction, K)
    far = pinhole.project(np.array([[0, 0, 5.0], [3, 1, 5.0]]) + 1e12 * direction, K)[0]
    assert valid
    assert far == pytest.approx(np.array([expected, expected]), abs=1e-6)
    assert vanishing.vanishing_point(-direction, K)[0] == pytest.approx(expected)


def test_lines_parallel_to_the_picture_do_not_vanish() -> None:
    _, valid = vanishing.vanishing_point([(1, 0, 0), (0, 0, 0), (0, 0, 1)], K)
    assert valid.tolist() == [False, False, True]


def test_all_directions_of_a_plane_vanish_on_its_horizon() -> None:
    normal = np.array([0.1, 1.0, 0.2])
    line, valid = vanishing.horizon(normal, K)
    directions = np.cross(normal, RNG.normal(size=(20, 3)))
    pixels, _ = vanishing.vanishing_point(directions, K)
    assert valid
    assert math.hypot(line[0], line[1]) == pytest.approx(1.0)
    assert pixels @ line[:2] + line[2] == pytest.approx(np.zeros(20), abs=1e-8)


def test_a_wall_parallel_to_the_picture_has_no_horizon() -> None:
    line, valid = vanishing.horizon((0, 0, 1), K)
    assert not valid
    assert np.isnan(line).all()


def test_the_horizon_of_the_ground_lies_level_through_the_principal_point() -> None:
    line, valid = vanishing.horizon((0, 1, 0), K)
    assert valid
    assert line == pytest.approx((0, 1, -240))
    tilted, _ = vanishing.horizon((0, math.cos(0.1), math.sin(0.1)), K)
    assert tilted @ (320, 240 - 410 * math.tan(0.1), 1) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("normal", [(0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 1)])
def test_what_is_no_plane_has_no_horizon(normal: Sequence[float]) -> None:
    assert not vanishing.horizon(normal, K)[1]


@pytest.mark.parametrize("size", [1e-300, 1e300])
def test_the_length_of_directions_and_normals_does_not_matter(size: float) -> None:
    direction, normal = np.array([1.0, -0.3, 2.0]), np.array([0.1, 1.0, 0.2])
    assert vanishing.vanishing_point(size * direction, K)[0] == pytest.approx(
        vanishing.vanishing_point(direction, K)[0]
    )
    assert vanishing.horizon(size * normal, K)[0] == pytest.approx(vanishing.horizon(normal, K)[0])


def test_directions_vanish_each_on_their_own() -> None:
    directions = [(1, 0, 1), (math.inf, 0, 1), (math.nan, 0, 1), (0, 1, 1), (0, 0, 0.0)]
    pixels, valid = vanishing.vanishing_point(directions, K)
    assert valid.tolist() == [True, False, False, True, False]
    assert pixels[0] == pytest.approx((720, 240))
    assert pixels[3] == pytest.approx((322, 650))
    assert np.isnan(pixels[~valid]).all()


@pytest.mark.parametrize(("slant", "valid"), [(1e-10, True), (1e-17, False)])
def test_a_horizon_is_lost_where_only_rounding_is_left_of_it(slant: float, valid: bool) -> None:
    assert vanishing.horizon((slant, 0, 1), pinhole.intrinsics(1.0, (0, 0)))[1] is valid


def test_directions_with_a_large_negative_entry_are_scaled_by_its_size() -> None:
    pixels, valid = vanishing.vanishing_point([(-1e300, 0.5e300, 1e300), (-1e-300, 0, 2e-300)], K)
    assert valid.all()
    assert pixels == pytest.approx(np.array([(320 - 400 + 1, 240 + 205), (320 - 200, 240)]))
    line, seen = vanishing.horizon((-1e300, -2e-10, 1.0), K)
    assert seen
    assert line == pytest.approx(vanishing.horizon((1, 0, 0), K)[0] * -1, abs=1e-9)


def test_no_horizon_is_a_line_of_nothing() -> None:
    line, valid = vanishing.horizon((0, 0, -1), K)
    assert not valid
    assert line.shape == (3,)


def test_a_direction_of_which_one_pixel_coordinate_is_no_number_has_no_pixel() -> None:
    assert not vanishing.vanishing_point((1e300, 0, 1e-20), K)[1]


def test_lines_and_planes_vanish_where_their_opposites_do() -> None:
    assert vanishing.vanishing_point((-1.0, -2.0, -4.0), K)[0] == pytest.approx(
        vanishing.vanishing_point((1.0, 2.0, 4.0), K)[0]
    )
    assert not vanishing.horizon((1e-17, 0, -1), pinhole.intrinsics(1.0, (0, 0)))[1]


def test_the_angle_between_lines_is_read_off_where_they_vanish() -> None:
    first, second = RNG.normal(size=(2, 20, 3))
    cosines = (first * second).sum(axis=1) / np.prod(
        np.linalg.norm((first, second), axis=2), axis=0
    )
    angles = vanishing.angle_between(first @ K.T, second @ K.T, K)
    assert angles == pytest.approx(np.arccos(np.abs(cosines)))


def test_a_direction_across_the_camera_vanishes_at_infinity_and_has_its_angle() -> None:
    sixty = (
        math.cos(math.pi / 3) * 400.0 + 320.0 * math.sin(math.pi / 3),
        240.0 * math.sin(math.pi / 3),
    )
    assert vanishing.angle_between(
        (400, 0, 0), (*sixty, math.sin(math.pi / 3)), K
    ) == pytest.approx(math.pi / 3)


@pytest.mark.parametrize("none", [(0, 0, 0), (math.nan, 0, 1), (math.inf, 1, 1)])
def test_what_is_no_point_has_no_angle(none: Sequence[float]) -> None:
    assert np.isnan(vanishing.angle_between(none, (1, 2, 1), K))
