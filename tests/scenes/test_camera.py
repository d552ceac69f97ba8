"""The camera, stage by stage, against projection, lens distortion, optics and photon counting."""

import math
from functools import partial

import numpy as np
import pytest
from support.frames import outputs_of, texts_at

from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, distort, largest_distorted_radius
from simulations.models.light.raycasting import Sphere
from simulations.models.projection import pinhole
from simulations.scenes.camera import lens as camera_lens
from simulations.scenes.camera.lens import LensMap, after_step, view_of
from simulations.scenes.camera.scene import SCENE
from simulations.scenes.camera.stages import (
    ADC,
    BYTE_OF_CODE,
    FULL_WELL_E,
    encode,
    quantise,
    read_noise_e,
)
from simulations.world import still_life
from simulations.world import still_life_camera as camera_rays
from simulations.world.still_life_camera import (
    COLUMNS,
    PITCH_MM,
    ROWS,
    SUBJECT_M,
    Rays,
    principal_mm,
)

FOCUS_M = 3.2
FOLDS = [(24.0, -0.4), (24.0, -0.2), (30.0, -0.3), (33.0, -0.4)]  # the fold is in the picture
MIDDLE = np.array([(COLUMNS - 1) / 2, (ROWS - 1) / 2])
outputs = partial(outputs_of, SCENE, "layers")
texts = partial(texts_at, SCENE)


def sensor_mm(focal_length: float, focus: float = FOCUS_M) -> float:
    return 1.0 / (1.0 / focal_length - 1e-3 / focus)


def rays_of(focal_length: float, k1: float) -> Rays:
    return camera_rays.bend_rays(camera_rays.sensor_rays(focal_length, FOCUS_M), k1)


def lens_map_of(focal: float, k1: float, focus: float = FOCUS_M) -> tuple[LensMap, tuple[int, ...]]:
    margin = camera_lens.margin_px(focal, focus, k1)
    straight = camera_rays.pinhole_rays(focal, focus, 1, *margin)
    return camera_lens.lens_map(straight, focal, focus, k1, 1), straight.valid.shape


@pytest.mark.parametrize("focal_length", [24.0, 33.0, 50.0, 135.0])
@pytest.mark.parametrize("focus", [1.0, 10.0])
def test_margin_covers_every_pixel_that_the_warp_reads(focal_length: float, focus: float) -> None:
    """`cubic_warp` refuses a place whose neighbours are missing."""
    widest = camera_lens.widest_barrel(focal_length, focus, -0.4)
    most = camera_lens.margin_px(focal_length, focus, widest)
    for k1 in np.linspace(-0.4, 0.4, 27).tolist():
        lens, shape = lens_map_of(focal_length, k1, focus)
        assert lens.table.source_shape == shape
        assert all(np.array(camera_lens.margin_px(focal_length, focus, k1)) <= most)


@pytest.mark.parametrize("at", [(0.0, 0.0), (0.7, 0.0), (-0.5, 0.5), (0.2, -0.97)])
@pytest.mark.parametrize(
    ("focal_length", "aperture", "focus"), [(24.0, 8.0, 1.0), (50.0, 1.4, 3.2), (135.0, 2.0, 10.0)]
)
def test_thin_lens_sends_each_ray_to_its_pixel(
    focal_length: float, aperture: float, focus: float, at: tuple[float, float]
) -> None:
    """Rays as `through_lens` casts them, traced on through the lens to a sensor in focus."""
    place = np.array(at) * focal_length / aperture / 2000
    straight = camera_rays.sensor_rays(focal_length, focus)
    seen = still_life.view_through(straight.directions, straight.valid, (place[0], place[1]), focus)
    into_camera = still_life.WORLD_TO_CAMERA[:3, :3]
    start = into_camera @ (np.array(seen.eye) - still_life.EYE)
    assert start == pytest.approx([*place, 0.0], abs=1e-12)
    forward = seen.directions @ into_camera.T
    slopes, place_mm = forward[..., :2] / forward[..., 2:], 1000 * start[:2]
    # Into the camera light runs backwards; what it meets is upside down.
    behind = sensor_mm(focal_length, focus) * (-slopes - place_mm / focal_length)
    down, across = np.mgrid[:ROWS, :COLUMNS]
    pixels = np.stack([across, down], axis=-1) - MIDDLE
    np.testing.assert_allclose(-(place_mm + behind) / PITCH_MM, pixels, atol=1e-9)


@pytest.mark.parametrize(("focal_length", "k1"), [(24.0, -0.4), (24.0, 0.4), (50.0, -0.3)])
@pytest.mark.parametrize("place", [(0.1, 0.05), (-0.21, 0.12), (0.25, -0.19), (-0.05, -0.2)])
def test_point_of_light_lands_where_the_distortion_model_puts_it(
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
    assert found == pytest.approx(distort(place, Distortion(k1=k1)) * pixels + MIDDLE, abs=0.05)


@pytest.mark.parametrize(("focal_length", "k1"), FOLDS)
def test_picture_is_black_and_rays_are_invalid_beyond_the_fold(
    focal_length: float, k1: float
) -> None:
    lens, _ = lens_map_of(focal_length, k1)
    rays = camera_rays.bend_rays(camera_rays.sensor_rays(focal_length, FOCUS_M), k1)
    np.testing.assert_array_equal(lens.reached > 0.5, rays.valid)
    black = outputs(focal_length=focal_length, k1=k1)["lens distortion"][:, lens.reached == 0]
    assert black.size
    assert not black.any()
    if (focal_length, k1) == FOLDS[0]:  # a circle that is cut off above and below
        radius = largest_distorted_radius(Distortion(k1=k1)) * sensor_mm(24.0) / PITCH_MM
        half = ROWS / 2
        area = 2 * (half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius))
        assert lens.reached.sum() == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize("focus", [1.0, 10.0])
def test_ball_is_centred_on_its_projected_outline(focus: float) -> None:
    """Centroid of each ball's coverage against the centre of its outline."""
    done = outputs(focal_length=24, focus=focus)
    rows, columns = done["pinhole rays"].valid.shape
    centre = ((columns - 1) / 2, (rows - 1) / 2)
    K = pinhole.intrinsics(sensor_mm(24.0, focus) / PITCH_MM, centre)
    items = [part for part in done["surfaces"] if part.item is not None]
    balls = [part for part in items if isinstance(part.item.solid, Sphere)]
    assert len(balls) == 4
    for part in balls:
        ball = part.item.solid
        at = pinhole.world_to_camera(ball.centre, still_life.WORLD_TO_CAMERA)
        dual = K @ (np.outer(at, at) - ball.radius**2 * np.eye(3)) @ K.T
        down, across = np.indices(part.coverage.shape)
        weight = part.coverage / part.coverage.sum()
        found = (weight * across).sum() + part.left, (weight * down).sum() + part.top
        assert found == pytest.approx(dual[:2, 2] / dual[2, 2], abs=0.05)


@pytest.mark.parametrize(("focal_length", "focus"), [(24, 10.0), (135, 1.0)])
def test_natural_vignetting_is_cos4(focal_length: float, focus: float) -> None:
    result = outputs(focal_length=focal_length, focus=focus)
    lit = result["trimming"][:, 0, 0] > 0
    ratio = (result["vignetting"] / np.maximum(result["trimming"], 1e-6))[lit, 0, 0]
    angle = math.atan(math.hypot(*MIDDLE) * PITCH_MM / sensor_mm(focal_length, focus))
    assert ratio == pytest.approx(math.cos(angle) ** 4, rel=1e-4)


@pytest.mark.parametrize(
    ("focal_length", "k1", "focus"),
    [(24, -0.4, 3.2), (24, 0.4, 3.2), (50, -0.1, 3.2), (135, 0.1, 3.2), (135, 0, 1), (135, 0, 10)],
)
def test_field_of_view_is_the_angle_between_the_outermost_rays(
    focal_length: float, k1: float, focus: float
) -> None:
    """The outermost ray lands on the sensor's edge, or on the fold where none lands so far out."""
    given = {"focal_length": focal_length, "k1": k1, "focus": focus}
    r = math.tan(view_of(SCENE.check(given)) / 2)
    if (focal_length, k1) == (24, -0.4):
        assert r == pytest.approx(math.sqrt(1 / 1.2), rel=1e-9)
    else:
        edge = 18.0 / sensor_mm(focal_length, focus)
        assert r * (1 + k1 * r * r) == pytest.approx(edge, rel=1e-9)
    shown = texts(**given)
    assert shown["field_of_view"] == f"{math.degrees(2 * math.atan(r)):.1f}"
    assert shown["sensor_distance"] == f"{sensor_mm(focal_length, focus):.1f}"


@pytest.mark.parametrize("name", ["striped ball", "red ball", "pearl"])
def test_dolly_zoom_keeps_only_the_striped_ball_the_same_size(name: str) -> None:
    """Three metres back, each outline has the area of its ellipse at the new depth."""
    areas, ellipses = [], []
    for back in (0, 3):
        parts = outputs(back=back, focal_length=24)["surfaces"]
        (ball,) = (part for part in parts if part.item and part.item.name == name)
        x, y, z = pinhole.world_to_camera(ball.item.solid.centre, still_life.WORLD_TO_CAMERA)
        away, r = z + back, ball.item.solid.radius
        assert ball.depth.max() == pytest.approx(away)
        outline = math.sqrt(x**2 + y**2 + away**2 - r**2) / (away**2 - r**2) ** 1.5
        areas.append(ball.coverage.sum())
        ellipses.append(((SUBJECT_M + back) / SUBJECT_M) ** 2 * outline)
    assert areas[1] / areas[0] == pytest.approx(ellipses[1] / ellipses[0], rel=0.01)
    assert (name == "striped ball") == (abs(areas[1] / areas[0] - 1) < 0.03)
    now = after_step(SCENE.check({"back": 2}))
    before, after = principal_mm(50, 3.2), principal_mm(now.focal_length, now.focus)
    assert now.focus == pytest.approx(5.2)
    assert after / (SUBJECT_M + 2) == pytest.approx(before / SUBJECT_M)


@pytest.mark.parametrize("k1", [-0.2, 0.2])
@pytest.mark.parametrize("thing", still_life.OBJECTS[:5], ids=lambda thing: thing.name)
def test_press_on_an_object_focuses_on_it(thing: still_life.SceneObject, k1: float) -> None:
    """All but the plum box, whose middle the green ball hides."""
    x, y, z = pinhole.world_to_camera(thing.solid.centre, still_life.WORLD_TO_CAMERA)
    sensor = sensor_mm(35.0) * distort((x / z, y / z), Distortion(k1=k1))
    place = (200 + sensor[0] * 400 / 36, 133.5 + sensor[1] * 267 / 24)
    values = SCENE.pull(SCENE.check({"focal_length": 35, "k1": k1}), "aim", place)
    assert values["focus"] == pytest.approx(z, abs=0.051)


def test_shot_and_read_noise_have_their_stated_size() -> None:
    result = outputs(noise_sigma=12, exposure=-1)
    mean, shot, read = (result[name] for name in ("exposure", "shot noise", "read noise"))
    assert (read - shot).std() == pytest.approx(read_noise_e(12), rel=0.01)
    assert (read - shot).mean() == pytest.approx(0, abs=read_noise_e(12) * 0.02)
    normalised = ((shot - mean) / np.sqrt(np.maximum(mean, 1)))[mean > 50]
    assert normalised.var() == pytest.approx(1, abs=0.02)
    again = outputs(noise_sigma=12, exposure=-1, new_noise=1)
    np.testing.assert_array_equal(again["exposure"], mean)
    parts = (shot - mean).ravel(), (again["shot noise"] - mean).ravel()
    assert np.corrcoef(*parts)[0, 1] == pytest.approx(0, abs=0.02)
    np.testing.assert_array_equal(2 * mean, outputs(exposure=0)["exposure"])


def test_byte_of_a_code_is_the_srgb_code_of_its_light() -> None:
    linear = (np.arange(4096) - ADC.black_level_dn) / (4095 - ADC.black_level_dn)
    exact = np.rint(255 * encode_srgb(np.clip(linear, 0, 1)))
    np.testing.assert_array_equal(BYTE_OF_CODE, exact)
    electrons = np.array([-1e4, 0.0, FULL_WELL_E, 1e6], np.float32).reshape(1, 2, 2)
    picture = encode(quantise(np.repeat(electrons, 3, axis=0)))
    assert picture[..., 0].ravel().tolist() == [0, 0, 255, 255]
    assert (picture[..., 3] == 255).all()
