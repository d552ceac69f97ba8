"""The edges of what rays see: margins from silhouettes, and the pixels that these cover."""

import math

import numpy as np
import pytest
from support.rays import AHEAD, ORIGIN, unit

from simulations.models.arrays import Floats
from simulations.models.light.edge_coverage import straight_edge_coverage
from simulations.models.light.raycasting import Box, Sphere, edge_coverage, intersect
from simulations.models.projection import pinhole


def test_covered_area_of_a_sphere_is_the_area_of_its_ellipse() -> None:
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


def test_the_margin_of_a_sphere_is_the_square_of_half_the_chord() -> None:
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


def test_the_margin_of_a_box_is_the_sine_of_the_angle_to_its_silhouette() -> None:
    """The face at y = 4 reaches to x = ±1, so that the silhouette lies at atan 1/4."""
    box = Box((0.0, 5.0, 0.0), (2.0, 2.0, 40.0))
    angle = math.atan2(1, 4)
    for off in (-0.1, -0.01, 0.01, 0.1):
        for side in (-1, 1):
            towards = (side * math.sin(angle + off), math.cos(angle + off), 0.0)
            margin = intersect(box, ORIGIN, np.array(towards)).margin
            assert margin == pytest.approx(-math.sin(off))


def test_straight_edges_on_the_grid_are_covered_by_their_distance() -> None:
    """x − 2.3 px is the distance itself; its rows and columns, and any multiple, are alike."""
    x = np.arange(6.0)
    expected = np.clip(0.5 + x - 2.3, 0, 1)
    for factor in (1e-6, 1.0, 50.0):
        margin = factor * (x - 2.3) + np.zeros((4, 1))
        np.testing.assert_allclose(edge_coverage(margin), np.tile(expected, (4, 1)))
        np.testing.assert_allclose(edge_coverage(margin.T), np.tile(expected, (4, 1)).T)
    slanted = (3 * x + 4 * np.arange(5.0)[:, None] - 11) / 5
    behind = straight_edge_coverage(slanted, [0.6, 0.8])
    np.testing.assert_allclose(edge_coverage(slanted), behind, atol=1e-12)


@pytest.mark.parametrize("radius", [0.15, 0.8])
def test_each_pixel_of_a_ball_s_outline_is_covered_as_far_as_many_rays_say(radius: float) -> None:
    """14 to 80 pixels across. A distance alone would be off by 4 % where the edge is slanted."""
    size, fine = 96, 16

    def rays(n: int) -> Floats:
        middle = (size * n - 1) / 2
        K = pinhole.intrinsics(200.0 * n, (middle, middle))
        return unit(pinhole.pixel_rays(K, size * n, size * n))

    ball = Sphere((0.013, -0.021, 4.0), radius)
    ours = edge_coverage(intersect(ball, ORIGIN, rays(1)).margin)
    hits = intersect(ball, ORIGIN, rays(fine)).valid
    counted = hits.reshape(size, fine, size, fine).mean(axis=(1, 3))
    assert np.abs(ours - counted).max() < 0.03


def test_an_endless_margin_covers_its_pixel_or_is_unknown_without_a_warning() -> None:
    margin = np.full((4, 5), np.inf)
    margin[:, :2] = -1.0
    coverage = edge_coverage(margin)
    assert coverage[0, 0] == 0
    assert np.isnan(coverage[0, 4])
    assert edge_coverage(np.ones((2, 2))).tolist() == [[1, 1], [1, 1]]
