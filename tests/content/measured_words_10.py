"""What chapter 10 says of its measurements in words, held to what was measured."""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.ladders import shot_noise, wide_discs
from simulations.ladders.depth_of_field import ladder as depth_of_field
from simulations.ladders.depth_of_field.ladder import radius_px
from site_builder.diagnostics import Diagnostics
from site_builder.measured.measurements import Measurements, read_measurements


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


def what_is_said_in_words_of_errors() -> Says:
    yield "worst`, less than one code of 255; the ramp is off by up to"
    assert error("edge-coverage", "straight", "worst") / 100 * 255 < 0.9
    yield "worst-small` at worst, which is more than four codes"
    assert error("edge-coverage", "straight", "worst-small") / 100 * 255 > 4.3
    yield "Now the box of 16 × 16 is the better one"
    assert error("edge-coverage", "box-16", "rms-small") < 0.6 * error(
        "edge-coverage", "straight", "rms-small"
    )
    yield "bare` of white, more than a code"
    assert error("shading", "gouraud-64", "worst") * 255 > 1
    yield "a box leaves a third or a little more, however many samples it takes"
    point = error("anti-aliasing", "point", "alias")
    for box in ("box-2", "box-4", "box-8", "area"):
        assert 0.32 < error("anti-aliasing", box, "alias") / point < 0.42
    yield "64 samples a pixel buy next to nothing over 16 here"
    box_4, box_8, area = (error("anti-aliasing", t, "alias") for t in ("box-4", "box-8", "area"))
    assert 1 < box_4 / box_8 < 1.05
    yield "has the same false rings as the box"
    assert 1 < box_8 / area < 1.02
    yield "the error falls roughly as $1/n$"
    one = error("exposure-blur", "instants-1", "rms")
    for count in (4, 16, 64):
        assert 1 < count * error("exposure-blur", f"instants-{count}", "rms") / one < 2
    yield "with a fifth only rounding is left"
    assert error("inverse-distortion", "newton-5", "worst") < 1e-11
    yield "To start from the radial solution is worth more than one step and less than two"
    better, worse = (error("inverse-decentring", f"plane-{n}", "rms") for n in (4, 3))
    assert 10 * better < error("inverse-decentring", "radial-plane-2", "rms") < worse / 10
    yield "and that is also what it costs"
    quicker, slower = (browser_ms("inverse-decentring", f"plane-{n}") for n in (3, 4))
    assert quicker < browser_ms("inverse-decentring", "radial-plane-2") < slower
    yield "It is the cheapest that leaves nothing but rounding"
    assert error("inverse-decentring", "plane-4", "worst") < 1e-11
    for cheaper in ("plane-3", "radial-plane-2", "fixed-point-20"):
        assert error("inverse-decentring", cheaper, "worst") > 1e-10
    yield "the usual refinement, trusts those points most that deserve it least"
    wall = {t: error("homography-estimation", t, "wall") for t in ("one-sided", "normalised")}
    assert wall["one-sided"] > 1.1 * wall["normalised"]
    assert wall["normalised"] > 1.05 * error("homography-estimation", "two-sided", "wall")
    yield "an error below half a code of 255"
    assert 10 ** (-error("resampling", "spline", "psnr-once") / 20) * 255 < 0.5
    yield "and is better only on the picture that is made of waves alone"
    spline, lanczos = (error("resampling", tier, "psnr-once") for tier in ("spline", "lanczos3"))
    assert spline > lanczos
    yield "nearly all of it in place"
    bilinear = {which: error("resampling", "bilinear", which) for which in ("present", "in-place")}
    assert bilinear["in-place"] > 0.8 * bilinear["present"]
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


def what_is_said_in_words_of_demosaicing() -> Says:
    def better(one: str, other: str, metric: str, margin_db: float) -> bool:
        return error("demosaicing", one, metric) > error("demosaicing", other, metric) + margin_db

    default = "menon-unrefined"
    yield "the best or close to the best of the methods that work on light itself"
    for other in ("nearest", "bilinear", "malvar", "menon"):
        assert better(default, other, "psnr-room", -0.3)
        assert better(default, other, "light", 0.3)
    yield "So the default does well in one chart and badly in the other"
    assert better(default, "malvar", "psnr-room", 6)
    assert better("bilinear", default, "psnr-soft", 6)
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
    shortened, exact = (browser_ms("small-rotations", tier) for tier in ("second-order", "exact"))
    assert exact > 1.2 * shortened
    yield "Leaving the sines out still saves something"
    yield "Its error vanishes in the rounding to bytes"
    assert error("srgb", "table", "worst") < 0.1
    assert browser_ms("srgb", "exact") > 1.1 * browser_ms("srgb", "table")
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
    yield "That buys every digit"
    assert error("precision", "relative-64", "far") < 1e-9
    assert browser_ms("precision", "relative-64") < 2 * browser_ms("precision", "relative-32")
    yield "single precision would save too little time to be worth a second number format"
    assert browser_ms("block-dct", "separable") < 1.3 * browser_ms("block-dct", "separable-32")
    yield "but not in light, which the steps that follow in a camera need, and it takes"
    tiers = ("menon-encoded", "menon-unrefined")
    assert browser_ms("demosaicing", tiers[0]) > 1.5 * browser_ms("demosaicing", tiers[1])
    yield "Here they are the least accurate and not the quickest"
    assert browser_ms("block-dct", "fixed-point") > 1.3 * browser_ms("block-dct", "separable")
    worst = {item.tier.id: item.errors["worst"] for item in measurements().find("block-dct").tiers}
    assert max(worst, key=lambda tier: worst[tier] or 0.0) == "fixed-point"
    yield "half the digits would save too little time"
    assert browser_ms("vignetting", "algebraic") < 1.3 * browser_ms("vignetting", "algebraic-32")
    yield "For shot noise, motion blur and the inverse of a lens the true answer costs a small"
    for ladder, true, wrong in (
        ("shot-noise", "quantile", "gaussian"),
        ("exposure-blur", "integral", "instants-4"),
        ("inverse-distortion", "newton-5", "fixed-point-5"),
    ):
        assert browser_ms(ladder, true) < 4 * browser_ms(ladder, wrong)
    yield "It leaves only rounding, and sixteen instants, which leave"
    for side in ("native", "browser"):
        assert ms("exposure-blur", "instants-16", side) > 1.4 * ms(
            "exposure-blur", "integral", side
        )


def what_is_said_of_wide_discs() -> Says:
    near, wall = (2 * float(radius_px(wide_discs.prepare(), z)) for z in (1.6, 8.0))
    assert near > wall
    narrow = 2 * float(radius_px(depth_of_field.prepare(), 1.6))
    assert round(narrow) == 8
    yield "Discs eight pixels wide flatter layers"
    yield f"until they are {near:.0f} pixels wide"
    yield f"Such a disc covers {round(np.pi * near**2 / 4, -2):.0f} pixels"
    assert round(near / narrow) == 6
    yield "With discs six times as wide"
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
    yield "and the filters stay behind them"
    filters = [error("wide-discs", tier, "psnr") for tier in ("discs", "binned", "gather")]
    assert max(filters) < error("wide-discs", "layered", "psnr") - 3
    yield "comes as near the truth"
    drawn = [error("wide-discs", f"layered{how}", "psnr") for how in ("", "-taps", "-pyramid")]
    assert max(drawn) - min(drawn) < 0.1
    yield "How a disc is drawn hardly matters to the error"


SAID = (
    what_is_said_in_words_of_errors,
    what_is_said_in_words_of_demosaicing,
    what_is_said_in_words_of_filling_in_colour,
    what_is_said_in_words_of_times,
    what_is_said_of_wide_discs,
)
