"""The step wedge obeys the noise theory that the chapter states, and measures its own gain."""

import itertools
import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

from simulations.engine.frame import Frame, Raster, Readout
from simulations.engine.photograph import Photograph
from simulations.engine.stages import Outputs, StageCache
from simulations.ladders.shot_noise import LADDER
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_counting import SHOT_MODELS, develop
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.scenes.sensor_noise.error import EXPOSURES
from simulations.scenes.sensor_noise.scene import SCENE
from simulations.scenes.sensor_noise.stages import (
    FULL_WELL_E,
    Transfer,
    patch_means_e,
    sensor_of,
)


def frame(cache: StageCache | None = None, tier: str = "", **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), tier, cache or StageCache())


def raster(shown: Frame) -> Raster:
    pixels = shown.panels[0].raster
    assert pixels is not None
    return pixels


def texts(tier: str = "", **given: object) -> dict[str, str]:
    return {item.name: item.text for item in frame(None, tier, **given).readouts}


def outputs(tier: str = "", **given: object) -> Outputs:
    return SCENE.run(SCENE.check(given), tier, StageCache()).outputs


def transfer(**given: object) -> Transfer:
    measured: Transfer = outputs("poisson", **given)["transfer"]
    return measured


def test_neighbouring_patches_are_half_a_stop_apart() -> None:
    means = patch_means_e(0)
    assert means[::2] == pytest.approx(40_000 / 2.0 ** np.arange(12))
    assert patch_means_e(-1) == pytest.approx(means / 2)


@pytest.mark.parametrize(("iso", "bits"), [("100", 12), ("800", 12), ("100", 14), ("400", 10)])
def test_the_slope_of_the_transfer_curve_is_the_gain(iso: str, bits: int) -> None:
    """1600 pixels know a variance to 3.5 %; a line through a dozen patches to about 2 %."""
    truth = sensor_of(bits, iso, 10).gain_e_per_dn
    gain = transfer(iso=iso, bits=bits).gain
    assert gain is not None
    assert gain.e_per_dn == pytest.approx(truth, rel=0.06)


def test_at_base_iso_the_top_code_is_a_full_well() -> None:
    camera = sensor_of(12, "100", 0)
    assert camera.gain_e_per_dn * (4095 - camera.black_level_dn) == pytest.approx(20_000)
    assert sensor_of(12, "800", 0).gain_e_per_dn == pytest.approx(camera.gain_e_per_dn / 8)


def test_patch_variances_are_shot_plus_read_plus_rounding() -> None:
    measured = transfer(bits=14, read_noise=20)
    gain = sensor_of(14, "100", 20).gain_e_per_dn
    expected = (patch_means_e(0) + 20**2) / gain**2 + 1 / 12
    inside = ~measured.clipped
    assert np.count_nonzero(inside) > 18
    # Four standard deviations of a variance from 1600 samples.
    assert measured.variance_dn[inside] == pytest.approx(
        expected[inside], rel=4 * math.sqrt(2 / 1600)
    )


def test_dark_signal_leaves_the_means_and_lifts_the_variances() -> None:
    without, with_dark = transfer(bits=14), transfer(bits=14, dark=2000)
    gain = sensor_of(14, "100", 10).gain_e_per_dn
    dim = slice(12, 24)
    assert with_dark.mean_dn[dim] == pytest.approx(without.mean_dn[dim], abs=5 / gain)
    lift = (with_dark.variance_dn - without.variance_dn)[dim].mean() * gain**2
    assert lift == pytest.approx(2000, rel=0.04)


def test_raising_the_iso_leaves_the_signal_to_noise_ratio() -> None:
    base, high = (float(texts(iso=iso, patch=13)["snr"]) for iso in ("100", "800"))
    assert base == pytest.approx(23.2, rel=0.08)
    assert high == pytest.approx(23.2, rel=0.08)
    assert texts(patch=13)["theory"] == texts(patch=13, iso="800")["theory"] == "23.2"


def test_saturated_patches_are_left_out_of_the_fit_and_named() -> None:
    measured = transfer()
    assert measured.clipped[:3].all()
    assert not measured.fitted[:3].any()
    assert texts(patch=1)["theory"] == texts(patch=1)["snr"] == "clipped"
    assert "patch 1 is clipped" in frame(patch=1).description


def test_too_few_bits_leave_patches_without_noise() -> None:
    shown = texts(bits=4, patch=18, read_noise=0)
    assert shown["snr"] == "one code only"
    assert "one code only" in frame(bits=4, patch=18, read_noise=0).description


def test_where_no_patch_has_noise_no_gain_is_claimed() -> None:
    shown = frame(bits=4, exposure=-6, read_noise=0)
    assert {item.name: item.text for item in shown.readouts}["gain"] == "not to be told"
    assert "too few patches" in shown.description


@pytest.mark.parametrize("iso", ["100", "800", "6400"])
@pytest.mark.parametrize("bits", [4, 6, 8, 10, 12, 14])
def test_a_gain_is_told_to_within_a_few_of_its_standard_errors_or_not_at_all(
    iso: str, bits: int
) -> None:
    """Coarse codes, hot sensors and full wells once gave gains up to twice the truth, or none."""
    for exposure, dark, read_noise in itertools.product((0, -3, -6), (0, 2000), (0, 10, 60)):
        given = {"iso": iso, "bits": bits, "exposure": exposure}
        measured = transfer(**given, dark=dark, read_noise=read_noise)
        if measured.gain is None:
            continue
        off = measured.gain.e_per_dn - sensor_of(bits, iso, read_noise).gain_e_per_dn
        assert abs(off) < 3.5 * measured.gain.error_e_per_dn, (given, dark, read_noise)
        assert measured.gain.error_e_per_dn < 0.1 * measured.gain.e_per_dn


def test_the_gain_is_shown_with_two_digits_of_its_error() -> None:
    shown = texts()["gain"]
    told, error = (float(part) for part in shown.split(" ± "))
    assert told == pytest.approx(float(texts()["truth"]), abs=3 * error)
    assert shown.split(" ± ")[1].replace(".", "").lstrip("0").isdigit()
    assert 0.005 < error / told < 0.05


def test_a_well_that_heat_has_filled_is_left_out_of_the_fit_although_no_code_is_the_last() -> None:
    """The light of a full cell stops 2000 electrons below the top code, nearly without noise."""
    hot = transfer(dark=2000)
    assert not hot.clipped[3]
    full = np.flatnonzero(patch_means_e(0) + 2000 > FULL_WELL_E)
    assert not hot.fitted[full].any()


def test_dynamic_range_is_the_chapters_example() -> None:
    """20 000 electrons over 3: 12.7 stops, less what rounding at 14 bits takes."""
    assert texts(read_noise=3, bits=14)["range"] == "12.7"


def test_patches_of_the_picture_lie_where_their_labels_do() -> None:
    shown = raster(frame(read_noise=0))[..., 0].astype(float)
    tiles = shown.reshape(4, 40, 6, 40).mean(axis=(1, 3)).ravel()
    assert (np.diff(tiles[2:]) < 0).all()
    assert tiles[0] == 255


def test_taking_it_again_draws_other_noise_of_the_same_light() -> None:
    first, second = raster(frame()), raster(frame(new_noise=1))
    assert not np.array_equal(first, second)
    assert np.array_equal(first, raster(frame()))


def test_another_patch_reuses_the_picture() -> None:
    cache = StageCache()
    frame(cache)
    assert {stage.status for stage in frame(cache, patch=3).stages} == {"reused"}


@pytest.mark.parametrize(
    ("moved", "computed"),
    [
        ({"exposure": -2}, ("light", "electrons", "codes", "transfer", "picture")),
        ({"dark": 100}, ("electrons", "codes", "transfer", "picture")),
        ({"read_noise": 3}, ("codes", "transfer", "picture")),
        ({"iso": "400"}, ("codes", "transfer", "picture")),
        ({"bits": 10}, ("codes", "transfer", "picture")),
        ({"patch": 2}, ()),
    ],
)
def test_chance_is_drawn_once_and_every_control_only_scales_it(
    moved: dict[str, object], computed: tuple[str, ...]
) -> None:
    cache = StageCache()
    frame(cache)
    statuses = {stage.name: stage.status for stage in frame(cache, "", **moved).stages}
    assert tuple(name for name, status in statuses.items() if status == "computed") == computed


@pytest.mark.parametrize("bits", [4, 12, 14])
def test_the_picture_is_the_codes_developed_and_encoded(bits: int) -> None:
    done = outputs(bits=bits)
    linear = develop(done["codes"], sensor_of(bits, "100", 0))
    expected = np.rint(255 * encode_srgb(np.clip(linear, 0, 1)))
    shown = done["picture"][..., 0].reshape(4, 40, 6, 40).swapaxes(1, 2).reshape(24, 1600)
    np.testing.assert_array_equal(shown, expected)


def estimates(tier: str, **given: object) -> list[Readout]:
    return list(SCENE.estimates(SCENE.check(given), tier, StageCache()))


def rounded_normal(mean: float, counts: NDArray[np.integer]) -> Floats:
    """P(N ≤ k) of a normal that is rounded and held at 0."""
    share: Floats = stats.norm.cdf((counts + 0.5 - mean) / np.sqrt(mean))
    return share


def test_the_tiers_are_all_models_of_the_sensor() -> None:
    assert SCENE.tiers == SHOT_MODELS


def test_more_light_adds_to_the_grain_that_is_there_and_does_not_reshuffle_it() -> None:
    """Half a stop: a new draw of the electrons would leave no correlation."""
    shown = {
        tier: [outputs(tier, exposure=ev)["electrons"][20] for ev in (-2, -1.5)]
        for tier in ("quantile", "poisson")
    }
    kept, drawn_anew = (np.corrcoef(*pair)[0, 1] for pair in shown.values())
    assert kept > 0.99
    assert abs(drawn_anew) < 0.5


@pytest.mark.parametrize("tier", ["quantile", "poisson"])
@pytest.mark.parametrize("exposure", [0, -3, -6])
def test_exact_electrons_are_as_far_from_poissons_law_as_chance_would_have_it(
    exposure: float, tier: str
) -> None:
    told = float(estimates(tier, exposure=exposure)[-1].text)
    assert told < 1.6 * largest_chance_gap(24, 1600 * EXPOSURES)


@pytest.mark.parametrize("exposure", [0, -3, -6])
def test_the_error_of_rounded_normals_is_the_gap_of_the_two_laws(exposure: float) -> None:
    """At the dim end the gap is known by formula; samples of 16 exposures scatter about it."""
    counts = np.arange(200)
    gap = max(
        np.abs(rounded_normal(mean, counts) - stats.poisson.cdf(counts, mean)).max()
        for mean in patch_means_e(exposure)[-10:]
    )
    told = float(estimates("gaussian", exposure=exposure)[-1].text)
    assert told == pytest.approx(gap, abs=largest_chance_gap(24, 1600 * EXPOSURES))


def test_the_lean_to_the_right_takes_most_of_the_error_away() -> None:
    plain, leaning = (float(estimates(t, exposure=-3)[-1].text) for t in ("gaussian", "skewed"))
    assert leaning < plain / 3


def test_the_first_estimate_is_of_the_very_electrons_that_are_shown() -> None:
    given = {"exposure": -4, "dark": 40}
    for tier in SHOT_MODELS:
        shown = outputs(tier, **given)["electrons"]
        gap = max(
            gap_from_poisson(counted, mean, FULL_WELL_E)
            for counted, mean in zip(shown, patch_means_e(-4) + 40, strict=True)
        )
        first, *more = estimates(tier, **given)
        assert first.text == f"{gap:.3f}"
        assert f"1 of {EXPOSURES} exposures" in first.label
        assert len(more) == EXPOSURES - 1


def test_a_rounded_normal_is_too_bright_where_it_may_not_be_negative() -> None:
    """The chapter's setting: 0.22 electrons in the darkest patch, and nothing but shot noise."""
    given = {"exposure": -6, "iso": "6400", "bits": 14, "read_noise": 0, "patch": 24}
    mean = patch_means_e(-6)[-1]
    held = np.sum(1 - rounded_normal(mean, np.arange(50)))
    assert held > 1.25 * mean
    gain = sensor_of(14, "6400", 0).gain_e_per_dn
    for tier, expected in (("gaussian", held), ("quantile", mean), ("poisson", mean)):
        shown = texts(tier, **given)
        scatter = 4 * math.sqrt(mean / 1600)
        assert float(shown["mean"]) * gain == pytest.approx(expected, abs=scatter)


def test_only_light_and_warmth_are_dragged_in_the_draft() -> None:
    """The other controls reuse the electrons that are there: a draft would draw them anew.

    Only whoever chose the exact sampler gets a draft, one whose grain stays while it is dragged.
    """
    assert SCENE.default_tier == SCENE.draft_tier == LADDER.default_tier
    cache = StageCache()
    frame(cache)
    for name in set(SCENE.drafted) ^ {"exposure", "dark", "bits", "iso", "read_noise", "patch"}:
        statuses = {s.name: s.status for s in frame(cache, "", **{name: MOVED[name]}).stages}
        assert statuses["electrons"] == "reused", name
    for name in SCENE.drafted:
        statuses = {s.name: s.status for s in frame(cache, "", **{name: MOVED[name]}).stages}
        assert statuses["electrons"] == "computed", name


MOVED = {"exposure": -2, "dark": 100, "bits": 10, "iso": "400", "read_noise": 3, "patch": 2}


def ramp() -> Photograph:
    """A picture with detail of its own in every patch: a slant ramp over fine stripes."""
    y, x = np.mgrid[:160, :240]
    levels = np.clip(20 + 0.4 * x + 0.3 * y + 25 * (x % 4 < 2), 0, 255).astype(np.uint8)
    rgba = np.stack([levels, levels, levels, np.full_like(levels, 255)], axis=-1)
    return Photograph.from_canvas(1, rgba.tobytes(), 240, 160)


def of_own(**given: object) -> tuple[Outputs, Frame]:
    settings, cache = SCENE.check(given), StageCache()
    done = SCENE.run(settings, "quantile", cache, ramp())
    return done.outputs, SCENE.render(settings, "quantile", cache, ramp())


def test_the_light_of_a_reader_s_picture_fills_the_well_where_it_is_white() -> None:
    done, _ = of_own(exposure=-1)
    codes = ramp().codes[..., 0] / 255
    linear = np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    tile = linear[40:80, 80:120].ravel()
    assert done["light"][8] == pytest.approx(FULL_WELL_E / 2 * tile, rel=1e-3)


@pytest.mark.parametrize("iso", ["100", "1600"])
def test_a_reader_s_picture_tells_the_gain_although_it_has_detail_of_its_own(iso: str) -> None:
    done, shown = of_own(exposure=-4 if iso == "1600" else 0, iso=iso)
    measured: Transfer = done["transfer"]
    assert measured.gain is not None
    truth = sensor_of(12, iso, 10).gain_e_per_dn
    assert abs(measured.gain.e_per_dn / truth - 1) < 0.15
    assert shown.description.startswith(f"Your own picture at ISO {iso}")
    assert "wedge" not in shown.description
    assert {place.name for place in shown.handles} == {"patch", "floor"}


def test_a_reader_s_picture_is_judged_by_even_patches_as_bright() -> None:
    told = list(SCENE.estimates(SCENE.check({}), "quantile", StageCache(), ramp()))
    assert len(told) == EXPOSURES
    assert float(told[-1].text) < 1.6 * largest_chance_gap(24, 1600 * EXPOSURES)


@pytest.mark.parametrize("patch", [1, 9, 24])
def test_the_enlarged_patch_is_as_bright_whatever_its_light(patch: int) -> None:
    enlarged = frame(iso="400", exposure=-2, patch=patch, read_noise=3).panels[1].raster
    assert enlarged is not None
    levels = enlarged[..., 0] / 255
    linear = np.where(levels <= 0.04045, levels / 12.92, ((levels + 0.055) / 1.055) ** 2.4)
    assert linear.mean() == pytest.approx(0.2, abs=0.02)


def test_a_floor_pulled_up_needs_the_read_noise_that_theory_has() -> None:
    given = {"iso": "400", "dark": 100}
    (handle,) = (each for each in SCENE.handles if each.name == "floor")
    place = handle.at(SCENE.check({**given, "read_noise": 37}), {})
    assert place is not None
    assert SCENE.pull(SCENE.check(given), "floor", place) == {"read_noise": 37}
