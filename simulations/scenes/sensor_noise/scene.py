"""A step wedge photographed by a noisy sensor, and what its noise gives away about the sensor.

Twenty-four patches, each half a stop darker than the one before, are counted, read and rounded.
The variance of each patch against its mean is the photon-transfer curve; the slope of its middle
part measures the gain without opening the camera.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import cast

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_counting import SHOT_MODELS, Sensor, ShotModel
from simulations.models.sensor.photon_transfer import Gain
from simulations.scenes.sensor_noise import drawing
from simulations.scenes.sensor_noise.error import judge
from simulations.scenes.sensor_noise.stages import (
    STAGES,
    Transfer,
    floor_e2,
    patch_means_e,
    saturation_e,
    sensor_of,
)


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    exposure: float = slider("Exposure", 0, -6, 0, 0.5, unit="EV")
    iso: str = choice("ISO", {str(iso): str(iso) for iso in (100, 200, 400, 800, 1600, 3200, 6400)})
    read_noise: float = slider("Read noise", 10, 0, 60, 1, unit="e⁻")
    dark: float = slider("Dark signal", 0, 0, 2000, 20, unit="e⁻")
    bits: int = slider("Converter", 12, 4, 14, 1, unit="bits")
    patch: int = slider("Patch", 9, 1, 24, 1)
    new_noise: int = action(*("Take it again",) * 8)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The wedge, and the variance of each of its patches against its mean."""
    transfer: Transfer = outputs["transfer"]
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    means_e, floor = patch_means_e(settings.exposure), floor_e2(camera, settings.dark)
    patch = settings.patch - 1
    plot = drawing.transfer_plot(
        curve_of(camera, settings.dark),
        transfer.mean_dn,
        transfer.variance_dn,
        transfer.fitted,
        patch,
    )
    return Frame(
        panels=(
            Panel(
                "wedge",
                "24 patches, and the mean electrons in each",
                drawing.WIDTH,
                drawing.HEIGHT,
                outputs["picture"],
                drawing.over_wedge(means_e, patch),
                pixelated=True,
            ),
            Panel("transfer", "Photon transfer", drawing.WIDTH, drawing.HEIGHT, overlay=plot),
        ),
        readouts=(
            *patch_readouts(transfer, patch, float(means_e[patch]), floor),
            *sensor_readouts(transfer.gain, camera, floor),
        ),
        description=describe(settings, transfer, camera),
    )


def curve_of(camera: Sensor, dark: float) -> drawing.Curve:
    """The theory of the plot, in codes."""
    gain = camera.gain_e_per_dn
    return drawing.Curve(
        gain_e_per_dn=gain,
        floor_dn2=floor_e2(camera, dark) / gain**2,
        full_dn=saturation_e(camera) / gain,
        dark_dn=dark / gain,
    )


def patch_readouts(
    transfer: Transfer, patch: int, mean_e: float, floor: float
) -> tuple[Readout, ...]:
    """What one patch shows, on which ``mean_e`` electrons of light are expected; see `floor_e2`."""
    theory = format_number(mean_e / math.sqrt(mean_e + floor), 1)
    expected = "clipped" if transfer.clipped[patch] else theory
    sigma = math.sqrt(transfer.variance_dn[patch])
    return (
        readout("mean", "Patch mean", transfer.mean_dn[patch], "DN", digits=1, role="image"),
        readout("sigma", "Patch σ", sigma, "DN", digits=2, role="image"),
        Readout("snr", "SNR, measured", measured_ratio(transfer, patch), role="image"),
        Readout("theory", "SNR, theory", expected, role="ray"),
    )


def sensor_readouts(gain: Gain | None, camera: Sensor, floor: float) -> tuple[Readout, ...]:
    """What all patches together tell of the sensor, and the truth."""
    span = math.log2(saturation_e(camera) / math.sqrt(floor))
    return (
        Readout("gain", "Gain, measured", measured_gain(gain), "e⁻/DN", "image"),
        readout("truth", "Gain, true", camera.gain_e_per_dn, "e⁻/DN", digits=3, role="light"),
        readout("range", "Dynamic range", span, "stops", digits=1),
    )


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


def describe(settings: Settings, transfer: Transfer, camera: Sensor) -> str:
    """The picture in one sentence."""
    light_e = patch_means_e(settings.exposure) + settings.dark
    full = int(np.count_nonzero(light_e > saturation_e(camera)))
    burnt = f"{full} of 24 patches are burnt out" if full else "no patch is burnt out"
    words = {"one code only": "shows one code only", "clipped": "is clipped"}
    measured = measured_ratio(transfer, settings.patch - 1)
    shown = words.get(measured, f"has an SNR of {measured}")
    floor_dn = math.sqrt(floor_e2(camera, settings.dark)) / camera.gain_e_per_dn
    if transfer.gain is None:
        fit = "too few patches with noise of their own are left to measure the gain"
    elif floor_dn < 0.5:
        fit = "the dark patches vary by less than a code and fall into flat steps"
    else:
        off = abs(transfer.gain.e_per_dn / camera.gain_e_per_dn - 1)
        fit = f"the variances give the gain to within {math.ceil(100 * off)} %"
    return (
        f"A step wedge at ISO {settings.iso} and {settings.bits} bits: "
        f"{burnt}, patch {settings.patch} {shown}, and {fit}."
    )


def estimate(settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """How far the electrons of the patches are from Poisson's distribution."""
    mean_e = patch_means_e(settings.exposure) + settings.dark
    return judge(outputs["electrons"], mean_e, settings.new_noise, cast(ShotModel, tier))


SCENE = Scene(
    id="sensor-noise",
    title="Sensor Noise",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    tiers=SHOT_MODELS,
    default_tier="quantile",
    drafted=("exposure", "dark"),
    ladder="shot-noise",
    estimate=estimate,
)
