"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out.

What the text says of the measurements in words is held to them as well.
"""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.ladders import inverse_pincushion, shot_noise
from simulations.ladders.inverse_distortion import LADDER
from simulations.models import radial_profile
from simulations.models.distortion import undistort
from site_builder.diagnostics import Diagnostics
from site_builder.measurements import Measurements, read_measurements

CHAPTER = "10-speed-and-accuracy"


def the_slope_of_the_fixed_point_s_map() -> Says:
    """How much one step leaves of an error: r g'(r) / g(r), at its worst over the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(undistort(work.seen, work.lens)[0], -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def a_corner_of_the_pincushion() -> Says:
    work = inverse_pincushion.LADDER.prepare()
    lens = work.lens
    corner, _ = undistort([2.0, 0.0], lens)
    yield f"with $k_1 = {lens.k1:g}$ a corner which belongs at $r = {corner[0]:.2f}$ is drawn"
    assert np.isclose(np.hypot(*np.moveaxis(work.seen, -1, 0)).max(), 2.0, rtol=0.01)
    yield f"where $k_1r^2 = 1$, and the corner lies beyond, at {lens.k1 * corner[0] ** 2:.1f}"


def samples_of_a_box() -> Says:
    yield f"A box of 16 × 16 samples a pixel has {16**2} times the work"
    yield f"or about {16**2}?"


@cache
def measurements() -> Measurements:
    return read_measurements(CONTENT.parent, Diagnostics())


def error(ladder: str, tier: str, metric: str) -> float:
    value = measurements().find(ladder)[tier].errors[metric]
    return np.inf if value is None else value


def browser_ms(ladder: str, tier: str) -> float:
    return measurements().find(ladder)[tier].times["browser"].ms


def what_is_said_in_words_of_errors() -> Says:
    yield "worst`, many codes of 255."
    assert error("edge-coverage", "ramp", "worst") / 100 * 255 > 5
    yield "worst`, a fraction of one code"
    assert error("edge-coverage", "straight", "worst") / 100 * 255 < 1
    yield "bare` of white, more than a code"
    assert error("shading", "gouraud-64", "worst") * 255 > 1
    yield "a box of any size leaves about a third"
    point = error("anti-aliasing", "point", "alias")
    for box in ("box-4", "box-8", "area"):
        assert 0.3 < error("anti-aliasing", box, "alias") / point < 0.36
    yield "more than four times as many random ones do"
    assert error("depth-of-field", "fibonacci-16", "psnr") > error(
        "depth-of-field", "random-64", "psnr"
    )
    yield "Now the nearest pixel is ahead of bilinear"
    nearest, bilinear = (
        [error("resampling", tier, metric) for metric in ("psnr-once", "psnr-round")]
        for tier in ("nearest", "bilinear")
    )
    assert nearest[0] < bilinear[0]
    assert nearest[1] > bilinear[1]
    yield "Lanczos, at "
    once = [
        error("resampling", tier, "psnr-once")
        for tier in ("nearest", "bilinear", "bicubic", "spline", "lanczos3")
    ]
    assert once == sorted(once)
    assert once[3] > once[2] + 6
    yield "better from one electron on, and worse at a tenth of one"
    work, truth = shot_noise.prepare(), shot_noise.reference(shot_noise.prepare())
    gaps, biases = {}, {}
    for tier in shot_noise.LADDER.tiers:
        counted = tier.run(work)
        gaps[tier.id] = shot_noise.distances(counted, truth)
        biases[tier.id] = counted.mean(axis=1, dtype=float) / shot_noise.LEVELS_E - 1
    assert np.all(gaps["skewed"][2:6] < gaps["gaussian"][2:6] / 2)
    assert biases["skewed"][0] > 10 * abs(biases["gaussian"][0])
    yield "comes out up to {measured}`shot-noise gaussian bias` too high"
    assert np.argmax(np.abs(biases["gaussian"])) == np.argmax(biases["gaussian"]) < 2
    yield "At every mean its counts pass for exact ones"
    assert gaps["quantile"].max() < 1.63 / np.sqrt(shot_noise.SAMPLES)
    yield "Its error is rounding, far below half a code"
    assert error("block-dct", "separable", "worst") < 1e-9


def what_is_said_in_words_of_times() -> Says:
    yield "Its error vanishes in the rounding to bytes"
    assert error("srgb", "table", "worst") < 0.1
    assert browser_ms("srgb", "exact") > 1.1 * browser_ms("srgb", "table")
    yield "That buys every digit"
    assert error("precision", "relative-64", "far") < 1e-9
    assert browser_ms("precision", "relative-64") < 2 * browser_ms("precision", "relative-32")
    yield "half the digits would save too little time"
    assert browser_ms("vignetting", "algebraic") < 1.3 * browser_ms("vignetting", "algebraic-32")
    yield "every other tier that blurs at all takes longer"
    tiers = measurements().find("exposure-blur").tiers
    blurring = {item.tier.id for item in tiers} - {"instants-1", "integral"}
    for tier in blurring:
        assert browser_ms("exposure-blur", tier) > browser_ms("exposure-blur", "integral")


WORKED = (
    the_slope_of_the_fixed_point_s_map,
    a_corner_of_the_pincushion,
    samples_of_a_box,
    what_is_said_in_words_of_errors,
    what_is_said_in_words_of_times,
)
