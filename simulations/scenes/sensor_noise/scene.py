"""A step wedge photographed by a noisy sensor, and what its noise gives away about the sensor.

Twenty-four patches, each half a stop darker than the one before, are counted, read and rounded.
The variance of each patch against its mean is the photon-transfer curve; the slope of its middle
part measures the gain without opening the camera.
"""

import itertools
import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.controls import Action, Choice, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Run, StageCache, run
from simulations.models.sensor import photon_counting
from simulations.models.sensor.photon_transfer import Gain
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.scenes.sensor_noise import drawing
from simulations.scenes.sensor_noise.stages import (
    FULL_WELL_E,
    STAGES,
    Floats,
    Transfer,
    count_patches,
    floor_e2,
    patch_means_e,
    saturation_e,
    sensor_of,
)

DEFAULT_TIER = "quantile"
EXPOSURES = 16
"""Exposures of the patches by which a tier is judged."""

CONTROLS = (
    Slider(
        name="exposure", label="Exposure", default=0, minimum=-6, maximum=0, step=0.5, unit="EV"
    ),
    Choice(
        name="iso",
        label="ISO",
        default="100",
        options={str(iso): str(iso) for iso in (100, 200, 400, 800, 1600, 3200, 6400)},
    ),
    Slider(
        name="read_noise",
        label="Read noise",
        default=10,
        minimum=0,
        maximum=60,
        step=1,
        unit="e⁻",
    ),
    Slider(
        name="dark", label="Dark signal", default=0, minimum=0, maximum=2000, step=20, unit="e⁻"
    ),
    Slider(name="bits", label="Converter", default=12, minimum=4, maximum=14, step=1, unit="bits"),
    Slider(name="patch", label="Patch", default=9, minimum=1, maximum=24, step=1),
    Action(name="new_noise", labels=("Take it again",) * 8),
)


def run_tier(values: Values, tier: str, cache: StageCache) -> Run:
    """All stages; the tier is the distribution that electrons are drawn from."""
    return run(STAGES, values, cache, {"tier": tier or DEFAULT_TIER})


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The wedge, and the variance of each of its patches against its mean."""
    done = run_tier(values, tier, cache)
    transfer: Transfer = done.outputs["transfer"]
    dark, patch = values.number("dark"), int(values.number("patch")) - 1
    camera = sensor_of(
        int(values.number("bits")), values.choice("iso"), values.number("read_noise")
    )
    means_e = patch_means_e(values.number("exposure"))
    gain = camera.gain_e_per_dn
    curve = drawing.Curve(
        gain_e_per_dn=gain,
        floor_dn2=floor_e2(camera, dark) / gain**2,
        full_dn=saturation_e(camera) / gain,
        dark_dn=dark / gain,
    )
    panels = (
        Panel(
            "wedge",
            "24 patches, and the mean electrons in each",
            drawing.WIDTH,
            drawing.HEIGHT,
            done.outputs["picture"],
            drawing.over_wedge(means_e, patch),
            pixelated=True,
        ),
        Panel(
            "transfer",
            "Photon transfer",
            drawing.WIDTH,
            drawing.HEIGHT,
            overlay=drawing.transfer_plot(
                curve, transfer.mean_dn, transfer.variance_dn, transfer.fitted, patch
            ),
        ),
    )
    span = math.log2(saturation_e(camera) / math.sqrt(floor_e2(camera, dark)))
    theory = float(means_e[patch]) / math.sqrt(float(means_e[patch]) + floor_e2(camera, dark))
    sigma = math.sqrt(transfer.variance_dn[patch])
    measured = measured_ratio(transfer, patch)
    expected = "clipped" if transfer.clipped[patch] else format_number(theory, 1)
    readouts = (
        readout("mean", "Patch mean", transfer.mean_dn[patch], "DN", digits=1, role="image"),
        readout("sigma", "Patch σ", sigma, "DN", digits=2, role="image"),
        Readout("snr", "SNR, measured", measured, role="image"),
        Readout("theory", "SNR, theory", expected, role="ray"),
        Readout("gain", "Gain, measured", measured_gain(transfer.gain), "e⁻/DN", "image"),
        readout("truth", "Gain, true", gain, "e⁻/DN", digits=3, role="light"),
        readout("range", "Dynamic range", span, "stops", digits=1),
    )
    return Frame(panels, readouts, describe(values, transfer, camera, measured), done.reports)


def measured_ratio(transfer: Transfer, patch: int) -> str:
    """Signal to noise of a patch, or why it has none to tell."""
    sigma = math.sqrt(transfer.variance_dn[patch])
    if sigma == 0:
        return "one code only"
    if transfer.clipped[patch]:  # part of the noise is cut off, and the ratio would flatter
        return "clipped"
    return format_number(transfer.mean_dn[patch] / sigma, 1)


def measured_gain(gain: Gain | None) -> str:
    """With its standard error, of which two digits count."""
    if gain is None:
        return "not to be told"
    digits = min(max(1 - math.floor(math.log10(gain.error_e_per_dn)), 0), 5)
    shown, error_shown = (
        format_number(part, digits) for part in (gain.e_per_dn, gain.error_e_per_dn)
    )
    return f"{shown} ± {error_shown}"


def error(values: Values, tier: str, cache: StageCache) -> Iterator[Readout]:
    """How far the electrons of the patches are from Poisson's distribution.

    1600 pixels of a patch cannot tell much of a distribution: with each step another exposure
    of the same patches is added to those before.
    """
    model = next(name for name in photon_counting.SHOT_MODELS if name == (tier or DEFAULT_TIER))
    mean_e = patch_means_e(values.number("exposure")) + values.number("dark")
    counted: Floats = run_tier(values, model, cache).outputs["electrons"]
    rng = np.random.default_rng((values.state("new_noise"), 3))
    for exposures in range(1, EXPOSURES + 1):
        if exposures > 1:
            counted = np.concatenate((counted, count_patches(mean_e, rng, model)), axis=1)
        gap = max(map(gap_from_poisson, counted, mean_e, itertools.repeat(FULL_WELL_E)))
        chance = largest_chance_gap(*counted.shape)
        label = (
            f"Largest gap to Poisson’s cumulative, {exposures} of {EXPOSURES} exposures "
            f"(chance: {format_number(chance, 3)})"
        )
        yield Readout("error", label, format_number(gap, 3), "probability", "error")


def describe(
    values: Values, transfer: Transfer, camera: photon_counting.Sensor, measured: str
) -> str:
    """The picture in one sentence."""
    light_e = patch_means_e(values.number("exposure")) + values.number("dark")
    full = int(np.count_nonzero(light_e > saturation_e(camera)))
    burnt = f"{full} of 24 patches are burnt out" if full else "no patch is burnt out"
    words = {"one code only": "shows one code only", "clipped": "is clipped"}
    shown = words.get(measured, f"has an SNR of {measured}")
    floor_dn = math.sqrt(floor_e2(camera, values.number("dark"))) / camera.gain_e_per_dn
    if transfer.gain is None:
        fit = "too few patches with noise of their own are left to measure the gain"
    elif floor_dn < 0.5:
        fit = "the dark patches vary by less than a code and fall into flat steps"
    else:
        off = abs(transfer.gain.e_per_dn / camera.gain_e_per_dn - 1)
        fit = f"the variances give the gain to within {math.ceil(100 * off)} %"
    return (
        f"A step wedge at ISO {values.choice('iso')} and {values.number('bits'):.0f} bits: "
        f"{burnt}, patch {values.number('patch'):.0f} {shown}, and {fit}."
    )


SCENE = Scene(
    id="sensor-noise",
    title="Sensor Noise",
    controls=CONTROLS,
    render=render,
    tiers=photon_counting.SHOT_MODELS,
    default_tier=DEFAULT_TIER,
    draft_tier=DEFAULT_TIER,
    drafted=("exposure", "dark"),
    ladder="shot-noise",
    error=error,
)
