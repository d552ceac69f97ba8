"""A step wedge photographed by a noisy sensor, and what its noise gives away about the sensor.

Twenty-four patches, each half a stop darker than the one before, are counted, read and rounded.
The variance of each patch against its mean is the photon-transfer curve; the slope of its middle
part measures the gain without opening the camera.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Action, Choice, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.pipeline import Stage, StageCache, run
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.models import sensor
from simulations.models.color import encode_srgb
from simulations.scenes import sensor_noise_drawing as drawing

type Floats = NDArray[np.floating]

FULL_WELL_E = 20_000.0
BRIGHTEST_E = 2 * FULL_WELL_E
"""Mean of the first patch at 0 EV: one stop more than a cell can hold."""
PATCH_PX = 40
"""Side of a patch: its 1600 pixels give the variance to about 3.5 %."""
STOPS = np.arange(drawing.ROWS * drawing.COLUMNS) / 2
"""How much darker than the first each patch is."""
CLIPPED_SHARE = 0.001
"""Patches with more of their pixels at the lowest or the highest code are left out of the fit."""
NOISELESS_DN2 = 0.02
"""A patch of less variance has nearly all of its pixels at one code and says nothing of noise."""

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


@dataclass(frozen=True, slots=True)
class Transfer:
    """The photon-transfer curve of one picture; black level and mean dark signal taken off."""

    mean_dn: Floats
    """(24,)"""
    variance_dn: Floats
    """(24,)"""
    fitted: NDArray[np.bool_]
    """(24,) the patches that the gain was fitted to."""
    clipped: NDArray[np.bool_]
    """(24,) the patches with pixels at either end of the converter."""
    gain_e_per_dn: float
    """From the slope of the fitted part; nan with too few patches."""


def sensor_of(bits: int, iso: str, read_noise: float) -> sensor.Sensor:
    """At ISO 100 the top code is a full well; a 64th of the codes lies below black."""
    black = 2.0**bits / 64
    base = sensor.Sensor(
        full_well_e=FULL_WELL_E,
        read_noise_e=read_noise,
        dark_current_e_per_s=0.0,
        gain_e_per_dn=FULL_WELL_E / (2**bits - 1 - black),
        bits=bits,
        black_level_dn=black,
    )
    return sensor.with_iso(base, float(iso))


def saturation_e(camera: sensor.Sensor) -> float:
    """Electrons above which a pixel no longer tells light apart: well or converter is full."""
    top = (camera.highest_dn - camera.black_level_dn) * camera.gain_e_per_dn
    return min(camera.full_well_e, top)


def floor_e2(camera: sensor.Sensor, dark: float) -> float:
    """Variance without light, in electrons squared: read noise, dark signal, rounding."""
    return camera.read_noise_e**2 + dark + camera.gain_e_per_dn**2 / 12


def _count(exposure: float, dark: float, new_noise: int) -> Floats:
    """(24, 1600) electrons: light and warmth free them alike."""
    mean_e = np.repeat((patch_means_e(exposure) + dark)[:, None], PATCH_PX**2, axis=1)
    rng = np.random.default_rng((new_noise, 1))
    return sensor.shot_noise(mean_e, rng, FULL_WELL_E)


def patch_means_e(exposure: float) -> Floats:
    """(24,) electrons that light frees in a cell of each patch."""
    means: Floats = BRIGHTEST_E * 2.0 ** (exposure - STOPS)
    return means


def _read(
    electrons: Floats, bits: float, iso: str, read_noise: float, new_noise: int
) -> NDArray[np.uint16]:
    camera = sensor_of(int(bits), iso, read_noise)
    rng = np.random.default_rng((new_noise, 2))
    return sensor.quantise(sensor.read_out(electrons, camera, rng), camera.bits)


def _measure(
    codes: NDArray[np.uint16], bits: float, iso: str, read_noise: float, dark: float
) -> Transfer:
    camera = sensor_of(int(bits), iso, read_noise)
    mean = codes.mean(axis=1, dtype=np.float64) - camera.black_level_dn
    mean -= dark / camera.gain_e_per_dn
    variance = codes.var(axis=1, ddof=1, dtype=np.float64)
    at_an_end = (codes == 0) | (codes == camera.highest_dn)
    clipped = at_an_end.mean(axis=1) > CLIPPED_SHARE
    fitted = ~clipped & (variance > NOISELESS_DN2)
    enough = np.count_nonzero(fitted) >= 3
    gain = sensor.estimate_gain(mean[fitted], variance[fitted]) if enough else math.nan
    return Transfer(mean, variance, fitted, clipped, gain if gain > 0 else math.nan)


def _picture(codes: NDArray[np.uint16], bits: float, iso: str) -> NDArray[np.uint8]:
    """The patches in four rows of six, brightest first."""
    linear = sensor.develop(codes, sensor_of(int(bits), iso, 0.0))
    tiles = linear.reshape(drawing.ROWS, drawing.COLUMNS, PATCH_PX, PATCH_PX)
    wedge = tiles.swapaxes(1, 2).reshape(drawing.ROWS * PATCH_PX, drawing.COLUMNS * PATCH_PX)
    return to_rgba8(encode_srgb(np.clip(wedge, 0, 1)))


STAGES = (
    Stage("electrons", ("exposure", "dark", "new_noise"), _count),
    Stage("codes", ("bits", "iso", "read_noise", "new_noise"), _read, ("electrons",)),
    Stage("transfer", ("bits", "iso", "read_noise", "dark"), _measure, ("codes",)),
    Stage("picture", ("bits", "iso"), _picture, ("codes",)),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:  # noqa: ARG001 - no tiers
    done = run(STAGES, values, cache)
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
            "The picture of 24 patches",
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
    measured = format_number(transfer.mean_dn[patch] / sigma, 1) if sigma > 0 else "one code only"
    expected = "clipped" if transfer.clipped[patch] else format_number(theory, 1)
    readouts = (
        readout("mean", "Patch mean", transfer.mean_dn[patch], "DN", digits=1, role="image"),
        readout("sigma", "Patch σ", sigma, "DN", digits=2, role="image"),
        Readout("snr", "SNR, measured", measured, role="image"),
        Readout("theory", "SNR, theory", expected, role="ray"),
        readout("gain", "Gain, measured", transfer.gain_e_per_dn, "e⁻/DN", digits=3, role="image"),
        readout("truth", "Gain, true", gain, "e⁻/DN", digits=3, role="light"),
        readout("range", "Dynamic range", span, "stops", digits=1),
    )
    return Frame(panels, readouts, describe(values, transfer, camera, measured), done.reports)


def describe(values: Values, transfer: Transfer, camera: sensor.Sensor, measured: str) -> str:
    """The picture in one sentence."""
    light_e = patch_means_e(values.number("exposure")) + values.number("dark")
    full = int(np.count_nonzero(light_e > saturation_e(camera)))
    burnt = f"{full} of 24 patches are burnt out" if full else "no patch is burnt out"
    shown = "shows one code only" if measured == "one code only" else f"has an SNR of {measured}"
    floor_dn = math.sqrt(floor_e2(camera, values.number("dark"))) / camera.gain_e_per_dn
    if math.isnan(transfer.gain_e_per_dn):
        fit = "too few patches are left to measure the gain"
    elif floor_dn < 0.5:
        fit = "the dark patches vary by less than a code and fall into flat steps"
    else:
        off = abs(transfer.gain_e_per_dn / camera.gain_e_per_dn - 1)
        fit = f"the variances give the gain to within {math.ceil(100 * off)} %"
    return (
        f"A step wedge at ISO {values.choice('iso')} and {values.number('bits'):.0f} bits: "
        f"{burnt}, patch {values.number('patch'):.0f} {shown}, and {fit}."
    )


SCENE = Scene(id="sensor-noise", title="Sensor Noise", controls=CONTROLS, render=render)
