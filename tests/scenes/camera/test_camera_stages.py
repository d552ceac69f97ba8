"""Which stages of the camera run at a touch of which control, and what a stage left out changes."""

from functools import partial

import numpy as np
import pytest
from support.frames import computed_in, frame_of, outputs_of

from simulations.engine.controls import Value
from simulations.engine.stages import Outputs, StageCache
from simulations.scenes._still_life_camera.picture import SHARP_PX
from simulations.scenes.camera.scene import SCENE, blur_of, references, rms_codes

type Setting = dict[str, Value]
LAST = ("quantisation", "sRGB", "noiseless picture")
FROM_EXPOSURE = ("exposure", "shot noise", "read noise", *LAST)


shown = partial(frame_of, SCENE)


def computed_after(change: Setting, start: Setting | None = None) -> tuple[str, ...]:
    cache, given = StageCache(), start or {}
    shown("", cache, **given)
    return computed_in(shown("", cache, **{**given, **change}))


def outputs(tier: str = "layers", **given: Value) -> Outputs:
    return outputs_of(SCENE, tier, **given)


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


def test_rays_are_sent_through_the_lens_however_narrow_it_is() -> None:
    """A picture of rays is the dearest there is: it is never exchanged for one of a pinhole."""
    assert blur_of(SCENE.check({"aperture": 22})) < SHARP_PX
    assert "aperture rays" in computed_in(shown("aperture-rays", aperture=22))


def codes_off(tier: str, **given: Value) -> float:
    """RMS against many rays through the lens."""
    *_, truth = references(SCENE.check(given))
    return rms_codes(outputs(tier, **given)["noiseless picture"], truth)


@pytest.mark.parametrize(
    ("focal_length", "focus"), [(50, 3.2), pytest.param(35, 1.9, marks=pytest.mark.deep)]
)
def test_a_blur_narrower_than_a_pixel_brings_the_picture_nearer_to_the_truth(
    focal_length: int, focus: float
) -> None:
    """By a quarter of the error, to which hard edges add some that no blur of layers mends."""
    lens: Setting = {"focal_length": focal_length, "focus": focus}
    *_, truth = references(SCENE.check({**lens, "aperture": 5.6}))
    pinhole, blurred = (
        rms_codes(outputs("layers", **{**lens, "aperture": aperture})["noiseless picture"], truth)
        for aperture in (22, 5.6)
    )
    assert blur_of(SCENE.check({**lens, "aperture": 5.6})) < 1
    assert blurred < 0.8 * pinhole


@pytest.mark.deep
@pytest.mark.parametrize(
    ("tier", "apertures"),
    [
        ("layers", (4, 5.6, 11, 22)),
        ("aperture-rays", (4, 5.6, 11, 22)),
    ],
)
def test_stopping_down_brings_every_tier_nearer_to_the_truth(
    tier: str, apertures: tuple[float, ...]
) -> None:
    off = [codes_off(tier, aperture=aperture) for aperture in apertures]
    assert off == sorted(off, reverse=True)
