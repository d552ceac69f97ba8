"""Which stages of the camera run at a touch of which control, and what a stage left out changes."""

from functools import partial

import numpy as np
import pytest
from support.frames import computed_in, frame_of, outputs_of

from simulations.engine.controls import Value
from simulations.engine.stages import Outputs, StageCache
from simulations.scenes.camera.scene import SCENE, blur_of
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


shown = partial(frame_of, SCENE)


def computed_after(change: Setting, start: Setting | None = None) -> tuple[str, ...]:
    cache, given = StageCache(), start or {}
    shown("", cache, **given)
    return computed_in(shown("", cache, **{**given, **change}))


def outputs(tier: str = "layers", **given: Value) -> Outputs:
    return outputs_of(SCENE, tier, **given)


def test_nothing_is_computed_where_nothing_has_changed() -> None:
    assert computed_after({}) == ()


def test_every_control_has_its_list_of_stages() -> None:
    assert set(AFTER_MOVING) == {control.name for control in SCENE.controls}


@pytest.mark.parametrize("control", AFTER_MOVING)
def test_a_control_runs_its_own_stages_and_no_other(control: str) -> None:
    value, expected = AFTER_MOVING[control]
    assert computed_after({control: value}, BENT) == expected


def test_a_straight_and_sharp_picture_skips_blur_and_bending() -> None:
    after = computed_after({"light_angle": -20})
    assert after == ("light", *FROM_OVERLAY)


def test_the_straight_picture_serves_every_lens_of_the_same_margin() -> None:
    """Until the margin no longer suffices: then the whole picture is drawn, once."""
    cache, again = StageCache(), []
    shown("", cache, k1=0)
    for hundredths in range(-1, -41, -1):
        again.append("surfaces" in computed_in(shown("", cache, k1=hundredths / 100)))
    assert not again[0], "the first margin is there before the lens bends anything"
    assert 0 < sum(again) <= 5


@pytest.mark.parametrize("focal_length", [24, 50, 135])
@pytest.mark.parametrize("k1", [-0.01, 0.01])
def test_the_first_touch_of_k1_finds_its_margin_drawn(focal_length: int, k1: float) -> None:
    after = computed_after({"k1": k1}, {"focal_length": focal_length})
    assert after == ("lens map", "lens distortion", "vignetting", *FROM_EXPOSURE)


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
    assert ("grain" in computed_in(frame)) is drawn


def test_rays_through_the_lens_need_no_picture_of_its_centre() -> None:
    frame = shown("aperture-rays", aperture=8, focal_length=135)
    assert "aperture rays" in computed_in(frame)
    assert not {"surfaces", "light", "defocus", "overlay"} & set(computed_in(frame))


def test_bent_rays_must_look_again_at_every_change_of_the_lens() -> None:
    cache = StageCache()
    shown("bent-rays", cache, k1=-0.10)
    after = computed_in(shown("bent-rays", cache, k1=-0.11))
    assert after[:3] == ("bent rays", "surfaces", "light")


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
        lit, focal_length=50.0, aperture=5.6, focus=3.2, reduction=1, enlarged=1.0
    )
    assert blurred.base is lit.base
    assert all(a.planes is b.planes for a, b in zip(blurred.layers, lit.layers, strict=True))
