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


NOWHERE = (math.nan, math.nan)


@pytest.mark.parametrize(
    ("direction", "pixel"),
    [
        *(((s, 0, s), (720, 240)) for s in (1, -1, 1e-300, 1e300)),
        ((0, 1, 1), (322, 650)),
        ((-1e300, 0.5e300, 1e300), (320 - 400 + 1, 240 + 205)),
        ((-1e-300, 0, 2e-300), (320 - 200, 240)),
        *((d, NOWHERE) for d in ((1, 0, 0), (0, 0, 0), (math.inf, 0, 1), (math.nan, 0, 1))),
        ((1e300, 0, 1e-20), NOWHERE),
    ],
)
def test_directions_that_meet_the_picture_vanish_in_it(
    direction: Sequence[float], pixel: Sequence[float]
) -> None:
    found, valid = vanishing.vanishing_point(direction, K)
    assert valid == np.isfinite(pixel).all()
    assert found == pytest.approx(pixel, nan_ok=True)


@pytest.mark.parametrize("size", [-1.0, 1e-300, 1e300])
def test_the_length_of_a_normal_does_not_matter(size: float) -> None:
    normal = np.array([0.1, 1.0, 0.2])
    expected = np.sign(size) * vanishing.horizon(normal, K)[0]
    assert vanishing.horizon(size * normal, K)[0] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("normal", "valid"),
    [
        *(
            (n, False)
            for n in ((0, 0, 1), (0, 0, -1), (0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 1))
        ),
        ((1e-10, 0, 1), True),
        ((1e-17, 0, 1), False),  # only rounding is left of it
        ((1e-17, 0, -1), False),
        ((-1e300, -2e-10, 1.0), True),
    ],
)
def test_a_plane_has_a_horizon_unless_it_is_parallel_to_the_picture_or_none(
    normal: Sequence[float], valid: bool
) -> None:
    line, seen = vanishing.horizon(normal, pinhole.intrinsics(1.0, (0, 0)))
    assert seen == valid
    assert np.isnan(line).all() != valid


def test_all_directions_of_a_plane_vanish_on_its_horizon() -> None:
    normal = np.array([0.1, 1.0, 0.2])
    line, valid = vanishing.horizon(normal, K)
    directions = np.cross(normal, RNG.normal(size=(20, 3)))
    pixels, _ = vanishing.vanishing_point(directions, K)
    assert valid
    assert math.hypot(line[0], line[1]) == pytest.approx(1.0)
    assert pixels @ line[:2] + line[2] == pytest.approx(np.zeros(20), abs=1e-8)


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
