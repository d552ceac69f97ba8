"""Lengths on floor and wall from a known one: exact, and as uncertain as they say."""

import math

import numpy as np
import pytest
from support.drawn_lines import HEIGHT, SIZE, drawn, floor_point, seen, some_pose

from simulations.models.arrays import Floats
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.single_view import SingleView, fit_view
from simulations.models.projection.single_view_lengths import Measured, Stretch, measured

POSE = pose_above_ground(HEIGHT, 0.6, 0.3, 0.05)
VIEW = fit_view(*drawn(POSE, np.random.default_rng(1)), SIZE, 1e-3)


def stretch(start: Floats, end: Floats, pose: Floats = POSE) -> Stretch:
    kind = "above" if end[2] - start[2] > 1e-9 else "within"
    return Stretch(seen(np.array([start, end]), pose), kind)


def raised(foot: Floats, height: float) -> Floats:
    return foot + np.array([0.0, 0.0, height])


A, B, C = np.array([[1.0, 3.0, 0.0], [3.0, 4.0, 0.0], [2.0, 6.0, 0.0]])


def test_a_known_length_on_the_floor_gives_all_others() -> None:
    known, others = stretch(A, B), (stretch(A, C), stretch(C, raised(C, 1.8)))
    found = measured(VIEW, known, math.sqrt(5.0), others)
    np.testing.assert_allclose(found.metres, (math.sqrt(10.0), 1.8), rtol=1e-5)
    assert found.distance == pytest.approx(HEIGHT, rel=1e-5)


def test_a_known_height_does_as_well() -> None:
    known = stretch(B, raised(B, 1.2))
    found = measured(VIEW, known, 1.2, (stretch(A, C), stretch(C, raised(C, 2.5))))
    np.testing.assert_allclose(found.metres, (math.sqrt(10.0), 2.5), rtol=1e-5)


@pytest.mark.parametrize(("normal", "across"), [(0, (0.0, 1.0, 1.0)), (1, (1.0, 0.0, 1.0))])
def test_a_wall_is_a_plane_like_the_floor(normal: int, across: tuple[float, ...]) -> None:
    corner = np.array([2.5, 5.0, 0.3])
    diagonal, out = np.array(across), np.eye(3)[normal]
    ends = [(corner, corner + diagonal), (corner, corner + 0.5 * diagonal), (corner, corner - out)]
    known, other, shelf = (seen(np.array(pair), POSE) for pair in ends)
    found = measured(
        VIEW,
        Stretch(known),
        math.sqrt(2.0),
        (Stretch(other), Stretch(shelf, "above")),
        normal=normal,
    )
    np.testing.assert_allclose(found.metres, (math.sqrt(0.5), 1.0), rtol=1e-5)
    assert found.distance == pytest.approx(corner[normal], rel=1e-5)


def noisy(seed: int) -> tuple[Measured, Floats]:
    rng = np.random.default_rng(seed)
    pose = some_pose(rng)
    ends, axes = drawn(pose, rng)
    view = fit_view(ends + rng.normal(0, 1, ends.shape), axes, SIZE, 1.0)
    a, b, c, d, e = (floor_point(pose, rng) for _ in range(5))
    true = (stretch(a, b, pose), stretch(c, d, pose), stretch(e, raised(e, 1.0), pose))
    known, *others = (Stretch(each.ends + rng.normal(0, 1, (2, 2)), each.kind) for each in true)
    found = measured(view, known, math.dist(a, b), tuple(others), 1.0)
    return found, np.array([math.dist(c, d), 1.0, HEIGHT])


def test_the_truth_is_inside_the_stated_interval_as_often_as_stated() -> None:
    scores = []
    for seed in range(80):
        found, truth = noisy(seed)
        values = np.append(found.metres, found.distance)
        scores.append((values - truth) / np.append(found.errors, found.distance_error))
    one, two = ((np.abs(scores) < share).mean(axis=0) for share in (1.0, 1.96))
    assert ((one > 0.56) & (one < 0.8)).all()  # of 0.683
    assert ((two > 0.88) & (two <= 1.0)).all()  # of 0.95


def one_point(seed: int) -> SingleView:
    rng = np.random.default_rng(seed)
    ends, axes = drawn(pose_above_ground(HEIGHT, 0.0, 0.0), rng)
    return fit_view(ends + rng.normal(0, 1, ends.shape), axes, SIZE)


@pytest.mark.parametrize("seed", range(3))
def test_with_one_vanishing_point_widths_and_heights_are_known_and_depths_are_not(
    seed: int,
) -> None:
    level = pose_above_ground(HEIGHT, 0.0, 0.0)
    left, right, far = np.array([[-1.0, 4.0, 0.0], [1.0, 4.0, 0.0], [1.0, 6.0, 0.0]])
    others = (
        stretch(far - np.array([2.0, 0.0, 0.0]), far, level),
        stretch(far, raised(far, 1.0), level),
        stretch(right, far, level),
    )
    found = measured(one_point(seed), stretch(left, right, level), 2.0, others)
    relative = found.errors / found.metres
    np.testing.assert_allclose(found.metres[:2], (2.0, 1.0), rtol=0.05)
    assert (relative[:2] < 0.1).all()
    assert relative[2] > 0.5


def test_what_is_beyond_the_horizon_has_no_length() -> None:
    sky = Stretch(np.array([[400.0, 20.0], [500.0, 20.0]]))
    found = measured(VIEW, stretch(A, B), math.sqrt(5.0), (sky, stretch(A, C)))
    assert np.isnan(found.metres[0])
    assert found.metres[1] == pytest.approx(math.sqrt(10.0), rel=1e-5)
    across = Stretch(np.array([[400.0, 500.0], [500.0, 20.0]]))
    with pytest.raises(ValueError, match="horizon"):
        measured(VIEW, across, 1.0, ())


def test_what_is_no_length_is_refused() -> None:
    for metres in (0.0, -1.0, math.inf, math.nan):
        with pytest.raises(ValueError, match="known_metres"):
            measured(VIEW, stretch(A, B), metres, ())
    with pytest.raises(ValueError, match="two ends"):
        measured(VIEW, Stretch(np.ones((2, 2)) * 400.0), 1.0, ())
    with pytest.raises(ValueError, match="kind"):
        Stretch(np.zeros((2, 2)), "beside")
