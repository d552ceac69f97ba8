"""What chapter 10 says of its measurements in words, held to what was measured."""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.engine.stages import StageCache
from simulations.ladders import shot_noise, wide_discs
from simulations.ladders.depth_of_field import ladder as depth_of_field
from simulations.ladders.depth_of_field.ladder import radius_px
from simulations.ladders.inverse_distortion import prepare, reference, worst_px
from simulations.models.distortion.undistortion import undistort_newton
from simulations.registry import load_scene
from site_builder.benchmarks.measurements import MeasuredTier, Measurements, read_measurements
from site_builder.diagnostics import Diagnostics

HALF_A_CODE = 0.5


@cache
def measurements() -> Measurements:
    return read_measurements(CONTENT.parent, Diagnostics())


def error(ladder: str, tier: str, metric: str) -> float:
    value = measurements().find(ladder)[tier].errors[metric]
    return np.inf if value is None else value


def ms(ladder: str, tier: str, side: str) -> float:
    return measurements().find(ladder)[tier].times[side].ms


def browser_ms(ladder: str, tier: str) -> float:
    return ms(ladder, tier, "browser")


def about(value: float, said: float) -> bool:
    """Times scatter: within four tenths."""
    return 0.6 * said < value < 1.4 * said


def codes_rms(psnr: float) -> float:
    return 255 * 10 ** (-psnr / 20)


def what_a_step_buys() -> Says:
    yield "the checked table: it costs less than twice as much"
    assert browser_ms("inverse-distortion", "checked-table") < 2 * browser_ms(
        "inverse-distortion", "newton-4"
    )
    yield "After 20 steps the first is still less accurate than the second after 4"
    twenty, after = (error("inverse-distortion", t, "rms") for t in ("fixed-point-20", "newton-4"))
    assert after < twenty < 1e-8
    yield "It is right to rounding"
    yield "For a drawing two would do"
    assert error("inverse-distortion", "newton-4", "worst") < 1e-11
    mild = prepare()
    two = undistort_newton(mild.seen, mild.lens, 2)
    assert worst_px(two, reference(mild), mild) < 0.01
    yield "For the drawing alone the lookup table would do"
    for metric in ("pincushion", "fold"):
        assert error("inverse-strong", "lookup-table", metric) < 0.01
    yield "This one is the cheapest of them"
    closed_form = browser_ms("inverse-strong", "closed-form")
    assert closed_form < browser_ms("inverse-strong", "checked-table")
    assert closed_form < browser_ms("inverse-strong", "newton-bracketed")


def what_an_area_costs() -> Says:
    yield "its error is below half a code in RMS, and the ramp's is not"
    straight, ramp = (2.55 * error("edge-coverage", t, "rms") for t in ("straight", "ramp"))
    assert straight < HALF_A_CODE < ramp
    yield "and the box is better, with"
    assert error("edge-coverage", "box-16", "rms-small") < 0.6 * error(
        "edge-coverage", "straight", "rms-small"
    )
    # The error goes as 1/R: half a code is passed at twice the small disc's radius or so.
    yield "as long as nothing is smaller than a dozen pixels"
    assert 2.55 * error("edge-coverage", "straight", "rms-small") * 5 / 6 > HALF_A_CODE
    assert 2.55 * error("edge-coverage", "straight", "rms-small") * 5 / 12 < 2 * HALF_A_CODE


def what_samples_cost() -> Says:
    yield "Only four instants or fewer are quicker"
    assert browser_ms("exposure-blur", "instants-4") < browser_ms("exposure-blur", "integral")
    assert browser_ms("exposure-blur", "instants-16") > browser_ms("exposure-blur", "integral")
    yield "No tier here is below half a code: 64 rays are the nearest"
    tiers = {item.tier.id: codes_rms(item.errors["psnr"] or 0) for item in _depth_of_field()}
    assert HALF_A_CODE < min(tiers.values()) == tiers["fibonacci-64"] < 1
    yield "The filters are all within two decibels of one another"
    filters = [error("depth-of-field", tier, "psnr") for tier in ("discs", "binned", "gather")]
    assert max(filters) - min(filters) < 2
    yield "a small picture thirty times a second, a large one not"
    pixels = 1e3 / 30 * 160 * 120 / browser_ms("wide-discs", "layered")
    assert 160 * 120 < pixels < 320 * 240
    yield "It is the best of the filters. Sixteen rays are nearer the truth"
    best = error("depth-of-field", "layered", "psnr")
    assert max(filters) < best < error("depth-of-field", "fibonacci-16", "psnr")


def _depth_of_field() -> tuple[MeasuredTier, ...]:
    return measurements().find("depth-of-field").tiers


def what_is_said_of_wide_discs() -> Says:
    near, wall = (2 * float(radius_px(wide_discs.prepare(), z)) for z in (1.6, 8.0))
    assert near > wall
    narrow = 2 * float(radius_px(depth_of_field.prepare(), 1.6))
    yield f"until they are {near:.0f} pixels wide"
    yield f"Such a disc covers {round(np.pi * near**2 / 4, -2):.0f} pixels"
    assert round(near / narrow) == 6
    wide, before = wide_discs.prepare(), depth_of_field.prepare()
    assert round(wide.lens_radius / before.lens_radius) == 3
    assert wide.seen.shape == (2 * before.seen.shape[0], 2 * before.seen.shape[1])
    yield "a lens three times as wide, on twice as many pixels each way"
    lost = {
        tier: error("depth-of-field", tier, "psnr") - error("wide-discs", tier, "psnr")
        for tier in ("fibonacci-16", "layered", "discs", "binned", "gather")
    }
    yield "Sixteen rays fall most"
    assert lost.pop("fibonacci-16") > 3 + max(lost.values())
    yield "comes as near the truth"
    drawn = [error("wide-discs", f"layered{how}", "psnr") for how in ("", "-taps", "-pyramid")]
    assert max(drawn) - min(drawn) < 0.1


def what_is_said_of_resampling() -> Says:
    yield "an error below half a code of 255"
    assert codes_rms(error("resampling", "spline", "psnr-once")) < HALF_A_CODE
    yield "and is better only on the picture that is made of waves alone"
    spline, lanczos = (error("resampling", tier, "psnr-once") for tier in ("spline", "lanczos3"))
    assert spline > lanczos
    yield "nearly all of it in place"
    bilinear = {which: error("resampling", "bilinear", which) for which in ("present", "in-place")}
    assert bilinear["in-place"] > 0.8 * bilinear["present"]


def what_is_said_in_words_of_demosaicing() -> Says:
    def better(one: str, other: str, metric: str, margin_db: float) -> bool:
        return error("demosaicing", one, metric) > error("demosaicing", other, metric) + margin_db

    default = "menon-unrefined"
    yield "Of the methods that work on light itself it is the best or close to the best"
    for other in ("nearest", "bilinear", "malvar", "menon"):
        assert better(default, other, "psnr-room", -0.3)
        assert better(default, other, "light", 0.3)
    yield "better on a screen, worse in light"
    assert better("menon-encoded", default, "psnr-room", 1.5)
    assert better("menon-encoded", default, "psnr-balloon", 1.0)
    assert better(default, "menon-encoded", "light", 1.0)
    yield "bilinear interpolation wins with"
    for other in ("nearest", "malvar", default, "menon", "menon-encoded"):
        assert better("bilinear", other, "psnr-soft", 4)


def what_is_said_of_formats() -> Says:
    yield "In single precision it would do as well and cost the same"
    assert error("precision", "relative-32", "far") < 1e-4
    assert about(
        browser_ms("precision", "relative-32") / browser_ms("precision", "relative-64"), 1.0
    )
    yield "It costs nothing: one subtraction in another place"
    assert browser_ms("precision", "relative-64") < 1.2 * browser_ms("precision", "float64")


def what_is_said_of_the_other_ladders() -> Says:
    yield "comes out up to {measured}`shot-noise gaussian bias` too high"
    work, truth = shot_noise.prepare(), shot_noise.reference(shot_noise.prepare())
    counted = {
        tier.id: tier.run(work)
        for tier in shot_noise.LADDER.tiers
        if tier.id in ("gaussian", "quantile")
    }
    bias = counted["gaussian"].mean(axis=1, dtype=float) / shot_noise.LEVELS_E - 1
    assert np.argmax(np.abs(bias)) == np.argmax(bias) < 2
    yield "Its counts pass for exact ones at every mean"
    gaps = shot_noise.distances(counted["quantile"], truth)
    assert gaps.max() < 1.63 / np.sqrt(shot_noise.SAMPLES)
    yield "In RMS the finest grid would do. But it misses the peak of a highlight by more than"
    assert 255 * error("shading", "gouraud-64", "rms") < HALF_A_CODE
    assert 255 * error("shading", "gouraud-64", "worst") > 1
    yield "In RMS the picture of the figure would allow 9 wavelengths"
    figure = load_scene("lens-aberrations")
    for glass in ("crown", "flint"):
        *_, last = figure.estimates(figure.check({"glass": glass}), "even-9", StageCache())
        assert float(last.text) < HALF_A_CODE
    yield "A drawing needs no more than the paced line"
    assert error("rotation-interpolation", "paced-nlerp", "worst") < 0.05
    yield "Nothing is quicker in the browser, and its error is rounding"
    times = {it.tier.id: it.times["browser"].ms for it in measurements().find("block-dct").tiers}
    assert min(times, key=times.__getitem__) == "separable"
    assert error("block-dct", "separable", "worst") < 1e-9
    yield "the true answer costs a small multiple of the wrong one"
    for ladder, true, wrong in (
        ("shot-noise", "quantile", "gaussian"),
        ("exposure-blur", "integral", "instants-4"),
        ("inverse-distortion", "newton-4", "fixed-point-5"),
    ):
        assert browser_ms(ladder, true) < 4 * browser_ms(ladder, wrong)


SAID = (
    what_a_step_buys,
    what_an_area_costs,
    what_samples_cost,
    what_is_said_of_wide_discs,
    what_is_said_of_resampling,
    what_is_said_in_words_of_demosaicing,
    what_is_said_of_formats,
    what_is_said_of_the_other_ladders,
)
