"""A step wedge photographed twice by a noisy sensor, and the sensor's gain from the noise.

Twenty-four patches, each half a stop darker than the one before, are counted, read and rounded.
Half the variance of the difference of two frames, against the mean, is the photon-transfer curve;
the slope of its middle part measures the conversion gain without opening the camera.
"""

import math
from collections.abc import Iterator
from typing import cast

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_counting import (
    SHOT_MODELS,
    Sensor,
    ShotModel,
    shot_noise_from_normal,
)
from simulations.models.sensor.photon_transfer import Gain
from simulations.scenes.sensor_noise import drawing
from simulations.scenes.sensor_noise.drawing import format_electrons
from simulations.scenes.sensor_noise.error import estimates
from simulations.scenes.sensor_noise.handles import HANDLES
from simulations.scenes.sensor_noise.settings import Settings
from simulations.scenes.sensor_noise.stages import (
    PHOTOGRAPH_PX,
    STAGES,
    Transfer,
    curve_of,
    enlarged,
    floor_e2,
    patch_light_e,
    saturation_e,
    sensor_of,
)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The wedge, a patch of it, and the variance of each patch against its mean."""
    transfer: Transfer = outputs["transfer"]
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    means_e, floor = patch_light_e(outputs["light"]), floor_e2(camera, settings.dark)
    own, patch = outputs["photograph"] is not None, settings.patch - 1
    title = "Your picture, in 24 patches" if own else "The photo: 24 grey patches"
    curve = curve_of(camera, settings.dark)
    level = None if own else float(means_e[patch]) / camera.gain_e_per_dn
    plot = drawing.transfer_plot(
        curve,
        transfer.mean_dn,
        transfer.variance_dn,
        transfer.fitted,
        patch,
        level,
        transfer.one_frame_dn2 if settings.unequal and not own else None,
    )
    label = f"{format_electrons(float(means_e[patch]))} e⁻, {noise_share(transfer, patch)}"
    return Frame(
        panels=(
            _panel(
                "wedge",
                title,
                drawing.over_wedge(patch),
                outputs["picture"],
            ),
            _panel(
                "patch",
                "The framed patch, brought to mid-grey",
                drawing.over_patch(label),
                enlarged(outputs["codes"][0, patch], camera),
            ),
            _panel("transfer", "Noise of every patch, against its light", plot),
        ),
        readouts=(
            *patch_readouts(transfer, patch, float(means_e[patch]), floor),
            *sensor_readouts(transfer.gain, camera, floor),
        ),
        description=describe(settings, outputs, camera),
    )


def _panel(name: str, title: str, overlay: str, raster: Raster | None = None) -> Panel:
    width, height = drawing.WIDTH, drawing.HEIGHT
    lead = name == "wedge"
    return Panel(name, title, width, height, raster, overlay, raster is not None, lead=lead)


def noise_share(transfer: Transfer, patch: int) -> str:
    """Signal-to-noise ratio of a patch, in words."""
    words = measured_ratio(transfer, patch)
    mean, sigma = transfer.mean_dn[patch], math.sqrt(transfer.variance_dn[patch])
    if words in ("one code only", "clipped"):
        return words
    if mean < sigma / 3:
        return "lost in noise"
    return f"noise {format_number(100 * sigma / mean, 0 if sigma > 0.1 * mean else 1)} %"


def patch_readouts(
    transfer: Transfer, patch: int, mean_e: float, floor: float
) -> tuple[Readout, ...]:
    """Readouts of one patch with ``mean_e`` expected electrons of light; see `floor_e2`."""
    theory = format_number(mean_e / math.sqrt(mean_e + floor), 1)
    expected = "clipped" if transfer.clipped[patch] else theory
    sigma = math.sqrt(transfer.variance_dn[patch])
    return (
        readout("mean", "Mean of the patch", transfer.mean_dn[patch], "DN", digits=1, role="image"),
        readout("sigma", "Noise of the patch (σ)", sigma, "DN", digits=2, role="image"),
        Readout("snr", "Signal to noise (SNR)", measured_ratio(transfer, patch), role="image"),
        Readout("theory", "SNR by theory", expected, role="ray"),
    )


def sensor_readouts(gain: Gain | None, camera: Sensor, floor: float) -> tuple[Readout, ...]:
    """Estimates of the sensor from all patches, and the true values."""
    span = math.log2(saturation_e(camera) / math.sqrt(floor))
    return (
        Readout("gain", "Measured gain", measured_gain(gain), "e⁻/DN", "image"),
        readout("truth", "True gain", camera.gain_e_per_dn, "e⁻/DN", digits=3, role="light"),
        readout("range", "Dynamic range", span, "stops", digits=1),
    )


def measured_ratio(transfer: Transfer, patch: int) -> str:
    """Signal-to-noise ratio of a patch, or why there is none."""
    sigma = math.sqrt(transfer.variance_dn[patch])
    if sigma == 0:
        return "one code only"
    if transfer.clipped[patch]:  # part of the noise is cut off, and the ratio would be too good
        return "clipped"
    return format_number(transfer.mean_dn[patch] / sigma, 1)


def measured_gain(gain: Gain | None) -> str:
    """The gain with its standard error, to two digits of the latter."""
    if gain is None:
        return "not measurable"
    digits = min(max(1 - math.floor(math.log10(gain.error_e_per_dn)), 0), 5)
    shown, error_shown = (
        format_number(part, digits) for part in (gain.e_per_dn, gain.error_e_per_dn)
    )
    return f"{shown} ± {error_shown}"


def describe(settings: Settings, outputs: Outputs, camera: Sensor) -> str:
    """The picture in one sentence."""
    transfer: Transfer = outputs["transfer"]
    own = outputs["photograph"] is not None
    brightest_e = outputs["light"].reshape(24, -1).max(axis=1) + settings.dark
    full = int(np.count_nonzero(brightest_e > saturation_e(camera)))
    are = "hold cells that are" if own else "are"
    burnt = f"{full} of 24 patches {are} burnt out" if full else "no patch is burnt out"
    what = "Your own picture" if own else "A photo of 24 grey patches from light to dark"
    words = {"one code only": "shows one code only", "clipped": "is clipped"}
    measured = measured_ratio(transfer, settings.patch - 1)
    shown = words.get(measured, f"has an SNR of {measured}")
    floor_dn = math.sqrt(floor_e2(camera, settings.dark)) / camera.gain_e_per_dn
    if transfer.gain is None:
        fit = "too few patches with noise of their own are left to measure the conversion gain"
    elif floor_dn < 0.5:
        fit = "the dark patches vary by less than a code and fall into flat steps"
    else:
        off = abs(transfer.gain.e_per_dn / camera.gain_e_per_dn - 1)
        fit = f"the variances give the conversion gain to within {math.ceil(100 * off)} %"
    return (
        f"{what} at ISO {settings.iso} and {settings.bits} bits: "
        f"{burnt}, patch {settings.patch} {shown}, and {fit}."
    )


def estimate(settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Distance of the patches' electrons from Poisson's distribution."""
    mean_e = patch_light_e(outputs["light"]) + settings.dark
    # If the light or the cells differ within a patch, uniform patches of the same brightness are
    # used.
    even = not (outputs["photograph"] or settings.unequal)
    counted = outputs["electrons"][0] if even else None
    return estimates(counted, mean_e, settings.new_noise, cast(ShotModel, tier))


SCENE = Scene(
    id="sensor-noise",
    title="Sensor Noise",
    settings=Settings,
    draw=draw,
    formula=shot_noise_from_normal,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    tiers=SHOT_MODELS,
    default_tier="quantile",
    drafted=("exposure", "dark", "unequal"),
    ladder="shot-noise",
    estimate=estimate,
)
