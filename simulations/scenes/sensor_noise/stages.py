"""The stages of the sensor-noise figure: electrons → codes → transfer curve and picture."""

from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Mask
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.sensor import photon_counting
from simulations.models.sensor.photon_transfer import Gain, estimate_gain, straight_part
from simulations.scenes.sensor_noise import drawing

SHOT, READ, CELLS = 1, 2, 4
"""Streams of random numbers: electrons, amplifier, and the cells' pattern."""
FRAMES = 2
"""Exposures of the same light. Both share the pattern of the cells, which is not noise."""
FULL_WELL_E = 20_000.0
BRIGHTEST_E = 2 * FULL_WELL_E
"""Mean of the first patch at 0 EV: one stop above the full well."""
PATCH_PX = 40
"""Side of a patch: its 1600 pixels give the variance to about 3.5 %."""
STOPS = np.arange(drawing.ROWS * drawing.COLUMNS) / 2
"""Light of each patch relative to the first."""
PHOTOGRAPH_PX = (drawing.COLUMNS * PATCH_PX, drawing.ROWS * PATCH_PX)
CLOSE = (slice(8, 32), slice(2, 38))
"""Rows and columns of the enlarged part of a patch."""
MID_GREY = 0.2
"""Brightness of white, in linear light."""
CLIPPED_SHARE = 0.001
"""Patches with more of their pixels at the lowest or the highest code are left out of the fit."""


@dataclass(frozen=True, slots=True)
class Transfer:
    """The photon-transfer curve of two frames, without black level and mean dark signal."""

    mean_dn: Floats
    """(24,)"""
    variance_dn: Floats
    """(24,) half of the variance of the difference of the frames: EMVA 1288."""
    one_frame_dn2: Floats
    """(24,) variance between cells in the first frame, which includes the pattern."""
    fitted: Mask
    """(24,) the patches used to fit the gain."""
    clipped: Mask
    """(24,) the patches with pixels at either end of the converter."""
    gain: Gain | None
    """Gain from the slope of the fitted part; None if that does not determine it."""


def sensor_of(bits: int, iso: str, read_noise: float) -> photon_counting.Sensor:
    """The sensor: at ISO 100 the top code is a full well; a 64th of the codes is below black."""
    black = 2.0**bits / 64
    base = photon_counting.Sensor(
        full_well_e=FULL_WELL_E,
        read_noise_e=read_noise,
        dark_current_e_per_s=0.0,
        gain_e_per_dn=FULL_WELL_E / (2**bits - 1 - black),
        bits=bits,
        black_level_dn=black,
    )
    return photon_counting.with_iso(base, float(iso))


def saturation_e(camera: photon_counting.Sensor) -> float:
    """Electrons at which a pixel saturates: the well or the converter is full."""
    top = (camera.highest_dn - camera.black_level_dn) * camera.gain_e_per_dn
    return min(camera.full_well_e, top)


def floor_e2(camera: photon_counting.Sensor, dark: float) -> float:
    """Variance without light, in electrons squared: read noise, dark signal, rounding."""
    return camera.read_noise_e**2 + dark + camera.gain_e_per_dn**2 / 12


def curve_of(camera: photon_counting.Sensor, dark: float) -> drawing.Curve:
    """The theory of the plot, in codes."""
    gain = camera.gain_e_per_dn
    return drawing.Curve(
        gain_e_per_dn=gain,
        floor_dn2=floor_e2(camera, dark) / gain**2,
        full_dn=saturation_e(camera) / gain,
        dark_dn=dark / gain,
    )


def _grain(stream: int, new_noise: int) -> Floats:
    """(2, 24, 1600) standard normals of both frames, drawn once: the controls only scale them."""
    rng = np.random.default_rng((new_noise, stream))
    return rng.standard_normal((FRAMES, STOPS.size, PATCH_PX**2), np.float32)


def _cells(light: Floats, unequal: float) -> Floats:
    """The light (24, 1600) measured by cells whose sensitivities differ by ``unequal`` per cent, or
    unchanged for 0. The pattern is the same for all takes."""
    if not unequal:
        return light
    pattern = np.random.default_rng(CELLS).standard_normal((STOPS.size, PATCH_PX**2), np.float32)
    mean_e = light if light.ndim == 2 else light[:, None].astype(np.float32)
    return np.maximum(mean_e * (1 + np.float32(unequal / 100) * pattern), 0)


def _light(exposure: float, photograph: Photograph | None) -> Floats:
    """Electrons freed by light: (24,) for the patches, or (24, 1600) for the reader's picture,
    whose white fills the well at 0 EV."""
    if photograph is None:
        return patch_means_e(exposure)
    grey = luminance(decode_srgb(np.float32(1 / 255) * photograph.codes))
    tiles = grey.reshape(drawing.ROWS, PATCH_PX, drawing.COLUMNS, PATCH_PX).swapaxes(1, 2)
    return FULL_WELL_E * 2.0**exposure * tiles.reshape(STOPS.size, -1)


def patch_light_e(light: Floats) -> Floats:
    """(24,) the mean of each patch."""
    return light if light.ndim == 1 else light.mean(axis=1, dtype=np.float64)


def _count(
    grain: Floats, cells: Floats, dark: float, new_noise: int, tier: photon_counting.ShotModel
) -> Floats:
    """(2, 24, 1600) electrons of both frames, freed by light and by heat."""
    mean_e = cells + dark
    if tier == "quantile":
        return photon_counting.shot_noise_from_normal(_flat(mean_e), grain, FULL_WELL_E)
    rng = np.random.default_rng((new_noise, SHOT))
    return np.stack([count_patches(mean_e, rng, tier) for _ in range(FRAMES)])


def count_patches(
    mean_e: Floats, rng: np.random.Generator, model: photon_counting.ShotModel
) -> Floats:
    """(24, 1600) electrons counted, for the means ``mean_e`` of patches or cells."""
    return photon_counting.shot_noise(_flat(mean_e), rng, FULL_WELL_E, model)


def _flat(mean_e: Floats) -> Floats:
    """(24, 1600) float32, of patches (24,) or of cells."""
    if mean_e.ndim == 2:
        return mean_e.astype(np.float32)
    return np.repeat(mean_e[:, None].astype(np.float32), PATCH_PX**2, axis=1)


def patch_means_e(exposure: float) -> Floats:
    """(24,) electrons freed by light in a cell of each patch."""
    return BRIGHTEST_E * 2.0 ** (exposure - STOPS)


def _read(
    electrons: Floats, grain: Floats, bits: int, iso: str, read_noise: float
) -> NDArray[np.uint16]:
    quiet = sensor_of(bits, iso, 0.0)  # the grain includes the read noise
    reported = electrons + np.float32(read_noise) * grain if read_noise else electrons
    signal = photon_counting.read_out(reported, quiet, np.random.default_rng(0))
    return photon_counting.quantise(signal, quiet.bits)


def _measure(
    codes: NDArray[np.uint16], bits: int, iso: str, read_noise: float, dark: float
) -> Transfer:
    camera = sensor_of(bits, iso, read_noise)
    mean = codes.mean(axis=(0, 2), dtype=np.float64) - camera.black_level_dn
    mean -= dark / camera.gain_e_per_dn
    first, second = codes.astype(np.float32)
    variance = (first - second).var(axis=1, ddof=1, dtype=np.float64) / 2
    one_frame = first.var(axis=1, ddof=1, dtype=np.float64)
    at_an_end = (codes == 0) | (codes == camera.highest_dn)
    clipped = at_an_end.mean(axis=(0, 2)) > CLIPPED_SHARE
    fitted = ~clipped
    fitted[fitted] = straight_part(mean[fitted], variance[fitted])
    gain = _gain(mean[~clipped], variance[~clipped])
    return Transfer(mean, variance, one_frame, fitted, clipped, gain)


def _gain(mean: Floats, variance: Floats) -> Gain | None:
    """None if other noise or rounding hides the rise of the variance with the light."""
    try:
        return estimate_gain(mean, variance, PATCH_PX**2)
    except ValueError:
        return None


def _picture(codes: NDArray[np.uint16], bits: int) -> NDArray[np.uint8]:
    """The patches of the first frame in four rows of six, brightest first."""
    tiles = _colour_of_code(bits)[codes[0]]
    rows = tiles.reshape(drawing.ROWS, drawing.COLUMNS, PATCH_PX, PATCH_PX, 4).swapaxes(1, 2)
    return rows.reshape(drawing.ROWS * PATCH_PX, drawing.COLUMNS * PATCH_PX, 4)


@cache
def _colour_of_code(bits: int) -> NDArray[np.uint8]:
    """(codes, 4) canvas bytes of each code, the same for any ISO."""
    linear = photon_counting.develop(np.arange(2.0**bits), sensor_of(bits, "100", 0.0))
    colours: NDArray[np.uint8] = to_rgba8(encode_srgb(np.clip(linear, 0, 1))[None])[0]
    colours.flags.writeable = False
    return colours


def enlarged(codes: NDArray[np.uint16], camera: photon_counting.Sensor) -> Raster:
    """The middle of a patch (1600,) as bytes, scaled to a mid-grey."""
    signal = codes.reshape(PATCH_PX, PATCH_PX)[CLOSE] - camera.black_level_dn
    level = max(float(signal.mean()), float(signal.std()), 1.0)
    return to_rgba8(encode_srgb(np.clip(MID_GREY * signal / level, 0, 1)))


STAGES = (
    Stage("light", _light),
    Stage("shot grain", partial(_grain, SHOT)),
    Stage("read grain", partial(_grain, READ)),
    Stage("cells", _cells, ("light",)),
    Stage("electrons", _count, ("shot grain", "cells")),
    Stage("codes", _read, ("electrons", "read grain")),
    Stage("transfer", _measure, ("codes",)),
    Stage("picture", _picture, ("codes",)),
)
