"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out.

What the text says of the measurements in words is held to them as well.
"""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.ladders import inverse_strong
from simulations.ladders.inverse_distortion import LADDER
from simulations.models import radial_profile
from simulations.models.distortion import largest_distorted_radius, undistort
from simulations.models.undistortion import undistort_newton
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
    work = inverse_strong.prepare()[inverse_strong.PINCUSHION]
    lens = work.lens
    corner, _ = undistort([2.0, 0.0], lens)
    yield f"with $k_1 = {lens.k1:g}$ a corner which belongs at $r = {corner[0]:.2f}$ is drawn"
    assert np.isclose(np.hypot(*np.moveaxis(work.seen, -1, 0)).max(), 2.0, rtol=0.01)
    there = lens.k1 * corner[0] ** 2
    yield f"where $k_1r^2 = 1$, and the pincushion's corner lies beyond, at {there:.1f}"


def how_near_the_fold_the_barrel_is_seen() -> Says:
    work = inverse_strong.prepare()[inverse_strong.BARREL]
    share = np.hypot(*work.seen.T).max() / largest_distorted_radius(work.lens)
    yield f"to {100 * share:.1f} % of the largest distorted radius there is"


def how_many_steps_of_newton_would_do() -> Says:
    work = inverse_strong.prepare()
    truth = inverse_strong.reference(work)
    wrong = [
        max(
            inverse_strong.worst_px(
                tuple(undistort_newton(each.seen, each.lens, steps) for each in work),
                truth,
                work,
                part=part,
            )
            for part in (inverse_strong.PINCUSHION, inverse_strong.BARREL)
        )
        for steps in (7, 8)
    ]
    assert wrong[1] < 1e-11 < wrong[0]
    yield "Eight steps of Newton would have been enough for both lenses"


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
    yield "with a fifth only rounding is left"
    assert error("inverse-distortion", "newton-5", "worst") < 1e-11
    yield "To start from the radial solution helps less than one more step does"
    assert error("inverse-decentring", "radial-plane-2", "rms") > 100 * error(
        "inverse-decentring", "plane-4", "rms"
    )
    yield "It is the cheapest that leaves nothing but rounding"
    assert error("inverse-decentring", "plane-4", "worst") < 1e-11
    for cheaper in ("plane-3", "radial-plane-2", "fixed-point-20"):
        assert error("inverse-decentring", cheaper, "worst") > 1e-10
    yield "the usual refinement, trusts those points most that deserve it least"
    wall = {t: error("homography-estimation", t, "wall") for t in ("one-sided", "normalised")}
    assert wall["one-sided"] > 1.1 * wall["normalised"]
    assert wall["normalised"] > 1.05 * error("homography-estimation", "two-sided", "wall")
    yield "Its error is rounding, far below half a code"
    assert error("block-dct", "separable", "worst") < 1e-9


def what_is_said_in_words_of_times() -> Says:
    yield "Its error vanishes in the rounding to bytes"
    assert error("srgb", "table", "worst") < 0.1
    assert browser_ms("srgb", "exact") > 1.1 * browser_ms("srgb", "table")
    yield "the longer format costs nothing that can be measured in the browser"
    assert browser_ms("precision", "relative-64") < 1.15 * browser_ms("precision", "relative-32")
    yield "*Four points* throws 36 matches away and saves little by it"
    four, all_forty = (
        browser_ms("homography-estimation", tier) for tier in ("four-points", "normalised")
    )
    assert four > 0.5 * all_forty
    yield "What the table buys is not time. Eight steps of Newton would"
    a_step = 0.5 * (
        browser_ms("inverse-strong", "newton-5") - browser_ms("inverse-strong", "newton-3")
    )
    eight = browser_ms("inverse-strong", "newton-5") + 3 * a_step
    assert eight < 1.25 * browser_ms("inverse-strong", "checked-table")
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
    how_near_the_fold_the_barrel_is_seen,
    how_many_steps_of_newton_would_do,
    samples_of_a_box,
    what_is_said_in_words_of_errors,
    what_is_said_in_words_of_times,
)
