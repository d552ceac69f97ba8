"""Rays against spheres, boxes and planes; edges and shadows."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.models import projection
from simulations.models.raycasting import (
    Box,
    Sphere,
    edge_coverage,
    intersect,
    intersect_plane,
    shadow_bounds,
    sphere_occlusion,
    visibility,
)

ORIGIN = np.zeros(3)
AHEAD = np.array([0.0, 1.0, 0.0])


def unit(vectors):
    vectors = np.asarray(vectors, float)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def rays_around(forward, spread, count, seed=0):
    rng = np.random.default_rng(seed)
    return unit(np.asarray(forward) + spread * rng.uniform(-1, 1, (count, 3)))


def test_sphere_is_met_one_radius_before_its_centre():
    hit = intersect(Sphere((0, 5, 0), 2.0), ORIGIN, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(3.0)
    assert hit.normals == pytest.approx([0, -1, 0])


def test_points_on_a_sphere_lie_one_radius_from_its_centre():
    sphere = Sphere((0.3, 4.0, -0.2), 0.7)
    hit = intersect(sphere, ORIGIN, rays_around(AHEAD, 0.3, 500))
    assert 50 < hit.valid.sum() < 500
    radii = np.linalg.norm(hit.points[hit.valid] - sphere.centre, axis=-1)
    assert radii == pytest.approx(0.7, abs=1e-12)


@pytest.mark.parametrize("solid", [Sphere((0, 3, 0), 1.0), Box((0, 3, 0), (2, 2, 2), 0.4)])
def test_solid_behind_the_origin_is_missed(solid):
    assert not intersect(solid, ORIGIN, -AHEAD).valid


@pytest.mark.parametrize("solid", [Sphere((0, 0, 0), 1.0), Box((0, 0, 0), (2, 2, 2))])
def test_from_inside_the_far_side_is_met(solid):
    hit = intersect(solid, ORIGIN, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(1.0)
    assert hit.normals == pytest.approx([0, 1, 0])


def test_box_is_met_at_its_face_with_that_faces_normal():
    hit = intersect(Box((0, 5, 0), (2, 4, 2)), ORIGIN, AHEAD)
    assert hit.distance == pytest.approx(3.0)
    assert hit.normals == pytest.approx([0, -1, 0])


def test_turned_box_turns_its_normals():
    hit = intersect(Box((0, 5, 0), (2, 2, 2), math.radians(30)), ORIGIN, AHEAD)
    assert hit.normals == pytest.approx(
        [math.sin(math.radians(30)), -math.cos(math.radians(30)), 0]
    )


def test_ray_along_a_face_is_no_division_by_zero():
    hit = intersect(Box((0, 5, 0), (2, 2, 2)), (1.0, 0, 0), AHEAD)
    assert np.isfinite(hit.distance)
    assert np.isfinite(hit.points).all()


@settings(deadline=None)
@given(angle=st.floats(-4, 4), seed=st.integers(0, 99))
def test_silhouette_of_a_box_holds_exactly_the_rays_that_pierce_it(angle, seed):
    box = Box((0.2, 4.0, 0.1), (1.0, 1.4, 0.6), angle)
    directions = rays_around(AHEAD, 0.4, 200, seed)
    hit = intersect(box, ORIGIN, directions)
    local = (hit.points - box.centre) @ box.world_to_box.T
    on_ray = np.linalg.norm(np.cross(hit.points, directions), axis=-1) < 1e-9
    on_surface = np.abs(np.abs(local) / (np.asarray(box.size) / 2)).max(-1) > 1 - 1e-9
    clear = np.abs(hit.margin) > 1e-9
    assert np.array_equal((on_ray & on_surface)[clear], hit.valid[clear])


def test_plane_is_met_only_ahead_and_not_along_itself():
    down = unit([[0, 1, -1], [0, 1, 1], [0, 1, 0]])
    distance, valid = intersect_plane((0, 0, 0), (0, 0, 1), (0, 0, 2), down)
    assert valid.tolist() == [True, False, False]
    assert distance == pytest.approx([2 * math.sqrt(2), 0, 0])


def test_covered_area_of_a_sphere_is_the_area_of_its_ellipse():
    """A sphere off the axis projects to an ellipse, whose area follows from its dual conic."""
    K = projection.intrinsics(300.0, (127.5, 95.5))
    centre, radius = np.array([0.55, -0.35, 3.0]), 0.5
    rays = unit(projection.pixel_rays(K, 256, 192))
    coverage = edge_coverage(intersect(Sphere(tuple(centre), radius), ORIGIN, rays).margin)
    # Dual conic of the outline: K (R² I − c cᵀ) Kᵀ up to sign; area = π sqrt(det of the 2D part).
    dual = K @ (np.outer(centre, centre) - radius**2 * np.eye(3)) @ K.T
    dual = dual / dual[2, 2]
    middle = dual[:2, 2]
    shape = np.outer(middle, middle) - dual[:2, :2]
    assert coverage.sum() == pytest.approx(math.pi * math.sqrt(np.linalg.det(shape)), rel=1e-3)


def test_covered_area_of_a_box_face_is_exact():
    K = projection.intrinsics(100.0, (63.5, 63.5))
    rays = unit(projection.pixel_rays(K, 128, 128))
    hit = intersect(Box((0, 0, 4), (2.03, 1.57, 1)), ORIGIN, rays)
    area = (100 / 3.5) ** 2 * 2.03 * 1.57
    assert edge_coverage(hit.margin).sum() == pytest.approx(area, rel=2e-3)


def test_coverage_needs_a_picture():
    with pytest.raises(ValueError, match=r"legal: \(H, W\)"):
        edge_coverage(np.ones((1, 5)))


@pytest.mark.parametrize("solid", [Sphere((0, 0, 2), 0.5), Box((0, 0, 2), (1, 1, 1))])
def test_shadow_is_full_below_and_absent_aside(solid):
    points = np.array([[0, 0, 0], [3.0, 0, 0], [0, 0, 5.0]])
    seen = visibility(solid, points, (0, 0, 1.0), math.radians(3))
    assert seen == pytest.approx([0, 1, 1])


def test_half_of_the_lamp_is_seen_where_its_centre_grazes_the_sphere():
    seen = visibility(Sphere((0, 0, 2), 0.5), (0.5, 0, 0), (0, 0, 1.0), math.radians(3))
    assert seen == pytest.approx(0.5)


def test_no_shadow_falls_outside_its_bounds():
    light = tuple(unit([0.5, -0.6, 0.8]))
    low, high = shadow_bounds(Sphere((0, 3, 0.4), 0.4), light, math.radians(5))
    x, y = np.meshgrid(np.linspace(-4, 4, 161), np.linspace(-1, 7, 161))
    floor = np.stack((x, y, np.zeros_like(x)), axis=-1)
    shaded = visibility(Sphere((0, 3, 0.4), 0.4), floor, light, math.radians(5)) < 1
    assert shaded.any()
    assert (floor[shaded][:, :2] >= low[:2]).all()
    assert (floor[shaded][:, :2] <= high[:2]).all()


def test_sphere_hides_its_form_factor():
    """Straight above, the form factor is (R / d)²; checked against cosine-weighted rays."""
    rng = np.random.default_rng(1)
    radius, angle = np.sqrt(rng.random(40_000)), 2 * np.pi * rng.random(40_000)
    sky = np.stack(
        (radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1 - radius**2)), axis=-1
    )
    centre = (0.6, 0.0, 1.6)
    share = intersect(Sphere(centre, 0.7), ORIGIN, sky).valid.mean()
    assert sphere_occlusion(centre, 0.7, ORIGIN, (0, 0, 1.0)) == pytest.approx(share, abs=0.006)


def test_meaningless_solids_are_refused():
    with pytest.raises(ValueError, match="radius"):
        Sphere((0, 0, 0), 0.0)
    with pytest.raises(ValueError, match="size"):
        Box((0, 0, 0), (1, -1, 1))
