"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out.

What the text says of the measurements in words is held to them as well.
"""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.ladders import inverse_pincushion
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
    yield "Its error is rounding, far below half a code"
    assert error("block-dct", "separable", "worst") < 1e-9


def what_is_said_in_words_of_demosaicing() -> Says:
    def better(one: str, other: str, metric: str, margin_db: float) -> bool:
        return error("demosaicing", one, metric) > error("demosaicing", other, metric) + margin_db

    default = "menon-unrefined"
    yield "the best or close to the best of the methods that work on light itself"
    for other in ("nearest", "bilinear", "malvar", "menon"):
        assert better(default, other, "psnr-room", -0.3)
        assert better(default, other, "light", 0.3)
    yield "and loses on the balloon"
    assert better(default, "menon", "psnr-balloon", 0.3)
    yield "The last tier is better on a screen, but not in light"
    assert better("menon-encoded", default, "psnr-room", 1.5)
    assert better("menon-encoded", default, "psnr-balloon", 1.0)
    assert better(default, "menon-encoded", "light", 1.0)
    yield "plain bilinear interpolation wins with"
    for other in ("nearest", "malvar", default, "menon", "menon-encoded"):
        assert better("bilinear", other, "psnr-soft", 4)
    yield "There Malvar's method is ahead of bilinear interpolation"
    assert better("malvar", "bilinear", "light", 2)
    yield "On the screen it is not"
    assert better("bilinear", "malvar", "psnr-balloon", 0.3)


def what_is_said_in_words_of_filling_in_colour() -> Says:
    def ranking(metric: str) -> list[str]:
        tiers = ("repeated", "triangle", "parabola", "cubic", "guided")
        return sorted(tiers, key=lambda tier: error("chroma-upsampling", tier, metric))

    yield "The triangle has fallen from second place to fourth"
    assert ranking("room")[:2] == ["guided", "triangle"]
    assert ranking("room-means").index("triangle") == 3
    yield "it is the best in the room and close to the best on the balloon"
    balloon = {tier: error("chroma-upsampling", tier, "balloon") for tier in ranking("balloon")}
    best_of_colour = min(value for tier, value in balloon.items() if tier != "guided")
    assert balloon["triangle"] < 1.05 * best_of_colour
    yield "Following luma improves little on it in a file of this quality"
    file, means = (
        [error("chroma-upsampling", tier, metric) for tier in ("guided", "triangle")]
        for metric in ("room", "room-means")
    )
    assert 0.95 < file[0] / file[1] < 1
    assert means[0] / means[1] < 0.7


def what_is_said_in_words_of_times() -> Says:
    yield "Its error vanishes in the rounding to bytes"
    assert error("srgb", "table", "worst") < 0.1
    assert browser_ms("srgb", "exact") > 1.1 * browser_ms("srgb", "table")
    yield "single precision would save too little time to be worth a second number format"
    assert browser_ms("block-dct", "separable") < 1.3 * browser_ms("block-dct", "separable-32")
    yield "but not in light, which the steps that follow in a camera need, and it takes"
    tiers = ("menon-encoded", "menon-unrefined")
    assert browser_ms("demosaicing", tiers[0]) > 1.5 * browser_ms("demosaicing", tiers[1])
    yield "Here they are the least accurate and not the quickest"
    assert browser_ms("block-dct", "fixed-point") > 1.3 * browser_ms("block-dct", "separable")
    worst = {item.tier.id: item.errors["worst"] for item in measurements().find("block-dct").tiers}
    assert max(worst, key=lambda tier: worst[tier] or 0.0) == "fixed-point"
    yield "the longer format costs nothing that can be measured in the browser"
    assert browser_ms("precision", "relative-64") < 1.15 * browser_ms("precision", "relative-32")
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
    what_is_said_in_words_of_demosaicing,
    what_is_said_in_words_of_filling_in_colour,
    what_is_said_in_words_of_times,
)
