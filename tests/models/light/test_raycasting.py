"""Rays against spheres, boxes and planes."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.rays import AHEAD, ORIGIN, rays_around, unit

from simulations.models.light.raycasting import Box, Sphere, intersect, intersect_plane


def test_sphere_is_met_one_radius_before_its_centre() -> None:
    hit = intersect(Sphere((0, 5, 0), 2.0), ORIGIN, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(3.0)
    assert hit.normals == pytest.approx([0, -1, 0])


def test_points_on_a_sphere_lie_one_radius_from_its_centre() -> None:
    sphere = Sphere((0.3, 4.0, -0.2), 0.7)
    hit = intersect(sphere, ORIGIN, rays_around(AHEAD, 0.3, 500))
    assert 50 < hit.valid.sum() < 500
    radii = np.linalg.norm(hit.points[hit.valid] - sphere.centre, axis=-1)
    assert radii == pytest.approx(0.7, abs=1e-12)


@pytest.mark.parametrize("solid", [Sphere((0, 3, 0), 1.0), Box((0, 3, 0), (2, 2, 2), 0.4)])
def test_solid_behind_the_origin_is_missed(solid: Box | Sphere) -> None:
    assert not intersect(solid, ORIGIN, -AHEAD).valid


@pytest.mark.parametrize("solid", [Sphere((0, 0, 0), 1.0), Box((0, 0, 0), (2, 2, 2))])
def test_from_inside_the_far_side_is_met(solid: Box | Sphere) -> None:
    hit = intersect(solid, ORIGIN, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(1.0)
    assert hit.normals == pytest.approx([0, 1, 0])


def test_turned_box_turns_its_normals() -> None:
    hit = intersect(Box((0, 5, 0), (2, 2, 2), math.radians(30)), ORIGIN, AHEAD)
    assert hit.normals == pytest.approx(
        [math.sin(math.radians(30)), -math.cos(math.radians(30)), 0]
    )


def test_ray_along_a_face_is_no_division_by_zero() -> None:
    hit = intersect(Box((0, 5, 0), (2, 2, 2)), (1.0, 0, 0), AHEAD)
    assert np.isfinite(hit.distance)
    assert np.isfinite(hit.points).all()


def test_a_ray_that_only_grazes_a_sphere_misses_it() -> None:
    assert not intersect(Sphere((0.0, 5.0, 2.0), 2.0), ORIGIN, AHEAD).valid


@pytest.mark.parametrize(
    "solid", [Sphere((0.0, 2.0, 0.0), 2.0), Box((0.0, 2.0, 0.0), (2.0, 4.0, 2.0))]
)
def test_from_the_surface_inwards_the_far_side_is_met(solid: Box | Sphere) -> None:
    assert intersect(solid, ORIGIN, AHEAD).distance == pytest.approx(4)


@pytest.mark.parametrize("eye", [(0.0, 0.0, 0.0), (3.0, -2.0, 0.7)])
def test_only_where_a_solid_lies_from_the_eye_matters(eye: tuple[float, float, float]) -> None:
    towards = rays_around(AHEAD, 0.3, 50)
    for make in (lambda at: Sphere(at, 0.8), lambda at: Box(at, (1.0, 1.4, 0.6), 0.3)):
        here = intersect(make((0.2, 4.0, -0.1)), ORIGIN, towards)
        there = intersect(make(tuple(np.add((0.2, 4.0, -0.1), eye))), eye, towards)
        assert there.margin == pytest.approx(here.margin)
        assert there.distance == pytest.approx(here.distance)
        assert there.points - eye == pytest.approx(here.points)


def test_a_slanted_ray_has_the_normal_of_the_face_that_it_meets_first() -> None:
    """It enters by the front face and leaves by the side; from within, by the side."""
    box = Box((0.0, 5.0, 0.0), (2.0, 4.0, 2.0))
    slanted = unit([0.9, 3.0, 0.0])
    outside = intersect(box, ORIGIN, slanted)
    assert outside.points == pytest.approx([0.9, 3, 0])
    assert outside.normals == pytest.approx([0, -1, 0])
    inside = intersect(box, (0.0, 6.0, 0.0), unit([2.0, 1.0, 0.5]))
    assert inside.points == pytest.approx([1, 6.5, 0.25])
    assert inside.normals == pytest.approx([1, 0, 0])


def test_a_box_is_met_where_its_edges_lie_along_each_axis() -> None:
    """Sizes 2, 4 and 6 about (1, 10, −1): seen from in front, above and the side."""
    box = Box((1.0, 10.0, -1.0), (2.0, 4.0, 6.0))
    for eye, towards, point in (
        ((1.5, 0.0, 0.0), (0, 1, 0), (1.5, 8, 0)),
        ((0.5, 11.0, 9.0), (0, 0, -1), (0.5, 11, 2)),
        ((-9.0, 9.0, -3.0), (1, 0, 0), (0, 9, -3)),
        ((20.0, 9.0, -3.0), (-1, 0, 0), (2, 9, -3)),
        ((1.5, 30.0, 0.0), (0, -1, 0), (1.5, 12, 0)),
        ((0.5, 11.0, -9.0), (0, 0, 1), (0.5, 11, -4)),
    ):
        hit = intersect(box, eye, np.array(towards, float))
        assert hit.valid
        assert hit.points == pytest.approx(point)
        assert hit.distance == pytest.approx(math.dist(eye, point))
        assert hit.normals == pytest.approx(-np.array(towards))


def test_from_inside_a_box_each_face_is_met_with_the_normal_that_points_out() -> None:
    box = Box((0.0, 0.0, 0.0), (2.0, 4.0, 6.0))
    directions = np.concatenate([np.eye(3), -np.eye(3)])
    hit = intersect(box, (0.1, 0.2, 0.3), directions)
    assert hit.valid.all()
    assert hit.distance == pytest.approx([0.9, 1.8, 2.7, 1.1, 2.2, 3.3])
    assert hit.normals == pytest.approx(directions)
    assert hit.margin.tolist() == [1] * 6


@settings(deadline=None, max_examples=30)
@given(angle=st.floats(-4, 4), x=st.floats(-3, 3), z=st.floats(-3, 3), seed=st.integers(0, 99))
def test_a_box_is_the_crossing_of_six_half_spaces(
    angle: float, x: float, z: float, seed: int
) -> None:
    """By walking along the ray in small steps."""
    box = Box((0.0, 5.0, 0.0), (1.0, 1.4, 0.6), angle)
    eye = np.array([x, 0.0, z])
    directions = unit(np.array([-x, 5.0, -z]) + np.random.default_rng(seed).uniform(-1, 1, (20, 3)))
    hit = intersect(box, eye, directions)
    steps = np.linspace(0, 12, 12_001)
    local = (eye + directions[:, None] * steps[:, None] - box.centre) @ box.world_to_box.T
    inside = np.all(np.abs(local) <= np.array(box.size) / 2, axis=-1)
    clear = (inside.sum(1) > 5) | (inside.sum(1) == 0) & (hit.margin < -1e-3)
    assert np.array_equal(hit.valid[clear], inside.any(1)[clear])
    first = steps[inside.argmax(1)]
    met = hit.valid & clear
    assert np.abs(hit.distance - first)[met] == pytest.approx(0, abs=2e-3)


def test_a_turned_box_turns_anticlockwise_seen_from_above() -> None:
    quarter = Box((0, 0, 0), (2, 4, 6), math.pi / 2)
    assert quarter.world_to_box @ (0, 1, 0) == pytest.approx((1, 0, 0))
    eighth = Box((0, 5, 0), (2, 2, 2), math.pi / 4)
    assert intersect(eighth, ORIGIN, AHEAD).distance == pytest.approx(5 - math.sqrt(2))


def test_a_plane_is_met_at_the_distance_of_similar_triangles() -> None:
    towards = unit(np.array([(0, 3, -4), (0, -3, -4), (0, 3, 4), (1, 0, 0)]))
    distance, valid = intersect_plane((5, 5, 1), (0, 0, 2), (0, 0, 9), towards)
    assert valid.tolist() == [True, True, False, False]
    assert distance == pytest.approx([10, 10, math.nan, math.nan], nan_ok=True)
    assert not intersect_plane((0, 0, 1), (0, 0, 1), (0, 0, 1), [0.0, 0, -1])[1]


@pytest.mark.parametrize(("slant", "valid"), [(1e-10, True), (1e-13, False)])
def test_a_ray_runs_along_a_plane_to_rounding(slant: float, valid: bool) -> None:
    assert intersect_plane((0, 0, 0), (0, 0, 1), (0, 0, 1), [1.0, 0, -slant])[1] == valid


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda: Sphere((0, 0, 0), 0.0), "radius"),
        (lambda: Sphere((0, 0, 0), math.inf), "radius"),
        (lambda: Sphere((0, math.nan, 0), 1.0), "centre"),
        (lambda: Box((0, 0, 0), (0.0, 1, 1)), "size"),
        (lambda: Box((0, 0, 0), (1, -1, 1)), "size"),
        (lambda: Box((0, 0, 0), (1, 1, math.inf)), "size"),
        (lambda: Box((math.inf, 0, 0), (1, 1, 1)), "centre"),
        (lambda: Box((0, 0, 0), (1, 1, 1), math.inf), "angle_rad"),
    ],
)
def test_solids_are_finite_and_of_some_size(make: Callable[[], object], complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        make()


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_scenes_of_any_size_are_seen_alike(size: float) -> None:
    sphere = Sphere((0.0, 0.5 * size, 0.2 * size), 0.3 * size)
    hit = intersect(sphere, ORIGIN, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx((0.5 - math.sqrt(0.05)) * size)
    box = intersect(Box((0, 0.5 * size, 0), (0.2 * size,) * 3), ORIGIN, AHEAD)
    assert box.distance == pytest.approx(0.4 * size)
    distance, valid = intersect_plane((0, 0.5 * size, 0), (0, -1, 0), ORIGIN, AHEAD)
    assert valid
    assert distance == pytest.approx(0.5 * size)


@pytest.mark.parametrize("size", [1e-60, 1.0, 1e60, 1e100])
def test_a_ball_of_any_size_is_met_at_its_surface(size: float) -> None:
    ball = Sphere((0.0, 0.0, 3.0 * size) if size < 1e100 else (0.0, 0.0, 0.0), size)
    start = (0.0, 0.0, 0.0) if size < 1e100 else (0.0, 0.0, -size)
    hit = intersect(ball, start, [[0.0, 0.0, 1.0]])
    assert hit.distance == pytest.approx([2.0 * size])
    assert hit.margin == pytest.approx([size * size])


@pytest.mark.parametrize(
    "place",
    [(2e100, 0.0, 0.0), (0.0, -2e100, 0.0), (0.0, np.inf, 0.0), (0.0, 0.0, np.nan), (0.0, 1.0)],
)
def test_places_beyond_all_squares_are_refused(place: Any) -> None:
    ball = Sphere((0.0, 0.0, 3.0), 1.0)
    for call in (
        lambda: intersect(ball, place, [[0.0, 0.0, 1.0]]),
        lambda: Sphere(place, 1.0),
        lambda: Box(place, (1.0, 1.0, 1.0)),
        lambda: Box((0.0, 0.0, 0.0), place),
    ):
        with pytest.raises(ValueError, match=r"legal: three, finite, at most 1e\+100"):
            call()


def test_a_ray_has_three_components() -> None:
    with pytest.raises(ValueError, match=r"directions of shape \(4, 2\)"):
        intersect(Sphere((0.0, 0.0, 3.0), 1.0), (0.0, 0.0, 0.0), np.ones((4, 2)))
