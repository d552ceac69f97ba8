"""Lines and planes against null spaces, linear systems and scikit-image."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.lines_and_planes import (
    intersection,
    line_through,
    plane_through,
    signed_distance,
)

coordinate = st.floats(-100.0, 100.0)
point = st.tuples(coordinate, coordinate)
RNG = np.random.default_rng(0)


def null_space(rows: ArrayLike) -> Floats:
    """The direction (n + 1,) that all homogeneous points (N, n) are orthogonal to."""
    points = np.asarray(rows, float)
    return np.linalg.svd(np.column_stack([points, np.ones(len(points))]))[2][-1]


def same(ours: Floats, theirs: Floats) -> bool:
    """Equal up to scale and sign."""
    theirs = theirs / np.linalg.norm(theirs[:-1])
    return np.allclose(ours, theirs * np.sign(theirs[:-1] @ ours[:-1]), atol=1e-9)


@given(point, point)
def test_line_is_the_null_space_of_its_points(
    p: tuple[float, float], q: tuple[float, float]
) -> None:
    assume(np.hypot(p[0] - q[0], p[1] - q[1]) > 1e-3)
    line, valid = line_through(p, q)
    assert valid
    assert np.hypot(*line[:2]) == pytest.approx(1.0, abs=1e-15)
    np.testing.assert_allclose(np.array([p, q]) @ line[:2] + line[2], 0.0, atol=1e-12)
    assert same(line, null_space([p, q]))


@given(point, point, point, point)
def test_lines_meet_at_the_solution_of_the_linear_system(
    p: tuple[float, float], q: tuple[float, float], r: tuple[float, float], s: tuple[float, float]
) -> None:
    """For lines that are not too nearly parallel."""
    steps = np.subtract(q, p), np.subtract(s, r)
    lengths = [np.linalg.norm(step) for step in steps]
    assume(min(lengths) > 0.1)
    assume(abs(np.linalg.det(steps)) > 1e-3 * lengths[0] * lengths[1])
    (first, second), _ = line_through([p, r], [q, s])
    meet, valid = intersection(first, second)
    assert valid
    share = np.linalg.solve(np.column_stack([steps[0], -steps[1]]), np.subtract(r, p))[0]
    np.testing.assert_allclose(meet, np.asarray(p) + share * steps[0], rtol=1e-8, atol=1e-7)


def test_sign_of_the_distance_depends_on_the_side() -> None:
    line, _ = line_through([0.0, 0.0], [2.0, 0.0])
    assert signed_distance([[5.0, 3.0], [5.0, -3.0]], line).tolist() == [3.0, -3.0]
    plane, _ = plane_through([0.0, 0, 0], [1, 0, 0], [0, 1, 0])
    assert signed_distance([[5.0, 3.0, 2.0], [5.0, 3.0, -2.0]], plane).tolist() == [2.0, -2.0]


def test_planes_are_the_null_spaces_of_their_points() -> None:
    for corners in RNG.uniform(-5, 5, (20, 3, 3)):
        plane, valid = plane_through(*corners)
        assert valid
        assert same(plane, null_space(corners))


@pytest.mark.parametrize(
    ("line", "other"),
    [
        pytest.param([3.0, 4.0, 5.0], [3.0, 4.0, -8.0], id="parallel"),
        pytest.param([3.0, 4.0, 5.0], [3.0, 4.0 * (1 + 2e-15), 5.0], id="parallel-to-rounding"),
        pytest.param([3.0, 4.0, 5.0], [0.0, 0.0, 0.0], id="none"),
        pytest.param([3.0, 4.0, 5.0], [np.nan, 1.0, 1.0], id="undefined"),
        pytest.param([3.0, 4.0, 5.0], [0.0, 1e-300, 1e300], id="beyond-all-numbers"),
        pytest.param([3.0, 4.0, 5.0], [3.0, 4.0 + 1e-5, 1e308], id="beyond-on-one-axis"),
        pytest.param([0.0, 1.0, 0.0], [1e-5, 1.0, -1e306], id="beyond-along-x"),
        pytest.param([0.0, 1.0, -1.0], [1e-13, -1.0, -1e300], id="beyond-along-x-from-below"),
    ],
)
def test_parallel_or_undefined_lines_have_no_intersection(
    line: list[float], other: list[float]
) -> None:
    meet, valid = intersection(line, other)
    assert not valid
    assert np.isnan(meet).all()


def test_points_on_one_line_span_no_plane() -> None:
    third = [[0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [np.inf, 0.0, 1.0]]
    planes, valid = plane_through([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], third)
    assert valid.tolist() == [True, False, False, False]
    assert planes[0].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert np.isnan(planes[1:]).all()


LOWEST, HIGHEST = (-1.0, 0.0), (3.0, 2.0)


@pytest.mark.parametrize(
    ("line", "ends"),
    [
        ((0, 1, -1.5), [(-1, 1.5), (3, 1.5)]),
        ((-2, 0, 1), [(0.5, 0), (0.5, 2)]),
        ((1, 1, -2), [(0, 2), (2, 0)]),
        ((0, 3, 0), [(-1, 0), (3, 0)]),
        ((1, 0, -3), [(3, 0), (3, 2)]),
        ((1, -2, 1), [(-1, 0), (3, 2)]),
    ],
    ids=["level", "upright", "slanted", "lower side", "right side", "diagonal"],
)
@pytest.mark.parametrize("factor", [1.0, -1.0, 1e-200, -3e150])
def test_line_of_any_direction_and_scale_ends_on_the_border(
    line: tuple[float, ...], ends: list[tuple[float, float]], factor: float
) -> None:
    found = line_in_rectangle(np.multiply(line, factor), LOWEST, HIGHEST)
    assert found == pytest.approx(np.array(ends, float), abs=1e-12)


@pytest.mark.parametrize(
    "line",
    [(0, 1, -2.5), (1, 0, 2), (1, 1, 1), (0, 0, 1), (0, 0, 0), (1, math.nan, 0), (math.inf, 1, 0)],
    ids=["above", "beside", "touching a corner", "at infinity", "zeros", "nan", "inf"],
)
def test_line_that_misses_the_rectangle_or_is_undefined_is_empty(line: tuple[float, ...]) -> None:
    assert line_in_rectangle(line, LOWEST, HIGHEST).shape == (0, 2)
