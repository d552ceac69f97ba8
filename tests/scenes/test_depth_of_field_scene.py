"""The depth-of-field figure: numbers by hand, limits, refusals, and the blur in the picture."""

import math
from functools import cache, partial
from itertools import islice

import numpy as np
import pytest
from support.frames import estimates_of, texts_at

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Raster
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.lens import thin_lens
from simulations.models.lens.aperture_grid import aperture_grid
from simulations.models.lens.depth_of_field import Layer
from simulations.pictures.still_life.light import LitScene
from simulations.scenes._still_life_camera.picture import through_lens
from simulations.scenes._still_life_camera.rays import PITCH_MM
from simulations.scenes.depth_of_field.drawing import HEIGHT
from simulations.scenes.depth_of_field.scene import (
    LARGEST_DRAWN_PX,
    SCENE,
    drawn_f_number,
    parameters,
)
from simulations.scenes.depth_of_field.sharpness import FAR_M, NEAR_M, sharpness
from simulations.scenes.depth_of_field.stages import COSTLY, QUICK, SPIRALS, depth_of, encode


def frame(tier: str = "", stages: StageCache | None = None, /, **given: Value) -> Frame:
    """Without a cache of ``stages``, all of them are computed: by the first test that asks."""
    if stages is None:
        return drawn_whole(tier, **given)
    return SCENE.render(SCENE.check(given), tier, stages)


@cache
def drawn_whole(tier: str, **given: Value) -> Frame:
    return SCENE.render(SCENE.check(given), tier, StageCache())


def picture_of(shown: Frame) -> Raster:
    raster = shown.panels[0].raster
    assert raster is not None
    return raster


def picture(tier: str = "", stages: StageCache | None = None, /, **given: Value) -> Raster:
    return picture_of(frame(tier, stages, **given))


texts = partial(texts_at, SCENE)


def detail(raster: Raster, rows: slice, columns: slice) -> float:
    """Root mean square of the steps between neighbouring pixels."""
    return float(np.diff(raster[rows, columns, 1].astype(float), axis=1).std())


def test_at_the_limits_of_depth_of_field_the_disc_is_one_pixel() -> None:
    sharp = sharpness(85, 2.8, 3.0)
    for limit_m in (sharp.near_limit_m, sharp.far_limit_m):
        disc = thin_lens.circle_of_confusion_mm(85, 2.8, 3000, 1000 * limit_m)
        assert disc == pytest.approx(PITCH_MM)


def test_from_the_hyperfocal_distance_on_infinity_is_sharp() -> None:
    hyperfocal_m = thin_lens.hyperfocal(24, 8, PITCH_MM) / 1000
    assert math.isfinite(sharpness(24, 8, 0.99 * hyperfocal_m).far_limit_m)
    assert math.isinf(sharpness(24, 8, 1.01 * hyperfocal_m).far_limit_m)
    assert texts(focal_length=24, aperture=8, focus=2)["far_limit"] == "∞"


@pytest.mark.parametrize(
    ("focus", "word", "way"), [(0.05, "inside", "spreading"), (0.10, "at", "parallel")]
)
def test_focus_at_or_inside_the_focal_length_is_refused_with_the_reason(
    focus: float, word: str, way: str
) -> None:
    shown = frame(focal_length=100, focus=focus)
    assert f"lies {word} the focal length of 100 mm" in shown.description
    assert f"leaves the lens {way}," in shown.description
    assert {item.text for item in shown.readouts[:7]} == {"none"}
    assert [panel.name for panel in shown.panels] == ["picture", "lens"]
    assert shown.stages == ()


def test_focus_decides_which_part_of_the_picture_has_detail() -> None:
    near, far = (picture(focal_length=50, focus=focus) for focus in (1.85, 8))
    chart = (slice(30, 120), slice(230, 320))
    assert detail(far, *chart) > 1.5 * detail(near, *chart)


@pytest.mark.parametrize("focal", [24, 49, 135])
@pytest.mark.parametrize("focus", [0.05, 0.15, 0.5, 3.2, 10])
def test_the_drawn_blur_stops_at_its_limit_by_stopping_down(focal: float, focus: float) -> None:
    if 1000 * focus <= focal:
        return
    asked = SCENE.check({"focal_length": focal, "focus": focus})
    drawn = drawn_f_number(asked)
    ends_mm = [1000 * NEAR_M, 1000 * FAR_M]
    discs = thin_lens.circle_of_confusion_mm(focal, drawn, 1000 * focus, ends_mm)
    assert discs.max() / PITCH_MM <= LARGEST_DRAWN_PX + 1e-9
    assert drawn >= asked.aperture
    stages_read = parameters(asked, "") or {}
    assert stages_read["aperture"] == drawn
    assert set(stages_read) & set(values_of(asked)) == {"aperture"}
    if 1000 * focus < 500:  # all is behind the focus, and the wall is blurred most
        wall_mm = thin_lens.circle_of_confusion_mm(focal, 1.4, 1000 * focus, 1000 * FAR_M)
        assert drawn == pytest.approx(1.4 * max(1, float(wall_mm) / PITCH_MM / LARGEST_DRAWN_PX))


def test_a_picture_that_is_stopped_down_to_be_drawn_says_so() -> None:
    capped, whole = (frame(focus=focus).panels[0].overlay for focus in (0.25, 0.4))
    assert "drawn at f/1.85: no disc over 48 px" in capped
    assert whole == ""


def width_of_the_red_ball(raster: Raster) -> int:
    """Columns of the widest row of pixels that are red, and not one of the other colours."""
    red, green, blue = (raster[..., part].astype(int) for part in range(3))
    return int(((red > 2 * green) & (red > 2 * blue)).sum(axis=1).max())


def test_the_picture_grows_with_the_sensor_s_distance_from_the_lens() -> None:
    """Not with the focal length: 1/f = 1/s + 1/z puts the sensor at z, and x = z X / Z."""
    near, far = (picture("pinhole", focus=focus) for focus in (0.25, 10))
    z_near, z_far = (1 / (1 / 50 - 1 / mm) for mm in (250, 10_000))
    assert z_near / z_far > 1.2
    wider = width_of_the_red_ball(near) / width_of_the_red_ball(far)
    assert wider == pytest.approx(z_near / z_far, rel=0.03)


def test_every_tier_and_what_it_is_judged_by_have_the_same_scale() -> None:
    """The sensor stands 12 % farther off than the focal length: any mix of the two is far off."""
    lens: dict[str, Value] = {"focal_length": 135, "aperture": 22, "focus": 1.25}
    layered = picture("layered", **lens)[..., :3].astype(float)
    errors = SCENE.estimates(SCENE.check(lens), "layered", StageCache())
    after_ten_rays = next(islice(errors, 9, None))
    assert float(after_ten_rays.text) < 3
    for tier in ("discs", "fibonacci-16"):
        off = picture(tier, **lens)[..., :3] - layered
        assert np.sqrt(np.mean(off**2)) < 3, tier


@pytest.mark.parametrize("tier", [tier for tier in SCENE.tiers if tier not in SPIRALS])
def test_a_lens_that_is_nearly_a_pinhole_is_drawn_without_a_blur(tier: str) -> None:
    shown = frame(tier, aperture=22)
    sharp = picture(QUICK if tier in COSTLY else "pinhole", aperture=22)
    repeated = len(picture_of(shown)) // len(sharp)
    np.testing.assert_array_equal(picture_of(shown)[::repeated, ::repeated], sharp)
    assert sum(stage.status == "skipped" for stage in shown.stages) == 3


@pytest.mark.deep
def test_blur_is_measured_against_rays_through_the_whole_lens() -> None:
    """A pinhole is off by all of the blur, filters by edges only, and rays by least."""
    stages, settings = StageCache(), SCENE.check({})

    @cache
    def truth(tier: str) -> Floats:
        rays = SCENE.run(settings, tier, stages).outputs["pinhole rays"]
        through = (through_lens(rays, at, 40.0, 50.0, 1.4, 3.2) for at in aperture_grid(7))
        return encode(np.mean(list(through), axis=0)).astype(float)

    def off(tier: str) -> float:
        true = truth(QUICK if tier in COSTLY else "pinhole")
        repeated = len(picture(tier, stages)) // len(true)
        seen = picture(tier, stages)[::repeated, ::repeated]
        return math.sqrt(np.mean((seen - true)[..., :3] ** 2))

    final = {tier: off(tier) for tier in SCENE.tiers}
    filters = [final[tier] for tier in ("discs", "binned", "gather")]
    assert final["pinhole"] > 2.5 * max(filters)
    assert min(filters) > final["layered"] > 1.9 * final["fibonacci-16"]
    *_, last = SCENE.estimates(settings, "layered", stages)
    assert float(last.text) == pytest.approx(final["layered"], abs=0.01)


def test_where_no_picture_is_formed_no_error_is_claimed() -> None:
    (estimate,) = estimates_of(SCENE, "layered", focal_length=100, focus=0.1)
    assert (estimate.text, estimate.unit) == ("no picture", "")


def test_the_depth_of_a_pixel_is_that_of_the_foremost_thing() -> None:
    ones = np.ones((4, 3, 4), np.float32)
    half = ones * np.float32(0.5)
    lit = LitScene(
        base=np.zeros((3, 6, 8), np.float32),
        base_depth=np.full((6, 8), 9.0),
        layers=(Layer(ones, 1, 2), Layer(ones, -1, 6), Layer(half, 0, 0), Layer(ones, 5, -2)),
        depths=(5.0, 4.0, 3.0, 2.0),
    )
    expected = np.full((6, 8), 9.0)
    expected[1:4, 2:6] = 5
    expected[0:2, 6:8] = 4
    expected[5, 0:2] = 2
    np.testing.assert_array_equal(depth_of(lit), expected)


@pytest.mark.parametrize("focus", [2.0, 3.2, 6.0])
def test_the_handle_on_the_floor_stands_where_the_floor_is_in_focus(focus: float) -> None:
    (place,) = [place for place in frame(focus=focus).handles if place.name == "floor"]
    lit = SCENE.run(SCENE.check({"focus": focus}), "", StageCache()).outputs["light"]
    depth = lit.base_depth[:, 3]
    row = place.y / HEIGHT * len(depth) - 0.5
    assert np.interp(row, np.arange(len(depth)), depth) == pytest.approx(focus, rel=0.01)


@pytest.mark.parametrize("focus", [0.3, 9.0])
def test_a_focus_that_meets_no_floor_in_view_has_no_line(focus: float) -> None:
    shown = frame(focus=focus)
    assert "floor" not in {place.name for place in shown.handles}
    assert "casing" not in shown.panels[0].overlay
