"""What chapter 10 says of its measurements in words, held to what was measured."""

from functools import cache

import numpy as np
from support.worked_numbers import CONTENT, Says

from simulations.engine.stages import StageCache
from simulations.ladders import depth_of_field, shot_noise, wide_discs
from simulations.ladders.depth_of_field import radius_px
from simulations.ladders.inverse_distortion import prepare, reference, worst_px
from simulations.models.distortion.undistortion import undistort_newton
from simulations.registry import load_scene
from site_builder.benchmarks.measurements import Measurements, read_measurements
from site_builder.diagnostics.diagnostic import Diagnostics

CHAPTER = "10-speed-and-accuracy"
HALF_A_CODE = 0.5


@cache
def measurements() -> Measurements:
    return read_measurements(CONTENT.parent, Diagnostics())


def error(ladder: str, tier: str, metric: str) -> float:
    value = measurements().find(ladder)[tier].errors[metric]
    return np.inf if value is None else value


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


def two_steps_of_newton_are_enough_for_a_drawing() -> Says:
    mild = prepare()
    assert worst_px(undistort_newton(mild.seen, mild.lens, 2), reference(mild), mild) < 0.01
    yield "For a drawing two would do"


def counts_of_photons() -> Says:
    yield "comes out up to {measured}`shot-noise gaussian bias` too high"
    work, truth = shot_noise.prepare(), shot_noise.reference(shot_noise.prepare())
    gaussian, quantile = (
        shot_noise.LADDER.tier(tier).run(work) for tier in ("gaussian", "quantile")
    )
    bias = gaussian.mean(axis=1, dtype=float) / shot_noise.LEVELS_E - 1
    assert np.argmax(np.abs(bias)) == np.argmax(bias) < 2
    yield "Its counts pass for exact ones at every mean"
    gaps = shot_noise.distances(quantile, truth)
    assert gaps.max() < 1.63 / np.sqrt(shot_noise.SAMPLES)


def nine_wavelengths_of_the_figure() -> Says:
    yield "In RMS the picture of the figure would allow 9 wavelengths"
    figure = load_scene("lens-aberrations")
    for glass in ("crown", "flint"):
        *_, last = figure.estimates(figure.check({"glass": glass}), "even-9", StageCache())
        assert float(last.text) < HALF_A_CODE
