"""Intersections of rays with solids, the pixels that solids cover, and their shadows."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.light.raycasting import (
    Box,
    Sphere,
    edge_coverage,
    face_margins,
    intersect,
    intersect_plane,
)
from simulations.models.light.soft_shadows import (
    bounding_radius,
    shadow_bounds,
    sphere_occlusion,
    visibility,
)
from simulations.models.projection import pinhole

ORIGIN = np.zeros(3)
AHEAD = np.array([0.0, 1.0, 0.0])


def unit(vectors: ArrayLike) -> Floats:
    """(..., 3) of length 1."""
    vectors = np.asarray(vectors, float)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


BALL, CUBE = Sphere((0, 5, 0), 2.0), Box((0, 5, 0), (2, 4, 2))


@pytest.mark.parametrize("eye", [(0.0, 0.0, 0.0), (3.0, -2.0, 0.75)])
@pytest.mark.parametrize("size", [1.0, 2.0**-10, 1024.0])
@pytest.mark.parametrize("kind", [Sphere, Box])
@pytest.mark.parametrize(
    ("start", "distance", "facing"),
    [(0, 3, -1), (3, 4, 1), (4, 3, 1), (5, 2, 1)],
    ids=["outside", "surface", "inside", "middle"],
)
def test_solid_is_hit_at_its_surface_at_any_size_and_place(
    kind: type, start: float, distance: float, facing: int, size: float, eye: tuple[float, ...]
) -> None:
    """Both solids reach from 3 to 7 sizes along the ray; floats represent all numbers exactly."""
    at, (x, y, z) = np.array(eye), eye
    solid = kind((x, y + 5 * size, z), 2 * size if kind is Sphere else (size, 4 * size, size))
    hit = intersect(solid, at + start * size * AHEAD, AHEAD)
    assert hit.valid
    assert hit.distance == pytest.approx(distance * size)
    assert hit.normals == pytest.approx([0, facing, 0])


@pytest.mark.parametrize("solid", [BALL, CUBE, Sphere((0.0, 5.0, 2.0), 2.0)])
def test_solid_behind_the_eye_or_only_grazed_is_missed(solid: Box | Sphere) -> None:
    assert not intersect(solid, ORIGIN, -AHEAD).valid
    assert intersect(solid, ORIGIN, AHEAD).valid == (solid.centre[2] == 0)


def test_slanted_ray_gets_the_normal_of_the_first_face() -> None:
    """From outside the ray hits the front face first; from inside, the side."""
    box = Box((0.0, 5.0, 0.0), (2.0, 4.0, 2.0))
    slanted = unit([0.9, 3.0, 0.0])
    outside = intersect(box, ORIGIN, slanted)
    assert outside.points == pytest.approx([0.9, 3, 0])
    assert outside.normals == pytest.approx([0, -1, 0])
    inside = intersect(box, (0.0, 6.0, 0.0), unit([2.0, 1.0, 0.5]))
    assert inside.points == pytest.approx([1, 6.5, 0.25])
    assert inside.normals == pytest.approx([1, 0, 0])


@settings(deadline=None, max_examples=30)
@given(angle=st.floats(-4, 4), x=st.floats(-3, 3), z=st.floats(-3, 3), seed=st.integers(0, 99))
def test_box_is_the_intersection_of_six_half_spaces(
    angle: float, x: float, z: float, seed: int
) -> None:
    """Against a march along the ray in small steps."""
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
    hit_both = hit.valid & clear
    assert np.abs(hit.distance - first)[hit_both] == pytest.approx(0, abs=2e-3)


def test_box_turns_anticlockwise_seen_from_above() -> None:
    quarter = Box((0, 0, 0), (2, 4, 6), math.pi / 2)
    assert quarter.world_to_box @ (0, 1, 0) == pytest.approx((1, 0, 0))
    eighth = Box((0, 5, 0), (2, 2, 2), math.pi / 4)
    assert intersect(eighth, ORIGIN, AHEAD).distance == pytest.approx(5 - math.sqrt(2))
    twelfth = intersect(Box((0, 5, 0), (2, 2, 2), math.pi / 6), ORIGIN, AHEAD)
    assert twelfth.normals == pytest.approx([0.5, -math.sqrt(0.75), 0])


def test_plane_is_hit_at_the_distance_of_similar_triangles() -> None:
    towards = unit(np.array([(0, 3, -4), (0, -3, -4), (0, 3, 4), (1, 0, 0)]))
    distance, valid = intersect_plane((5, 5, 1), (0, 0, 2), (0, 0, 9), towards)
    assert valid.tolist() == [True, True, False, False]
    assert distance == pytest.approx([10, 10, math.nan, math.nan], nan_ok=True)
    assert not intersect_plane((0, 0, 1), (0, 0, 1), (0, 0, 1), [0.0, 0, -1])[1]


def test_face_margin_is_positive_only_on_its_face_and_zero_on_its_edges() -> None:
    box, eye = Box((0.0, 4.0, 0.0), (2.0, 2.0, 2.0)), (3.0, 0.0, 2.0)
    points = np.array([[0.2, 3.0, 0.1], [1.0, 4.2, -0.3], [0.1, 3.9, 1.0], [1.0, 3.0, 0.5]])
    margins = face_margins(box, eye, unit(points - eye))
    np.testing.assert_array_equal(margins[:, :3] > 0, np.eye(3, dtype=bool)[[1, 0, 2]])
    np.testing.assert_allclose(margins[:2, 3], 0.0, atol=1e-12)


def test_sphere_covers_the_area_of_its_ellipse() -> None:
    """A sphere off the axis projects to an ellipse, whose area follows from its dual conic."""
    K = pinhole.intrinsics(300.0, (127.5, 95.5))
    centre, radius = np.array([0.55, -0.35, 3.0]), 0.5
    rays = unit(pinhole.pixel_rays(K, 256, 192))
    coverage = edge_coverage(intersect(Sphere(tuple(centre), radius), ORIGIN, rays).margin)
    # Dual conic of the outline: K (R² I − c cᵀ) Kᵀ up to sign; area = π sqrt(det of the 2D part).
    dual = K @ (np.outer(centre, centre) - radius**2 * np.eye(3)) @ K.T
    dual = dual / dual[2, 2]
    middle = dual[:2, 2]
    shape = np.outer(middle, middle) - dual[:2, :2]
    assert coverage.sum() == pytest.approx(math.pi * math.sqrt(np.linalg.det(shape)), rel=1e-3)


def test_margin_of_a_sphere_is_half_the_chord_squared() -> None:
    hit = intersect(Sphere((0.0, 5.0, 1.0), 2.0), ORIGIN, AHEAD)
    assert hit.margin == pytest.approx(2.0**2 - 1.0**2)
    assert hit.distance == pytest.approx(5 - math.sqrt(3))
    behind = intersect(Sphere((0.0, -5.0, 1.0), 3.0), ORIGIN, AHEAD)
    assert behind.margin == pytest.approx(3.0**2 - 26.0)
    missed = intersect(Sphere((0.0, 5.0, 3.0), 2.0), ORIGIN, AHEAD)  # at its closest approach
    assert not missed.valid
    assert missed.distance == pytest.approx(5.0)
    assert missed.points == pytest.approx([0, 5, 0])
    assert missed.margin == pytest.approx(2.0**2 - 3.0**2)
    assert missed.normals == pytest.approx([0, 0, -1])


def test_margin_of_a_box_is_the_sine_of_the_angle_to_its_silhouette() -> None:
    """The face at y = 4 reaches to x = ±1, so that the silhouette lies at atan 1/4."""
    box = Box((0.0, 5.0, 0.0), (2.0, 2.0, 40.0))
    angle = math.atan2(1, 4)
    for off in (-0.1, -0.01, 0.01, 0.1):
        for side in (-1, 1):
            towards = (side * math.sin(angle + off), math.cos(angle + off), 0.0)
            margin = intersect(box, ORIGIN, np.array(towards)).margin
            assert margin == pytest.approx(-math.sin(off))


@pytest.mark.parametrize(
    ("offset", "share"), [(-1.0, 0.0), (-0.5, 0.15625), (0.0, 0.5), (0.5, 0.84375), (1.0, 1.0)]
)
def test_penumbra_of_a_sphere_is_a_smooth_ramp_as_wide_as_the_lamp(
    offset: float, share: float
) -> None:
    """At 2 m the lamp of 3° spreads over 2 tan 3°; s²(3 − 2 s) at a quarter is 5/32."""
    width = 2.0 * math.tan(math.radians(3))
    point = (0.5 + offset * width, 0, 0)
    seen = visibility(Sphere((0, 0, 2), 0.5), point, (0, 0, 1.0), math.radians(3))
    assert seen == pytest.approx(share, abs=1e-9)


def test_shadow_of_a_box_deepens_with_the_chord_of_its_ray() -> None:
    """Light from the side at 45°: near an edge the ray cuts off a corner."""
    box, light, lamp = Box((0, 0, 2), (2, 2, 2)), unit([1.0, 0, 1]), math.radians(3)
    for x in (-0.05, -0.2, -1.0):
        start = (x - 0.0, 0.0, 0.0)  # meets the lower face z = 1 at x + 1, leaves at the side x = 1
        entry = math.sqrt(2)
        leave = math.sqrt(2) * min(1 - x, 3)
        ramp = min((leave - entry) / (2 * entry * math.tan(lamp)), 1)
        expected = 1 - ramp * ramp * (3 - 2 * ramp)
        assert visibility(box, start, light, lamp) == pytest.approx(expected)
    assert visibility(box, (0.05, 0.0, 0.0), light, lamp) == 1
    for z in (0.6, 0.995):  # the nearer the face, the sharper; but not nearer than 2 cm
        entry = math.sqrt(2) * (1 - z)
        width = 2 * max(entry, 0.02) * math.tan(lamp)
        x = z - 0.3 * width / math.sqrt(2)  # so that the ray cuts off 0.3 of the width
        assert visibility(box, (x, 0.0, z), light, lamp) == pytest.approx(1 - 0.09 * 2.4)
    just_below = visibility(box, (0.0, 0.0, 0.99), (0, 0, 1.0), lamp)
    assert just_below == 0


def test_shadow_bounds_are_the_bounds_of_a_cone() -> None:
    """Ball of 0.5 at height 2: the shadow falls 2.5 m and widens by 2.5 tan α."""
    spread = 2.5 * math.tan(math.radians(5))
    low, high = shadow_bounds(Sphere((1, 3, 2), 0.5), (0.0, 0.0, 1.0), math.radians(5))
    assert low == pytest.approx([0.5 - spread, 2.5 - spread, -0.5 - 0.5 - spread])
    assert high == pytest.approx([1.5 + spread, 3.5 + spread, max(2.5, 0.0 + spread)])
    box = Box((1, 3, 2), (1.0, 2.0, 2.0))
    assert bounding_radius(box) == pytest.approx(1.5)
    assert bounding_radius(Sphere((0, 0, 0), 0.7)) == 0.7
    slanted = shadow_bounds(Sphere((0, 0, 1), 0.5), (0.6, 0.0, 0.8), math.radians(5))
    length = 1.5 / 0.8
    assert slanted[0][0] == pytest.approx(-0.6 * length - 0.5 - length * math.tan(math.radians(5)))
    assert slanted[1][0] == pytest.approx(
        max(0.5, -0.6 * length + 0.5 + length * math.tan(math.radians(5)))
    )


def test_occlusion_by_a_sphere_is_its_form_factor() -> None:
    points = np.array([[0, 0, 0], [0, 0, 1.0], [3, 0, 0], [0, 0, 9.0], [0, 0, 4.9]])
    hidden = sphere_occlusion((0, 0, 5), 0.5, points, (0, 0, 1.0))
    by_hand = [0.5**2 / 25, 0.5**2 / 16, 5 / math.sqrt(34) * 0.25 / 34, 0.0, 1.0]
    assert hidden == pytest.approx(by_hand)
