"""The camera simulator: stages, extremes, and whether the photograph is what theory says."""

import itertools
import math

import numpy as np
import pytest

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Raster
from simulations.engine.stages import Outputs, StageCache
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.light.raycasting import Sphere
from simulations.models.projection import pinhole
from simulations.pictures.still_life import things as still_life
from simulations.scenes.camera.dolly import KEPT_M, after_step, focal_before_step
from simulations.scenes.camera.lens import COLUMNS, PITCH_MM, ROWS, principal_mm
from simulations.scenes.camera.plan import EDGE_DEPTH, STILL_LIFE_MIDDLE, focus_mark, on_plan
from simulations.scenes.camera.scene import SCENE, blur_of, view_of
from simulations.scenes.camera.sensor import (
    ADC,
    BYTE_OF_CODE,
    FULL_WELL_E,
    draw_grain,
    encode,
    quantise,
    read_noise_e,
    shutter_s,
)
from simulations.scenes.camera.stages import STAGES

type Setting = dict[str, Value]

LAST = ("quantisation", "sRGB", "noiseless picture")
FROM_EXPOSURE = ("exposure", "shot noise", "read noise", *LAST)
FROM_OVERLAY = ("overlay", "trimming", "vignetting", *FROM_EXPOSURE)
BENT: Setting = {"aperture": 2.0, "k1": -0.1}
"""Where no stage of the default tier is neutral, but for those of other tiers."""
FROM_RAYS = (
    *("pinhole rays", "surfaces", "light", "defocus", "overlay"),
    *("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE),
)
AFTER_MOVING: dict[str, tuple[Value, tuple[str, ...]]] = {
    "noise_sigma": (9, ("read noise", "quantisation", "sRGB")),
    "shot_noise": (False, ("read noise", "quantisation", "sRGB")),
    "new_noise": (1, ("grain", "shot noise", "read noise", "quantisation", "sRGB")),
    "exposure": (1, FROM_EXPOSURE),
    "k1": (-0.11, ("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE)),
    "aperture": (2.8, ("defocus", "overlay", "lens distortion", "vignetting", *FROM_EXPOSURE)),
    "light_angle": (
        0,
        ("light", "defocus", "overlay", "lens distortion", "vignetting", *FROM_EXPOSURE),
    ),
    "focal_length": (51, FROM_RAYS),
    "focus": (5, FROM_RAYS),
    "back": (1, FROM_RAYS),
    "dolly": (1, ()),
}
"""Control to another value, and to the stages that must run again and no other."""


def shown(tier: str = "", cache: StageCache | None = None, /, **given: Value) -> Frame:
    return SCENE.render(SCENE.check(given), tier, cache or StageCache())


def photograph(frame: Frame) -> Raster:
    raster = frame.panels[0].raster
    assert raster is not None
    return raster


def computed(frame: Frame) -> list[str]:
    return [stage.name for stage in frame.stages if stage.status == "computed"]


def computed_after(change: Setting, start: Setting | None = None) -> list[str]:
    cache, given = StageCache(), start or {}
    shown("", cache, **given)
    return computed(shown("", cache, **{**given, **change}))


def outputs(tier: str = "layers", **given: Value) -> Outputs:
    return SCENE.run(SCENE.check(given), tier, StageCache()).outputs


def test_nothing_is_computed_where_nothing_has_changed() -> None:
    assert computed_after({}) == []


def test_every_control_has_its_list_of_stages() -> None:
    assert set(AFTER_MOVING) == {control.name for control in SCENE.controls}


@pytest.mark.parametrize("control", AFTER_MOVING)
def test_a_control_runs_its_own_stages_and_no_other(control: str) -> None:
    value, expected = AFTER_MOVING[control]
    assert tuple(computed_after({control: value}, BENT)) == expected


def test_a_straight_and_sharp_picture_skips_blur_and_bending() -> None:
    after = computed_after({"light_angle": -20})
    assert tuple(after) == ("light", *FROM_OVERLAY)


def test_the_straight_picture_serves_every_lens_of_the_same_margin() -> None:
    """Until the margin no longer suffices: then the whole picture is drawn, once."""
    cache, again = StageCache(), []
    shown("", cache, k1=0)
    for hundredths in range(-1, -41, -1):
        again.append("surfaces" in computed(shown("", cache, k1=hundredths / 100)))
    assert not again[0], "the first margin is there before the lens bends anything"
    assert 0 < sum(again) <= 5


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.01, 0.01])
def test_the_first_touch_of_k1_finds_its_margin_drawn(focal_length: int, k1: float) -> None:
    after = computed_after({"k1": k1}, {"focal_length": focal_length})
    assert tuple(after) == ("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE)


def test_a_margin_that_nothing_reads_changes_nothing() -> None:
    """The picture of a straight lens, cut out of a larger one, is that of rays of its own size."""
    cut, whole = outputs(k1=0), outputs("bent-rays", k1=0)
    assert cut["surfaces"][0].coverage.shape != whole["surfaces"][0].coverage.shape
    inner = (slice(None), slice(2, -2), slice(2, -2))  # patterns of the last rows lack a neighbour
    np.testing.assert_allclose(
        cut["vignetting"][inner], whole["vignetting"][inner], rtol=1e-4, atol=1e-5
    )


@pytest.mark.parametrize(
    ("noise", "drawn"),
    [
        ({"noise_sigma": 0, "shot_noise": False}, False),
        ({"noise_sigma": 0, "shot_noise": True}, True),
        ({"noise_sigma": 5, "shot_noise": False}, True),
    ],
)
def test_grain_is_drawn_only_where_it_shows(noise: Setting, drawn: bool) -> None:
    frame = shown(**noise)
    assert ("grain" in computed(frame)) is drawn


def test_rays_through_the_lens_need_no_picture_of_its_centre() -> None:
    frame = shown("aperture-rays", aperture=8, focal_length=135)
    assert "aperture rays" in computed(frame)
    assert not {"surfaces", "light", "defocus", "overlay"} & set(computed(frame))


def test_bent_rays_must_look_again_at_every_change_of_the_lens() -> None:
    cache = StageCache()
    shown("bent-rays", cache, k1=-0.10)
    after = computed(shown("bent-rays", cache, k1=-0.11))
    assert after[:3] == ["bent rays", "surfaces", "light"]


def test_neutral_stages_hand_on_the_same_object() -> None:
    result = outputs(k1=0, aperture=22, noise_sigma=0, shot_noise=False)
    assert result["bent rays"] is result["pinhole rays"]
    assert result["lens distortion"] is result["enlargement"] is result["overlay"]
    assert result["trimming"].base is result["overlay"]
    assert result["defocus"] is result["light"]
    assert result["read noise"] is result["shot noise"] is result["exposure"]


def test_skipped_defocus_would_have_changed_nothing() -> None:
    """The pinhole shortcut is taken only where the blur would return the picture it was given."""
    assert blur_of(SCENE.check({"aperture": 5.6})) <= 1
    stages = {stage.name: stage for stage in STAGES}
    lit = outputs(aperture=5.6)["light"]
    blurred = stages["defocus"].compute(
        lit, focal_length=50.0, aperture=5.6, focus=3.2, reduction=1
    )
    assert blurred.base is lit.base
    assert all(a.planes is b.planes for a, b in zip(blurred.layers, lit.layers, strict=True))


@pytest.mark.parametrize("focus", [1.0, 10.0])
def test_silhouettes_of_balls_lie_where_projection_puts_them(focus: float) -> None:
    """Centroid of each ball's coverage against the centre of its projected outline."""
    sensor_mm = 24.0 * focus / (focus - 0.024)
    done = outputs(focal_length=24, focus=focus)
    rows, columns = done["pinhole rays"].valid.shape
    K = pinhole.intrinsics(sensor_mm / PITCH_MM, ((columns - 1) / 2, (rows - 1) / 2))
    seen = 0
    for surface in done["surfaces"]:
        if surface.thing is None or not isinstance(surface.thing.solid, Sphere):
            continue
        ball = surface.thing.solid
        centre = pinhole.world_to_camera(ball.centre, still_life.WORLD_TO_CAMERA)
        dual = K @ (np.outer(centre, centre) - ball.radius**2 * np.eye(3)) @ K.T
        column, row = dual[:2, 2] / dual[2, 2]
        rows, columns = np.indices(surface.coverage.shape)
        weight = surface.coverage / surface.coverage.sum()
        assert (weight * columns).sum() + surface.left == pytest.approx(column, abs=0.05)
        assert (weight * rows).sum() + surface.top == pytest.approx(row, abs=0.05)
        seen += 1
    assert seen == 4


def test_no_two_things_overlap_or_sink_into_the_floor() -> None:
    balls = [thing.solid for thing in still_life.THINGS if isinstance(thing.solid, Sphere)]
    for first, second in itertools.combinations(balls, 2):
        assert math.dist(first.centre, second.centre) > first.radius + second.radius
    assert all(ball.centre[2] == ball.radius for ball in balls)


def test_read_noise_has_the_stated_sigma() -> None:
    result = outputs(noise_sigma=12, shot_noise=False)
    noise = result["read noise"] - result["exposure"]
    assert noise.std() == pytest.approx(read_noise_e(12), rel=0.01)
    assert noise.mean() == pytest.approx(0, abs=read_noise_e(12) * 0.02)
    assert read_noise_e(255) == FULL_WELL_E


def test_shot_noise_has_the_variance_of_its_mean() -> None:
    result = outputs(noise_sigma=0, exposure=-1)
    mean = result["exposure"]
    normalised = (result["shot noise"] - mean) / np.sqrt(np.maximum(mean, 1))
    assert normalised[mean > 50].var() == pytest.approx(1, abs=0.02)


def test_taking_it_again_changes_only_the_noise() -> None:
    first, second = outputs(new_noise=0), outputs(new_noise=1)
    assert np.array_equal(first["exposure"], second["exposure"])
    assert np.corrcoef(
        (first["shot noise"] - first["exposure"]).ravel(),
        (second["shot noise"] - second["exposure"]).ravel(),
    )[0, 1] == pytest.approx(0, abs=0.02)


def test_one_stop_more_doubles_the_light_where_nothing_is_clipped() -> None:
    quiet: Setting = {"noise_sigma": 0, "shot_noise": False}
    dim, bright = (photograph(shown(exposure=stops, **quiet)) for stops in (-2, -1))
    mid = (dim[..., :3] > 60) & (bright[..., :3] < 240)
    ratio = decode_srgb(bright[..., :3] / 255.0)[mid] / decode_srgb(dim[..., :3] / 255.0)[mid]
    assert np.median(ratio) == pytest.approx(2, rel=0.01)


def test_without_noise_the_photograph_is_that_of_an_ideal_sensor() -> None:
    psnr = readouts(noise_sigma=0, shot_noise=False)["psnr"]
    assert psnr == "∞" or float(psnr) > 55  # quantisation to 12 bits is all that is left


def test_vignetting_darkens_a_wide_lens_by_cos4() -> None:
    """By the angle at which the sensor's corner sees the lens, from where the focus puts it."""
    for focal_length, focus in ((24, 10.0), (135, 1.0)):
        result = outputs(focal_length=focal_length, focus=focus)
        lit = result["trimming"][:, 0, 0] > 0
        ratio = (result["vignetting"] / np.maximum(result["trimming"], 1e-6))[lit, 0, 0]
        r = math.hypot((COLUMNS - 1) / 2, (ROWS - 1) / 2) * PITCH_MM
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        assert ratio == pytest.approx(math.cos(math.atan(r / sensor_mm)) ** 4, rel=1e-4)


def readouts(**given: Value) -> dict[str, str]:
    return {item.name: item.text for item in shown(**given).readouts}


def test_the_picture_breathes_with_the_focus() -> None:
    """The field of view is that of the sensor's distance, and the plan shows the same."""
    near, far = readouts(focal_length=135, focus=1), readouts(focal_length=135, focus=10)
    assert (near["sensor_distance"], far["sensor_distance"]) == ("156.1", "136.8")
    for told, sensor_mm in ((near, 135 / 0.865), (far, 135 / 0.9865)):
        angle = 2 * math.degrees(math.atan(18 / sensor_mm))
        assert told["field_of_view"] == f"{angle:.1f}"


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.4, -0.1, 0.0, 0.1, 0.4])
def test_the_field_of_view_is_that_of_the_rays_that_the_lens_bends(
    focal_length: float, k1: float
) -> None:
    """Its edge is sent to the sensor's, or lies on the fold where no ray is sent so far out."""
    settings = SCENE.check({"focal_length": focal_length, "k1": k1})
    edge, r = 18.0 / principal_mm(focal_length, 3.2), math.tan(view_of(settings) / 2)
    if k1 == -0.4 and focal_length == 24:
        assert r == pytest.approx(math.sqrt(1 / 1.2), rel=1e-9)
        return
    assert r * (1 + k1 * r * r) == pytest.approx(edge, rel=1e-9)
    told = readouts(focal_length=focal_length, k1=k1)["field_of_view"]
    assert told == f"{math.degrees(2 * math.atan(r)):.1f}"


def test_the_automatic_makes_good_what_focus_and_aperture_take_away() -> None:
    """Light on the axis goes as the solid angle of the opening seen from the sensor."""
    for focal_length, aperture, focus in ((50, 8, 10.0), (135, 8, 1.0), (135, 2, 1.0)):
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        gathered = (focal_length / aperture / sensor_mm) ** 2
        assert shutter_s(focal_length, aperture, focus, 0.0) * gathered == pytest.approx(
            shutter_s(50, 8, math.inf, 0.0) / 8**2
        )
    assert readouts(focal_length=135, focus=1)["shutter"] != readouts(focal_length=135)["shutter"]


def test_the_byte_of_each_code_is_that_of_its_light() -> None:
    linear = (np.arange(4096) - ADC.black_level_dn) / (4095 - ADC.black_level_dn)
    exact = 255 * encode_srgb(np.clip(linear, 0, 1))
    np.testing.assert_array_equal(BYTE_OF_CODE, np.rint(exact))
    assert BYTE_OF_CODE[[0, 512, 4095]].tolist() == [0, 0, 255]


def test_more_than_a_full_well_is_white_and_less_than_nothing_black() -> None:
    electrons = np.array([-1e4, 0.0, FULL_WELL_E, 1e6], np.float32).reshape(1, 2, 2)
    electrons = np.repeat(electrons, 3, axis=0)
    picture = encode(quantise(electrons))
    assert picture[..., 0].ravel().tolist() == [0, 0, 255, 255]
    assert (picture[..., 3] == 255).all()


def test_the_grain_of_light_and_amplifier_is_normal_and_independent() -> None:
    grain = draw_grain(3)
    for noise in (grain.shot, grain.read):
        assert noise.dtype == np.float32
        assert noise.mean() == pytest.approx(0, abs=0.01)
        assert noise.std() == pytest.approx(1, abs=0.01)
    assert np.corrcoef(grain.shot.ravel(), grain.read.ravel())[0, 1] == pytest.approx(0, abs=0.02)


def pulled(handle: str, place: tuple[float, float], **given: Value) -> Setting:
    return SCENE.pull(SCENE.check(given), handle, place)


@pytest.mark.parametrize("k1", [-0.3, 0.0, 0.3])
def test_the_edge_of_the_view_is_pulled_by_the_focal_length_that_images_it_on_the_sensor_s(
    k1: float,
) -> None:
    """A tangent of one half; the lens formula does the rest."""
    x, y = on_plan(-0.5 * EDGE_DEPTH, EDGE_DEPTH)
    sensor_mm = 18.0 / (0.5 * (1 + k1 * 0.25))
    expected = 1 / (1 / sensor_mm + 1 / 3200)
    assert pulled("edge", (x, y), k1=k1) == {"focal_length": round(expected)}


@pytest.mark.parametrize("k1", [-0.2, 0.2])
@pytest.mark.parametrize("thing", still_life.THINGS[:5], ids=lambda thing: thing.name)
def test_a_press_at_a_thing_in_the_photograph_brings_it_into_focus(
    thing: still_life.Thing, k1: float
) -> None:
    """All but the plum box, whose middle the green ball hides."""
    lens = Distortion(k1=k1)
    x, y, z = pinhole.world_to_camera(thing.solid.centre, still_life.WORLD_TO_CAMERA)
    sensor = 35.0 / (1 - 0.035 / 3.2) * distort((x / z, y / z), lens)
    place = (200 + sensor[0] * 400 / 36, 133.5 + sensor[1] * 267 / 24)
    values = pulled("aim", place, focal_length=35, k1=k1)
    assert values["focus"] == pytest.approx(z, abs=0.051)


def test_a_press_where_no_ray_arrives_leaves_the_focus() -> None:
    assert pulled("aim", (1.0, 1.0), focal_length=24, k1=-0.4) == {}


def test_the_lamp_stands_in_the_plan_where_its_light_comes_from() -> None:
    """45° to the right of the way from the still life to the camera."""
    x, y = on_plan(2.0, STILL_LIFE_MIDDLE - 2.0)
    assert pulled("lamp", (x, y)) == {"light_angle": 45}


@pytest.mark.parametrize("name", ["striped ball", "red ball", "pearl"])
def test_a_dolly_zoom_keeps_the_striped_ball_and_squeezes_the_depth(name: str) -> None:
    """Three metres back, each outline has the area of its ellipse at z and Z of the new place."""
    areas, ellipses = [], []
    for back in (0, 3):
        parts = outputs(back=back, focal_length=24)["surfaces"]
        (ball,) = (part for part in parts if part.thing and part.thing.name == name)
        x, y, z = pinhole.world_to_camera(ball.thing.solid.centre, still_life.WORLD_TO_CAMERA)
        away, r = z + back, ball.thing.solid.radius
        assert ball.depth.max() == pytest.approx(away)
        scale = (KEPT_M + back) / KEPT_M
        outline = math.sqrt(x**2 + y**2 + away**2 - r**2) / (away**2 - r**2) ** 1.5
        areas.append(ball.coverage.sum())
        ellipses.append(scale**2 * outline)
    assert areas[1] / areas[0] == pytest.approx(ellipses[1] / ellipses[0], rel=0.01)
    assert (name == "striped ball") == (abs(areas[1] / areas[0] - 1) < 0.03)


def test_after_a_step_back_the_lens_is_longer_and_the_focus_on_the_same_thing() -> None:
    now = after_step(SCENE.check({"back": 2}))
    assert now.focus == pytest.approx(5.2)
    before = principal_mm(50, 3.2) / KEPT_M
    assert principal_mm(now.focal_length, now.focus) / (KEPT_M + 2) == pytest.approx(before)
    assert focal_before_step(principal_mm(now.focal_length, 5.2), 3.2, 2) == pytest.approx(50)


def test_the_focus_is_pulled_along_the_plan_to_the_wall_and_behind() -> None:
    assert pulled("focus", on_plan(0.0, 4.4)) == {"focus": 4.4}
    assert pulled("focus", focus_mark(9.3)) == {"focus": 9.3}
