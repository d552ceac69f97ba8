"""The camera simulator: stages, extremes, and whether the photograph is what theory says."""

import itertools
import math

import numpy as np
import pytest

from simulations.engine.controls import Slider, check_values
from simulations.engine.pipeline import StageCache
from simulations.models import projection
from simulations.models.color import decode_srgb, encode_srgb
from simulations.models.raycasting import Sphere
from simulations.pictures import still_life
from simulations.scenes.camera import CONTROLS, SCENE, run_tier, view_of
from simulations.scenes.camera_lens import COLUMNS, PITCH_MM, ROWS, largest_blur_px, principal_mm
from simulations.scenes.camera_sensor import (
    ADC,
    BYTE_OF_CODE,
    FULL_WELL_E,
    draw_grain,
    encode,
    quantise,
    read_noise_e,
    shutter_s,
)
from simulations.scenes.camera_stages import STAGES, TIERS

LAST = ("quantisation", "sRGB", "noiseless picture")
FROM_EXPOSURE = ("exposure", "shot noise", "read noise", *LAST)
FROM_OVERLAY = ("overlay", "trimming", "vignetting", *FROM_EXPOSURE)
BENT = {"aperture": 2.0, "k1": -0.1}
"""Where no stage of the default tier is neutral, but for those of other tiers."""
FROM_RAYS = (
    *("pinhole rays", "surfaces", "light", "defocus", "overlay"),
    *("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE),
)
AFTER_MOVING = {
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
}
"""Control to another value, and to the stages that must run again and no other."""


def values(**given):
    return check_values(CONTROLS, given)


def computed(frame):
    return [stage.name for stage in frame.stages if stage.status == "computed"]


def computed_after(change, start=None):
    cache = StageCache()
    SCENE.render(values(**(start or {})), "", cache)
    return computed(SCENE.render(values(**{**(start or {}), **change}), "", cache))


def outputs(**given):
    return run_tier(values(**given), "layers", StageCache()).outputs


def test_nothing_is_computed_where_nothing_has_changed():
    assert computed_after({}) == []


def test_every_control_has_its_list_of_stages():
    assert set(AFTER_MOVING) == {control.name for control in CONTROLS}


@pytest.mark.parametrize("control", AFTER_MOVING)
def test_a_control_runs_its_own_stages_and_no_other(control):
    value, expected = AFTER_MOVING[control]
    assert tuple(computed_after({control: value}, BENT)) == expected


def test_a_straight_and_sharp_picture_skips_blur_and_bending():
    after = computed_after({"light_angle": -20})
    assert tuple(after) == ("light", *FROM_OVERLAY)


def test_the_straight_picture_serves_every_lens_of_the_same_margin():
    """Until the margin no longer suffices: then the whole picture is drawn, once."""
    cache, again = StageCache(), []
    SCENE.render(values(k1=0), "", cache)
    for hundredths in range(-1, -41, -1):
        frame = SCENE.render(values(k1=hundredths / 100), "", cache)
        again.append("surfaces" in computed(frame))
    assert not again[0], "the first margin is there before the lens bends anything"
    assert 0 < sum(again) <= 5


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.01, 0.01])
def test_the_first_touch_of_k1_finds_its_margin_drawn(focal_length, k1):
    after = computed_after({"k1": k1}, {"focal_length": focal_length})
    assert tuple(after) == ("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE)


def test_a_margin_that_nothing_reads_changes_nothing():
    """The picture of a straight lens, cut out of a larger one, is that of rays of its own size."""
    cut, whole = outputs(k1=0), run_tier(values(k1=0), "bent-rays", StageCache()).outputs
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
def test_grain_is_drawn_only_where_it_shows(noise, drawn):
    frame = SCENE.render(values(**noise), "", StageCache())
    assert ("grain" in computed(frame)) is drawn


def test_rays_through_the_lens_need_no_picture_of_its_centre():
    frame = SCENE.render(values(aperture=8, focal_length=135), "aperture-rays", StageCache())
    assert "aperture rays" in computed(frame)
    assert not {"surfaces", "light", "defocus", "overlay"} & set(computed(frame))


def test_bent_rays_must_look_again_at_every_change_of_the_lens():
    cache = StageCache()
    SCENE.render(values(k1=-0.10), "bent-rays", cache)
    after = computed(SCENE.render(values(k1=-0.11), "bent-rays", cache))
    assert after[:3] == ["bent rays", "surfaces", "light"]


def test_neutral_stages_hand_on_the_same_object():
    result = outputs(k1=0, aperture=22, noise_sigma=0, shot_noise=False)
    assert result["bent rays"] is result["pinhole rays"]
    assert result["lens distortion"] is result["enlargement"] is result["overlay"]
    assert result["trimming"].base is result["overlay"]
    assert result["defocus"] is result["light"]
    assert result["read noise"] is result["shot noise"] is result["exposure"]


def test_skipped_defocus_would_have_changed_nothing():
    """The pinhole shortcut is taken only where the blur would return the picture it was given."""
    given = values(aperture=5.6)
    assert largest_blur_px(given) <= 1
    stages = {stage.name: stage for stage in STAGES}
    lit = run_tier(given, "layers", StageCache()).outputs["light"]
    blurred = stages["defocus"].compute(
        lit, focal_length=50.0, aperture=5.6, focus=3.2, reduction=1
    )
    assert blurred.base is lit.base
    assert all(a.planes is b.planes for a, b in zip(blurred.layers, lit.layers, strict=True))


@pytest.mark.parametrize("tier", [tier for tier in TIERS if tier != "aperture-rays"])
@pytest.mark.parametrize(
    "change",
    [{control: value} for control, (value, _) in AFTER_MOVING.items()]
    + [{"k1": k1} for k1 in (-0.4, 0.0, 0.2)],
    ids=str,
)
def test_cached_photograph_is_bit_equal_to_a_cold_one(change, tier):
    cache = StageCache()
    SCENE.render(values(**BENT), tier, cache)
    warm = SCENE.render(values(**{**BENT, **change}), tier, cache)
    cold = SCENE.render(values(**{**BENT, **change}), tier, StageCache())
    assert np.array_equal(warm.panels[0].raster, cold.panels[0].raster)
    assert warm.readouts == cold.readouts


@pytest.mark.parametrize("focus", [1.0, 10.0])
def test_silhouettes_of_balls_lie_where_projection_puts_them(focus):
    """Centroid of each ball's coverage against the centre of its projected outline."""
    sensor_mm = 24.0 * focus / (focus - 0.024)
    done = outputs(focal_length=24, focus=focus)
    rows, columns = done["pinhole rays"].valid.shape
    K = projection.intrinsics(sensor_mm / PITCH_MM, ((columns - 1) / 2, (rows - 1) / 2))
    seen = 0
    for surface in done["surfaces"]:
        if surface.thing is None or not isinstance(surface.thing.solid, Sphere):
            continue
        ball = surface.thing.solid
        centre = projection.world_to_camera(ball.centre, still_life.WORLD_TO_CAMERA)
        dual = K @ (np.outer(centre, centre) - ball.radius**2 * np.eye(3)) @ K.T
        column, row = dual[:2, 2] / dual[2, 2]
        rows, columns = np.indices(surface.coverage.shape)
        weight = surface.coverage / surface.coverage.sum()
        assert (weight * columns).sum() + surface.left == pytest.approx(column, abs=0.05)
        assert (weight * rows).sum() + surface.top == pytest.approx(row, abs=0.05)
        seen += 1
    assert seen == 4


def test_no_two_things_overlap_or_sink_into_the_floor():
    balls = [thing.solid for thing in still_life.THINGS if isinstance(thing.solid, Sphere)]
    for first, second in itertools.combinations(balls, 2):
        assert math.dist(first.centre, second.centre) > first.radius + second.radius
    assert all(ball.centre[2] == ball.radius for ball in balls)


def test_read_noise_has_the_stated_sigma():
    result = outputs(noise_sigma=12, shot_noise=False)
    noise = result["read noise"] - result["exposure"]
    assert noise.std() == pytest.approx(read_noise_e(12), rel=0.01)
    assert noise.mean() == pytest.approx(0, abs=read_noise_e(12) * 0.02)
    assert read_noise_e(255) == FULL_WELL_E


def test_shot_noise_has_the_variance_of_its_mean():
    result = outputs(noise_sigma=0, exposure=-1)
    mean = result["exposure"]
    normalised = (result["shot noise"] - mean) / np.sqrt(np.maximum(mean, 1))
    assert normalised[mean > 50].var() == pytest.approx(1, abs=0.02)


def test_taking_it_again_changes_only_the_noise():
    first, second = outputs(new_noise=0), outputs(new_noise=1)
    assert np.array_equal(first["exposure"], second["exposure"])
    assert np.corrcoef(
        (first["shot noise"] - first["exposure"]).ravel(),
        (second["shot noise"] - second["exposure"]).ravel(),
    )[0, 1] == pytest.approx(0, abs=0.02)


def test_one_stop_more_doubles_the_light_where_nothing_is_clipped():
    quiet = {"noise_sigma": 0, "shot_noise": False}
    dim = SCENE.render(values(exposure=-2, **quiet), "", StageCache()).panels[0].raster
    bright = SCENE.render(values(exposure=-1, **quiet), "", StageCache()).panels[0].raster
    mid = (dim[..., :3] > 60) & (bright[..., :3] < 240)
    ratio = decode_srgb(bright[..., :3] / 255.0)[mid] / decode_srgb(dim[..., :3] / 255.0)[mid]
    assert np.median(ratio) == pytest.approx(2, rel=0.01)


def test_without_noise_the_photograph_is_that_of_an_ideal_sensor():
    frame = SCENE.render(values(noise_sigma=0, shot_noise=False), "", StageCache())
    psnr = next(item.text for item in frame.readouts if item.name == "psnr")
    assert psnr == "∞" or float(psnr) > 55  # quantisation to 12 bits is all that is left


def test_vignetting_darkens_a_wide_lens_by_cos4():
    """By the angle at which the sensor's corner sees the lens, from where the focus puts it."""
    for focal_length, focus in ((24, 10.0), (135, 1.0)):
        result = outputs(focal_length=focal_length, focus=focus)
        lit = result["trimming"][:, 0, 0] > 0
        ratio = (result["vignetting"] / np.maximum(result["trimming"], 1e-6))[lit, 0, 0]
        r = math.hypot((COLUMNS - 1) / 2, (ROWS - 1) / 2) * PITCH_MM
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        assert ratio == pytest.approx(math.cos(math.atan(r / sensor_mm)) ** 4, rel=1e-4)


def readouts(**given):
    frame = SCENE.render(values(**given), "", StageCache())
    return {item.name: item.text for item in frame.readouts}


def test_the_picture_breathes_with_the_focus():
    """The field of view is that of the sensor's distance, and the plan shows the same."""
    near, far = readouts(focal_length=135, focus=1), readouts(focal_length=135, focus=10)
    assert (near["sensor_distance"], far["sensor_distance"]) == ("156.1", "136.8")
    for told, sensor_mm in ((near, 135 / 0.865), (far, 135 / 0.9865)):
        angle = 2 * math.degrees(math.atan(18 / sensor_mm))
        assert told["field_of_view"] == f"{angle:.1f}"


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.4, -0.1, 0.0, 0.1, 0.4])
def test_the_field_of_view_is_that_of_the_rays_that_the_lens_bends(focal_length, k1):
    """Its edge is sent to the sensor's, or lies on the fold where no ray is sent so far out."""
    setting = values(focal_length=focal_length, k1=k1)
    edge, r = 18.0 / principal_mm(focal_length, 3.2), math.tan(view_of(setting) / 2)
    if k1 == -0.4 and focal_length == 24:
        assert r == pytest.approx(math.sqrt(1 / 1.2), rel=1e-9)
        return
    assert r * (1 + k1 * r * r) == pytest.approx(edge, rel=1e-9)
    told = readouts(focal_length=focal_length, k1=k1)["field_of_view"]
    assert told == f"{math.degrees(2 * math.atan(r)):.1f}"


def test_the_automatic_makes_good_what_focus_and_aperture_take_away():
    """Light on the axis goes as the solid angle of the opening seen from the sensor."""
    for focal_length, aperture, focus in ((50, 8, 10.0), (135, 8, 1.0), (135, 2, 1.0)):
        sensor_mm = 1 / (1 / focal_length - 1 / (1000 * focus))
        gathered = (focal_length / aperture / sensor_mm) ** 2
        assert shutter_s(focal_length, aperture, focus, 0.0) * gathered == pytest.approx(
            shutter_s(50, 8, math.inf, 0.0) / 8**2
        )
    assert readouts(focal_length=135, focus=1)["shutter"] != readouts(focal_length=135)["shutter"]


def test_the_byte_of_each_code_is_that_of_its_light():
    linear = (np.arange(4096) - ADC.black_level_dn) / (4095 - ADC.black_level_dn)
    exact = 255 * encode_srgb(np.clip(linear, 0, 1))
    np.testing.assert_array_equal(BYTE_OF_CODE, np.rint(exact))
    assert BYTE_OF_CODE[[0, 512, 4095]].tolist() == [0, 0, 255]


def test_more_than_a_full_well_is_white_and_less_than_nothing_black():
    electrons = np.array([-1e4, 0.0, FULL_WELL_E, 1e6], np.float32).reshape(1, 2, 2)
    electrons = np.repeat(electrons, 3, axis=0)
    picture = encode(quantise(electrons))
    assert picture[..., 0].ravel().tolist() == [0, 0, 255, 255]
    assert (picture[..., 3] == 255).all()


def test_the_grain_of_light_and_amplifier_is_normal_and_independent():
    grain = draw_grain(3)
    for noise in (grain.shot, grain.read):
        assert noise.dtype == np.float32
        assert noise.mean() == pytest.approx(0, abs=0.01)
        assert noise.std() == pytest.approx(1, abs=0.01)
    assert np.corrcoef(grain.shot.ravel(), grain.read.ravel())[0, 1] == pytest.approx(0, abs=0.02)


SLIDERS = [control for control in CONTROLS if isinstance(control, Slider)]
ENDS = [(control.name, end) for control in SLIDERS for end in (control.minimum, control.maximum)]
PAIRS = [dict(pair) for pair in itertools.combinations(ENDS, 2) if pair[0][0] != pair[1][0]]


def test_all_pairs_of_extremes_give_a_clean_frame():
    """Warnings are errors here, and a NaN or infinite coordinate cannot be drawn."""
    cache = StageCache()
    reference = SCENE.render(values(), "", cache)
    for pair in PAIRS:
        frame = SCENE.render(values(**pair), "", cache)
        assert [panel.name for panel in frame.panels] == ["photograph", "plan"]
        assert [r.name for r in frame.readouts] == [r.name for r in reference.readouts]
        assert frame.panels[0].raster.shape == (ROWS, COLUMNS, 4)
        assert "undefined" not in " ".join(item.text for item in frame.readouts)
