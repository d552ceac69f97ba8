"""What the sensor-noise figure computes: electrons → codes → transfer curve and picture."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.pipeline import Stage
from simulations.engine.raster import to_rgba8
from simulations.models import sensor
from simulations.models.color import encode_srgb
from simulations.models.photon_transfer import Gain, estimate_gain, straight_part
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
    gain: Gain | None
    """From the slope of the fitted part; None where that does not tell it."""


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


def _count(exposure: float, dark: float, new_noise: int, tier: sensor.ShotModel) -> Floats:
    """(24, 1600) electrons: light and warmth free them alike."""
    rng = np.random.default_rng((new_noise, 1))
    return count_patches(patch_means_e(exposure) + dark, rng, tier)


def count_patches(mean_e: Floats, rng: np.random.Generator, model: sensor.ShotModel) -> Floats:
    """(24, 1600) electrons counted where ``mean_e`` (24,) are expected."""
    flat = np.repeat(mean_e[:, None], PATCH_PX**2, axis=1)
    return sensor.shot_noise(flat, rng, FULL_WELL_E, model)


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
    fitted = ~clipped
    fitted[fitted] = straight_part(mean[fitted], variance[fitted])
    return Transfer(mean, variance, fitted, clipped, _gain(mean[~clipped], variance[~clipped]))


def _gain(mean: Floats, variance: Floats) -> Gain | None:
    """None where other noise hides how the variance rises with the light, or rounding does."""
    try:
        return estimate_gain(mean, variance, PATCH_PX**2)
    except ValueError:
        return None


def _picture(codes: NDArray[np.uint16], bits: float, iso: str) -> NDArray[np.uint8]:
    """The patches in four rows of six, brightest first."""
    linear = sensor.develop(codes, sensor_of(int(bits), iso, 0.0))
    tiles = linear.reshape(drawing.ROWS, drawing.COLUMNS, PATCH_PX, PATCH_PX)
    wedge = tiles.swapaxes(1, 2).reshape(drawing.ROWS * PATCH_PX, drawing.COLUMNS * PATCH_PX)
    return to_rgba8(encode_srgb(np.clip(wedge, 0, 1)))


STAGES = (
    Stage("electrons", ("exposure", "dark", "new_noise", "tier"), _count),
    Stage("codes", ("bits", "iso", "read_noise", "new_noise"), _read, ("electrons",)),
    Stage("transfer", ("bits", "iso", "read_noise", "dark"), _measure, ("codes",)),
    Stage("picture", ("bits", "iso"), _picture, ("codes",)),
)
