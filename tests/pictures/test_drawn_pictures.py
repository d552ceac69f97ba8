"""Drawn pictures against samples: patterns, balloon, room, chart, still life and spoked wheel."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import intrinsics, look_at, project, world_to_camera
from simulations.pictures import spoked_wheel
from simulations.pictures.balloon import HEIGHT, WIDTH, Window, balloon
from simulations.pictures.checker_room import HIGH, LOW, TRIM_M, checker_room
from simulations.pictures.patterns import stripes
from simulations.pictures.resolution_chart import INK, PAPER, resolution_chart
from simulations.world import furniture, room
from simulations.world.depth import ray_depth
from simulations.world.still_life import view
from simulations.world.still_life_camera import COLUMNS, ROWS, sensor_rays
from simulations.world.surfaces import surfaces


@pytest.mark.parametrize(
    "window",
    [
        Window(0, 0, 1, 1),
        Window(HEIGHT - 1, WIDTH - 1, 1, 1),
        Window(13, 100, 3, 100),
        Window(100, 0, 60, WIDTH),
        Window(56, 130, 16, 20),
    ],
)
def test_window_of_the_balloon_equals_its_part_of_the_whole(window: Window) -> None:
    rows = slice(window.top, window.top + window.height)
    part = balloon()[rows, window.left : window.left + window.width]
    np.testing.assert_allclose(balloon(window), part, rtol=1e-6)


@pytest.mark.parametrize("footprint", [0.03, 0.3, 1.7])
def test_stripes_agree_with_many_point_samples(footprint: float) -> None:
    u = np.linspace(-2, 2, 37)
    fine = u[:, None] + footprint * ((np.arange(4000) + 0.5) / 4000 - 0.5)
    sampled = (np.abs(fine - np.round(fine / 0.7) * 0.7) <= 0.1).mean(axis=1)
    np.testing.assert_allclose(stripes(u, 0.7, 0.2, footprint), sampled, atol=1e-3)


def test_back_wall_ends_at_its_projected_corners() -> None:
    room = checker_room(561, 421, 200.0)
    # 1.2 m below the eye the wall is teal, with little red, between its pale mouldings.
    row = room[210 + round(200.0 * 1.2 / HIGH[2]), :, 0]
    pale = np.flatnonzero(row > 0.2)
    left, right = pale[pale < 280].max() + 1, pale[pale > 280].min()
    for column, wall_x in ((left, LOW[0] + TRIM_M), (right, HIGH[0] - TRIM_M)):
        assert column == pytest.approx(280 + 200.0 * wall_x / HIGH[2], abs=1.0)


@pytest.mark.parametrize("draw", [checker_room, resolution_chart])
def test_pictures_are_finite_linear_light_for_any_size(
    draw: Callable[[int, int, float], Floats],
) -> None:
    for width, height in ((64, 48), (1, 1), (7, 3)) if draw is checker_room else ((64, 48),):
        picture = draw(width, height, 40.0)
        assert picture.shape == (height, width, 3)
        assert picture.dtype == np.float32
        assert np.isfinite(picture).all()
        assert picture.min() >= 0.0
        assert picture.max() <= 1.5


def test_edge_of_the_chart_is_slanted_by_five_degrees() -> None:
    chart = resolution_chart(561, 421, 200.0)[..., 0]
    # Dark square |x + y tan 5°| < 0.12: its right edge moves left by tan 5° px for each row.
    rows = np.r_[190:200, 221:231]  # clear of the cross at the centre
    darkness = (PAPER[0] - chart[rows, 280:316]) / (PAPER[0] - INK[0])
    edge_px = darkness.sum(axis=1) - 0.5
    slope, middle = np.polyfit(rows - 210, edge_px, 1)
    assert slope == pytest.approx(-np.tan(np.radians(5.0)), abs=1e-3)
    assert middle == pytest.approx(0.12 * 200.0, abs=0.05)


@pytest.mark.parametrize("focal_mm", [24.0, 85.0])
def test_ray_hits_the_surface_that_the_picture_shows(focal_mm: float) -> None:
    rays = sensor_rays(focal_mm, 3.0).directions
    parts = surfaces(view(rays))
    rng = np.random.default_rng(0)
    sure = 0
    for row, column in zip(rng.integers(0, ROWS, 150), rng.integers(0, COLUMNS, 150), strict=True):
        shown = None
        for part in parts:  # from far to near: the last one to cover the whole pixel is visible
            y, x = row - part.top, column - part.left
            if not (0 <= y < part.coverage.shape[0] and 0 <= x < part.coverage.shape[1]):
                continue
            if part.coverage[y, x] == 1:
                shown = part.depth[y, x]
            elif part.coverage[y, x] > 0:
                shown = None
        if shown is not None:
            sure += 1
            assert ray_depth(rays[row, column]) == pytest.approx(shown, rel=1e-9)
    assert sure > 100


def test_edges_between_faces_of_a_box_are_antialiased() -> None:
    """Otherwise slanted edges inside a box would be staircases."""
    box = surfaces(view(sensor_rays(50.0, 3.2).directions))[-2]
    inside = box.coverage == 1
    length = np.linalg.norm(box.normals, axis=-1)[inside]
    assert length.max() == pytest.approx(1.0)
    assert 30 < np.count_nonzero(length < 0.99) < 0.1 * length.size


def brute_force(place: float, duty: float, pixel: float, swept: float, steps: int = 400) -> float:
    """Coverage by bars centred on whole numbers, by sampling pixel and exposure."""
    offsets = (np.arange(steps) + 0.5) / steps - 0.5
    u = place + pixel * offsets[:, None] + swept * offsets
    return float(np.mean(np.abs(u - np.rint(u)) < duty / 2))


@given(
    st.floats(-9, 9),
    st.floats(0.02, 0.95),
    st.floats(0.005, 0.4),
    st.sampled_from([0.0, 0.03, 0.5, 1.0, 2.6]),
)
def test_mean_coverage_over_pixel_and_exposure_is_exact(
    place: float, duty: float, pixel: float, swept: float
) -> None:
    found = spoked_wheel.mean_coverage(np.array([place]), duty, pixel, swept)
    assert found[0] == pytest.approx(brute_force(place, duty, pixel, swept), abs=6e-3)


@pytest.mark.parametrize("swept", [-2.6, -0.03, 0.0, 0.5])
def test_exposure_of_the_wheel_is_the_mean_of_its_moments(swept: float) -> None:
    rng = np.random.default_rng(8)
    place, duty, pixel = rng.uniform(-2, 2, 200), rng.uniform(0.05, 0.9, 200), np.full(200, 0.1)
    row = spoked_wheel.Bars(place, duty, pixel, swept)
    times = (np.arange(2000) + 0.5) / 2000
    mean = np.mean([spoked_wheel.at_moment(row, time) for time in times], axis=0)
    np.testing.assert_allclose(spoked_wheel.exposure_mean(row), mean, atol=2e-5)


@pytest.mark.parametrize(
    ("eye", "target"),
    [((0, 0, 0.5), (0, 4, 0.3)), ((2.5, -3, 1.7), (-1, 5, 0.8)), ((-3.9, 7, 3), (3, 0, 0))],
)
def test_points_of_the_room_project_to_their_pixels(
    eye: tuple[float, float, float], target: tuple[float, float, float]
) -> None:
    K, pose = intrinsics(120.0, (79.5, 59.5)), look_at(eye, target, (0, 0, 1))
    seen = room.look(K, pose, 160, 120)
    camera = world_to_camera(seen.points, pose)
    pixels, valid = project(camera, K)
    assert valid.all()
    rows, columns = np.mgrid[:120, :160]
    np.testing.assert_allclose(pixels, np.stack([columns, rows], -1), atol=1e-4)
    np.testing.assert_allclose(seen.depth, camera[..., 2], rtol=1e-5)
    assert (np.einsum("...i,...i", seen.normals, seen.to_eye) > -1e-6).all()
    inside = (seen.points > np.array(furniture.LOW) - 1e-5) & (
        seen.points < np.array(furniture.HIGH) + 1e-5
    )
    assert inside.all()
    light = room.light_of(K, pose, 160, 120)
    assert np.isfinite(light).all()
    assert light.min() >= 0
