"""The camera simulator: stages, extremes, and whether the photograph is what theory says."""

import itertools
import math

import numpy as np
import pytest

from simulations.engine.controls import Slider, check_values
from simulations.engine.pipeline import StageCache
from simulations.models import projection
from simulations.models.color import decode_srgb
from simulations.models.raycasting import Sphere
from simulations.pictures import still_life
from simulations.scenes.camera import CONTROLS, SCENE, run_tier
from simulations.scenes.camera_stages import (
    COLUMNS,
    FULL_WELL_E,
    PITCH_MM,
    ROWS,
    STAGES,
    largest_blur_px,
    read_noise_e,
)

DOWNSTREAM_OF_LIGHT = ("overlay", "vignetting", "exposure", "shot noise", "read noise")
LAST = ("quantisation", "sRGB")


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


def test_read_noise_recomputes_only_the_end_of_the_chain():
    assert computed_after({"noise_sigma": 12}) == ["read noise", *LAST]


def test_exposure_leaves_geometry_light_and_lens_alone():
    after = computed_after({"exposure": 1})
    assert after == ["exposure", "shot noise", "read noise", *LAST, "noiseless picture"]


def test_lamp_leaves_geometry_alone():
    after = computed_after({"light_angle": -20})
    assert after == ["light", *DOWNSTREAM_OF_LIGHT, *LAST, "noiseless picture"]


def test_aperture_reuses_the_lit_scene():
    after = computed_after({"aperture": 1.4})
    assert after == ["defocus", *DOWNSTREAM_OF_LIGHT, *LAST, "noiseless picture"]


def test_distortion_reuses_the_pinhole_rays():
    after = computed_after({"k1": -0.1})
    assert "pinhole rays" not in after
    assert after[:3] == ["lens distortion", "surfaces", "light"]


def test_neutral_stages_hand_on_the_same_object():
    result = outputs(k1=0, aperture=22, noise_sigma=0, shot_noise=False)
    assert result["lens distortion"] is result["pinhole rays"]
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


@pytest.mark.parametrize(
    "change", [{"noise_sigma": 9}, {"k1": 0.2}, {"aperture": 2}, {"light_angle": 0}, {"focus": 5}]
)
def test_cached_photograph_is_bit_equal_to_a_cold_one(change):
    cache = StageCache()
    SCENE.render(values(), "", cache)
    warm = SCENE.render(values(**change), "", cache)
    cold = SCENE.render(values(**change), "", StageCache())
    assert np.array_equal(warm.panels[0].raster, cold.panels[0].raster)
    assert warm.readouts == cold.readouts


def test_silhouettes_of_balls_lie_where_projection_puts_them():
    """Centroid of each ball's coverage against the centre of its projected outline."""
    focal_px = 24.0 / PITCH_MM
    K = projection.intrinsics(focal_px, ((COLUMNS - 1) / 2, (ROWS - 1) / 2))
    seen = 0
    for surface in outputs(focal_length=24)["surfaces"]:
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
    result = outputs(focal_length=24)
    lit = result["overlay"][:, 0, 0] > 0
    ratio = (result["vignetting"] / np.maximum(result["overlay"], 1e-6))[lit, 0, 0]
    r = math.hypot((COLUMNS - 1) / 2, (ROWS - 1) / 2) * PITCH_MM
    assert ratio == pytest.approx(math.cos(math.atan(r / 24)) ** 4, rel=1e-4)


def test_strong_barrel_leaves_corners_that_no_ray_reaches():
    result = outputs(focal_length=24, k1=-0.4)
    assert not result["lens distortion"].valid[0, 0]
    assert (result["overlay"][:, 0, 0] == 0).all()


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
