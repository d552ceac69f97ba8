"""The camera's lens: how far it sees, where it puts a point, and what bending the picture costs."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simulations.engine.controls import Value
from simulations.engine.stages import Outputs, Run, StageCache
from simulations.models.distortion.lens_model import Distortion, distort, largest_distorted_radius
from simulations.models.sampling.cubic_warp import warp
from simulations.pictures.still_life import things as still_life
from simulations.scenes._still_life_camera import rays as camera_rays
from simulations.scenes._still_life_camera.rays import COLUMNS, PITCH_MM, ROWS, Rays
from simulations.scenes.camera import lens as camera_lens
from simulations.scenes.camera.lens import LensMap
from simulations.scenes.camera.scene import SCENE

FOCAL_MM = st.integers(24, 135)
K1 = st.integers(-40, 40).map(lambda hundredths: hundredths / 100)
FOCUS_M = 3.2
NEAR_OR_FAR = st.sampled_from([1.0, FOCUS_M, 10.0])
FOLDS = [(24.0, -0.4), (24.0, -0.2), (30.0, -0.3), (33.0, -0.4)]
"""Settings whose fold lies in the picture."""


def rays_of(focal_length: float, k1: float, focus: float = FOCUS_M) -> Rays:
    return camera_lens.bend_rays(camera_rays.sensor_rays(focal_length, focus), k1)


def sensor_mm(focal_length: float, focus: float = FOCUS_M) -> float:
    return 1.0 / (1.0 / focal_length - 1e-3 / focus)


def lens_map_of(
    focal_length: float, k1: float, focus: float = FOCUS_M
) -> tuple[LensMap, tuple[int, ...]]:
    margin = camera_lens.margin_px(focal_length, focus, k1)
    straight = camera_rays.pinhole_rays(focal_length, focus, 1, *margin)
    return camera_lens.lens_map(straight, focal_length, focus, k1, 1), straight.valid.shape


def run(tier: str, **given: Value) -> Run:
    return SCENE.run(SCENE.check(given), tier, StageCache())


def outputs(tier: str = "layers", **given: Value) -> Outputs:
    return run(tier, **given).outputs


@given(FOCAL_MM, K1, NEAR_OR_FAR)
@settings(max_examples=60, deadline=None)
def test_the_margin_holds_every_pixel_that_the_warp_reads(
    focal_length: int, k1: float, focus: float
) -> None:
    """`cubic_warp` refuses a place whose neighbours are missing."""
    lens, (rows, columns) = lens_map_of(float(focal_length), k1, focus)
    assert lens.table.source_shape == (rows, columns)
    assert lens.table.corner.shape == (ROWS, COLUMNS)


PLACES = [(0.0, 0.0), (0.7, 0.0), (-0.5, 0.5), (0.2, -0.97)]
"""On the lens, in units of its radius."""


@pytest.mark.parametrize("at", PLACES)
@pytest.mark.parametrize("focus", [1.0, FOCUS_M, 10.0])
@pytest.mark.parametrize(("focal_length", "aperture"), [(24.0, 8.0), (50.0, 1.4), (135.0, 2.0)])
def test_a_thin_lens_sends_each_ray_that_is_looked_along_to_its_pixel(
    focal_length: float, aperture: float, focus: float, at: tuple[float, float]
) -> None:
    """Rays as `through_lens` casts them, traced on through the lens to a sensor in focus."""
    radius = focal_length / aperture / 2000
    place = np.array(at) * radius
    straight = camera_rays.sensor_rays(focal_length, focus)
    seen = still_life.view_through(straight.directions, straight.valid, (place[0], place[1]), focus)
    into_camera = still_life.WORLD_TO_CAMERA[:3, :3]
    start = into_camera @ (np.array(seen.eye) - still_life.EYE)
    assert start == pytest.approx([*place, 0.0], abs=1e-12)
    forward = seen.directions @ into_camera.T
    slopes = forward[..., :2] / forward[..., 2:]
    behind_mm = sensor_mm(focal_length, focus)
    place_mm = 1000 * start[:2]
    # Into the camera light runs backwards; what it meets is upside down.
    upright = -(place_mm + behind_mm * (-slopes - place_mm / focal_length))
    down, across = np.mgrid[:ROWS, :COLUMNS]
    pixels = np.stack([across - (COLUMNS - 1) / 2, down - (ROWS - 1) / 2], axis=-1)
    np.testing.assert_allclose(upright / PITCH_MM, pixels, atol=1e-9)


@pytest.mark.parametrize(
    ("focal_length", "k1"), [*FOLDS, (24.0, 0.4), (50.0, -0.4), (50.0, 0.1), (135.0, 0.0)]
)
def test_the_reach_is_that_of_the_farthest_ray(focal_length: float, k1: float) -> None:
    """Against all rays of the sensor, which stop half a pixel short of its edge."""
    rays = rays_of(focal_length, k1)
    seen = np.abs(rays.directions[rays.valid][:, :2]).max(axis=0)
    reach = np.array(camera_rays.ideal_reach(sensor_mm(focal_length), k1))
    assert (seen <= reach).all()
    corner = math.hypot(18, 12) / sensor_mm(focal_length)
    folded = largest_distorted_radius(Distortion(k1=k1)) < corner
    assert seen == pytest.approx(reach, rel=0.06 if folded else 0.02)


@pytest.mark.parametrize(("focal_length", "k1"), [*FOLDS, (24.0, 0.4), (50.0, 0.0)])
def test_no_ray_meets_the_floor_before_the_nearest_depth(focal_length: float, k1: float) -> None:
    rays = rays_of(focal_length, k1)
    falling = rays.directions @ still_life.WORLD_TO_CAMERA[:3, 2]
    floor = falling < 0
    nearest = (-still_life.EYE[2] / falling[floor & rays.valid]).min()
    things = min(still_life.thing_depth(thing) for thing in still_life.THINGS)
    depth = camera_rays.nearest_depth(sensor_mm(focal_length), k1)
    assert depth <= min(nearest, things)
    assert depth == pytest.approx(min(nearest, things), rel=0.06)


@pytest.mark.parametrize(("focal_length", "k1"), [(24.0, -0.4), (24.0, 0.4), (50.0, -0.3)])
@pytest.mark.parametrize("place", [(0.1, 0.05), (-0.21, 0.12), (0.25, -0.19), (-0.05, -0.2)])
def test_a_point_of_light_lands_where_the_model_of_distortion_puts_it(
    focal_length: float, k1: float, place: tuple[float, float]
) -> None:
    """Centroid of a soft dot, to a twentieth of a pixel."""
    lens, (rows, columns) = lens_map_of(focal_length, k1)
    pixels = sensor_mm(focal_length) / PITCH_MM
    x, y = np.array(place) * pixels
    down, across = np.mgrid[:rows, :columns].astype(float)
    square = (across - (columns - 1) / 2 - x) ** 2 + (down - (rows - 1) / 2 - y) ** 2
    dot = np.exp(-square / (2 * 1.2**2)).astype(np.float32)
    seen = camera_lens.distort_picture(np.stack([dot] * 3), lens)[0].astype(float)
    down, across = np.mgrid[:ROWS, :COLUMNS]
    found = [(seen * axis).sum() / seen.sum() for axis in (across, down)]
    moved = distort(place, Distortion(k1=k1)) * pixels
    expected = moved + np.array([(COLUMNS - 1) / 2, (ROWS - 1) / 2])
    assert found == pytest.approx(list(expected), abs=0.05)


@pytest.mark.parametrize(("focal_length", "k1"), FOLDS)
def test_the_black_beyond_the_fold_is_where_no_ray_is_valid(focal_length: float, k1: float) -> None:
    lens, _ = lens_map_of(focal_length, k1)
    valid = rays_of(focal_length, k1).valid
    assert not valid.all()
    np.testing.assert_array_equal(lens.reached > 0.5, valid)
    black = outputs(focal_length=focal_length, k1=k1)["lens distortion"][:, lens.reached == 0]
    assert black.size
    assert (black == 0).all()


def test_the_edge_of_the_fold_covers_the_area_of_its_circle() -> None:
    lens, _ = lens_map_of(24.0, -0.4)
    radius = largest_distorted_radius(Distortion(k1=-0.4)) * sensor_mm(24.0) / PITCH_MM
    half = ROWS / 2  # the circle is cut off above and below
    area = 2 * (half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius))
    assert lens.reached.sum() == pytest.approx(area, rel=1e-3)
    assert 0.2 < np.mean((lens.reached > 0) & (lens.reached < 1)) * ROWS * COLUMNS / radius < 6


def test_the_light_of_a_reached_pixel_is_never_negative() -> None:
    """Cubics overshoot at edges; electrons cannot."""
    result = outputs(k1=0.4)
    assert warp(result["lens map"].table, result["enlargement"]).min() < 0
    assert result["lens distortion"].min() == 0


@pytest.mark.parametrize(
    ("setting", "least_db"),
    [
        ({"focal_length": 24, "k1": -0.4}, 33),
        ({"focal_length": 24, "k1": 0.4}, 33),
        ({"focal_length": 50, "k1": -0.1}, 33),
        ({"focal_length": 50, "k1": 0.4}, 33),
        ({"focal_length": 135, "k1": -0.4}, 44),
        ({"focal_length": 50, "k1": 0.4, "aperture": 1.4}, 38),
        ({"focal_length": 135, "k1": 0.4, "aperture": 1.4}, 44),
    ],
    ids=str,
)
def test_a_bent_picture_is_close_to_bent_rays_and_no_brighter(
    setting: dict[str, Value], least_db: float
) -> None:
    bent = outputs("bent-rays", **setting)["noiseless picture"][..., :3].astype(float)
    warped = outputs("layers", **setting)["noiseless picture"][..., :3].astype(float)
    error = warped - bent
    assert 20 * math.log10(255 / np.sqrt(np.mean(error**2))) > least_db
    assert abs(error.mean()) < 0.2
