"""Chapter 10: speed and accuracy. Its results are measured; a few are worked out.

What the text says of the measurements in words is held to them as well.
"""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.engine.ladder import pareto_front
from simulations.ladders import inverse_strong, shot_noise, wide_discs
from simulations.ladders.depth_of_field import ladder as depth_of_field
from simulations.ladders.depth_of_field.ladder import radius_px
from simulations.ladders.inverse_distortion import LADDER
from simulations.models.distortion import radial_profile, radial_table
from simulations.models.distortion.lens_model import largest_distorted_radius, undistort
from simulations.models.distortion.undistortion import undistort_newton
from simulations.models.geometry import rotations
from simulations.models.light.raycasting import Sphere
from simulations.models.sensor.demosaicing import psnr_db
from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes.camera import scene as camera
from simulations.scenes.camera.lens import PITCH_MM
from site_builder.diagnostics import Diagnostics
from site_builder.measured.measurements import Measurements, read_measurements

CHAPTER = "10-speed-and-accuracy"


def the_slope_of_the_fixed_point_s_map() -> Says:
    """How much one step leaves of an error: r g'(r) / g(r), at its worst over the workload."""
    work = LADDER.prepare()
    profile = work.lens.radial
    ideal = np.hypot(*np.moveaxis(undistort(work.seen, work.lens)[0], -1, 0))
    scale, slope = radial_profile.scale_and_slope(profile, ideal**2)
    worst = float(np.abs(2 * ideal**2 * slope / scale).max())
    yield f"which for this lens is {worst:.2f} at worst"


def the_places_of_a_checked_table() -> Says:
    work = LADDER.prepare()
    table = radial_table.inverse_table(work.lens.radial, 1.0)
    yield f"lays short polynomials through {table.coefficients.size} places"


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


def guesses_that_jump_back_and_forth() -> Says:
    work = inverse_strong.prepare()[inverse_strong.PINCUSHION]
    guess, guesses = 2.0, []
    for _ in range(40):
        guess = 2.0 / (1 + work.lens.k1 * guess**2)
        guesses.append(guess)
    assert np.allclose(guesses[-2:], guesses[-4:-2], rtol=1e-3)
    assert abs(guesses[-1] - guesses[-2]) > 1
    yield "until the guesses jump back and forth between two wrong places"


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


def metrics_of_pictures() -> Says:
    """PSNR is −20 lg of the RMS error as a share of the range."""
    picture = np.linspace(0.0, 0.5, 400).reshape(20, 20)
    for decibels, share, word in ((20, 0.1, "a tenth of it"), (40, 0.01, "a hundredth")):
        assert np.isclose(psnr_db(picture + share, picture), decibels)
        yield f"{decibels} dB is {word}" if decibels == 20 else f"{decibels} dB {word}"


def a_front_of_four() -> Says:
    """The four methods of the first question."""
    times, errors = (2.0, 3.0, 9.0, 12.0), (0.1, 0.1, 0.001, 0.002)
    front = pareto_front(list(zip(times, errors, strict=True)))
    told = [
        f"{name} takes {time:g} ms and errs by {error:g} px"
        for name, time, error in zip("ABCD", times, errors, strict=True)
    ]
    yield f"Method {', '.join(told)}."
    yield " and ".join(name for name, on in zip("ABCD", front, strict=True) if on) + ", for nothing"
    assert pareto_front([(1.0, 1.0), (1.0, 1.0)]) == (True, True)
    yield "at least as quick and at least as accurate, and better in one of the two"


def the_norm_of_a_rotation() -> Says:
    assert np.isclose(np.linalg.norm(rotations.exponential([0.3, -1.0, 0.2])), np.sqrt(3))
    yield r"which for any rotation matrix is $\sqrt{3}$"


def what_the_opening_says() -> Says:
    tiers = measurements().find("inverse-distortion").tiers
    assert len(tiers) >= 9
    yield "at least nine ways"
    times = {item.tier.id: item.times["browser"].ms for item in tiers}
    assert min(times, key=times.__getitem__) == "first-order"
    yield "The quickest puts a corner"
    assert error("inverse-distortion", "newton-bracketed", "worst") < 1e-9
    yield "The most careful is right to the last rounding"


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
    yield "more than even 64 random ones"
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
    assert exact < 33 / 10 / 1.5
    yield "less than a tenth of the 33 ms"
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


def how_round_the_outlines_of_the_book_are() -> Says:
    """The smallest ball, through the widest lens, focused at infinity."""
    balls = [(it.solid, thing_depth(it)) for it in THINGS if isinstance(it.solid, Sphere)]
    widest = camera.SCENE.clamp({"focal_length": 0}).focal_length
    focal_px = widest / PITCH_MM
    smallest = min(focal_px * ball.radius / depth for ball, depth in balls)
    yield f"curve with radii of {int(smallest)} pixels or more"


WORKED = (
    the_slope_of_the_fixed_point_s_map,
    the_places_of_a_checked_table,
    guesses_that_jump_back_and_forth,
    a_corner_of_the_pincushion,
    how_near_the_fold_the_barrel_is_seen,
    how_many_steps_of_newton_would_do,
    samples_of_a_box,
    metrics_of_pictures,
    a_front_of_four,
    the_norm_of_a_rotation,
    what_the_opening_says,
    what_is_said_in_words_of_errors,
    what_is_said_in_words_of_demosaicing,
    what_is_said_in_words_of_filling_in_colour,
    what_is_said_in_words_of_times,
    what_is_said_of_wide_discs,
    how_round_the_outlines_of_the_book_are,
)
