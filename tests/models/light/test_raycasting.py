"""Rays against spheres, boxes and planes."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.rays import AHEAD, ORIGIN, rays_around, unit

from simulations.models.light.raycasting import (
    Box,
    Sphere,
    face_margins,
    intersect,
    intersect_plane,
)

BALL, CUBE = Sphere((0, 5, 0), 2.0), Box((0, 5, 0), (2, 4, 2))


@pytest.mark.parametrize("eye", [(0.0, 0.0, 0.0), (3.0, -2.0, 0.75)])
@pytest.mark.parametrize("size", [1.0, 2.0**-10, 1024.0])
@pytest.mark.parametrize("kind", [Sphere, Box])
@pytest.mark.parametrize(
    ("start", "distance", "facing"),
    [(0, 3, -1), (3, 4, 1), (4, 3, 1), (5, 2, 1)],
    ids=["outside", "surface", "inside", "middle"],
)
def test_a_solid_is_met_at_its_surface_at_any_size_and_place(
    kind: type, start: float, distance: float, facing: int, size: float, eye: tuple[float, ...]
) -> None:
    """Of half a size of 2 along the ray, in numbers that floats hold exactly."""
    at, (x, y, z) = np.array(eye), eye
    solid = kind((x, y + 5 * size, z), 2 * size if kind is Sphere else (size, 4 * size, size))
    hit = intersect(solid, at + start * size * AHEAD, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(distance * size)
    assert hit.normals == pytest.approx([0, facing, 0])


@pytest.mark.parametrize("size", [1e-60, 1.0, 1e60])
def test_a_ball_of_any_size_is_met_at_its_distance(size: float) -> None:
    hit = intersect(Sphere((0.0, 3.0 * size, 0.0), size), ORIGIN, AHEAD)
    assert hit.distance == pytest.approx(2.0 * size)
    assert hit.margin == pytest.approx(size * size)


@pytest.mark.parametrize("solid", [BALL, CUBE, Sphere((0.0, 5.0, 2.0), 2.0)])
def test_what_lies_behind_or_is_only_grazed_is_missed(solid: Box | Sphere) -> None:
    assert not intersect(solid, ORIGIN, -AHEAD).valid
    assert intersect(solid, ORIGIN, AHEAD).valid == (solid.centre[2] == 0)


def test_points_on_a_sphere_lie_one_radius_from_its_centre() -> None:
    sphere = Sphere((0.3, 4.0, -0.2), 0.7)
    hit = intersect(sphere, ORIGIN, rays_around(AHEAD, 0.3, 500))
    assert 50 < hit.valid.sum() < 500
    radii = np.linalg.norm(hit.points[hit.valid] - sphere.centre, axis=-1)
    assert radii == pytest.approx(0.7, abs=1e-12)


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
    twelfth = intersect(Box((0, 5, 0), (2, 2, 2), math.pi / 6), ORIGIN, AHEAD)
    assert twelfth.normals == pytest.approx([0.5, -math.sqrt(0.75), 0])


def test_a_plane_is_met_at_the_distance_of_similar_triangles() -> None:
    towards = unit(np.array([(0, 3, -4), (0, -3, -4), (0, 3, 4), (1, 0, 0)]))
    distance, valid = intersect_plane((5, 5, 1), (0, 0, 2), (0, 0, 9), towards)
    assert valid.tolist() == [True, True, False, False]
    assert distance == pytest.approx([10, 10, math.nan, math.nan], nan_ok=True)
    assert not intersect_plane((0, 0, 1), (0, 0, 1), (0, 0, 1), [0.0, 0, -1])[1]


@pytest.mark.parametrize(("slant", "valid"), [(1e-10, True), (1e-13, False)])
def test_a_ray_runs_along_a_plane_to_rounding(slant: float, valid: bool) -> None:
    assert intersect_plane((0, 0, 0), (0, 0, 1), (0, 0, 1), [1.0, 0, -slant])[1] == valid


def test_the_margin_of_a_box_s_face_is_positive_there_alone_and_zero_on_its_edges() -> None:
    box, eye = Box((0.0, 4.0, 0.0), (2.0, 2.0, 2.0)), (3.0, 0.0, 2.0)
    points = np.array([[0.2, 3.0, 0.1], [1.0, 4.2, -0.3], [0.1, 3.9, 1.0], [1.0, 3.0, 0.5]])
    margins = face_margins(box, eye, unit(points - eye))
    np.testing.assert_array_equal(margins[:, :3] > 0, np.eye(3, dtype=bool)[[1, 0, 2]])
    np.testing.assert_allclose(margins[:2, 3], 0.0, atol=1e-12)
