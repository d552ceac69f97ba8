"""A step wedge counted, read and rounded by a noisy sensor: electrons → codes → transfer curve and
picture."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache, partial
from itertools import repeat
from typing import cast

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster, Readout, format_number
from simulations.engine.photograph import Photograph
from simulations.engine.raster import opaque, to_rgba8
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats, Mask
from simulations.models.color.cie import luminance
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.projection.pinhole import intrinsics, look_at
from simulations.models.sensor import photon_counting
from simulations.models.sensor.photon_counting import Sensor, ShotModel
from simulations.models.sensor.photon_transfer import Gain, estimate_gain, straight_part
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.world.radiance import Lighting
from simulations.world.room import light_of

type Codes = NDArray[np.uint16]

SHOT, READ, CELLS, ROOM, CLICKS = 1, 2, 4, 5, 6
"""Streams of random numbers: electrons, amplifier, cells' pattern, the room and the sound."""
ISOS = 100, 200, 400, 800, 1600, 3200, 6400
FRAMES = 2  # exposures of the same light; both share the pattern of the cells, which is not noise
FULL_WELL_E = 20_000.0
BRIGHTEST_E = 2 * FULL_WELL_E  # mean of the first patch at 0 EV: one stop above the full well
ROWS, COLUMNS = 4, 6
PATCH_PX = 40  # side of a patch: its 1600 pixels give the variance to about 3.5 %
STOPS = np.arange(ROWS * COLUMNS) / 2  # light of each patch relative to the first
PHOTOGRAPH_PX = (COLUMNS * PATCH_PX, ROWS * PATCH_PX)
ROOM_POSE = look_at((0.3, -0.6, 1.3), (0.0, 4.0, 0.8), (0.0, 0.0, 1.0))
CLIPPED_SHARE = 0.001  # patches with more of their pixels at either end are left out of the fit
EXPOSURES = 16  # of the patches, for the error of a tier


@dataclass(frozen=True, slots=True)
class Settings:
    exposure: float = slider("Exposure", 0, -6, 0, 0.5, unit="EV")
    iso: str = choice("ISO", {**{str(iso): str(iso) for iso in ISOS}, "auto": "Auto"})
    read_noise: float = slider("Read noise", 10, 0, 60, 1, unit="e⁻")
    dark: float = slider("Dark signal", 0, 0, 2000, 20, unit="e⁻")
    unequal: float = slider("Unequal cells (PRNU)", 0, 0, 5, 0.5, unit="%")
    bits: int = slider("Bit depth", 12, 4, 14, 1, unit="bits")
    patch: int = slider("Patch", 9, 1, 24, 1)
    new_noise: int = action(*("Take another photo",) * 8)


def iso_of(settings: Settings) -> float:
    """The ISO; chosen by the camera, it makes up for the exposure, and white stays white."""
    return ISOS[0] * 2.0**-settings.exposure if settings.iso == "auto" else float(settings.iso)


@dataclass(frozen=True, slots=True, kw_only=True)
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


def sensor_of(bits: int, iso: float, read_noise: float) -> Sensor:
    """The sensor: at ISO 100 the top code is a full well; a 64th of the codes is below black."""
    black = 2.0**bits / 64
    base = Sensor(
        full_well_e=FULL_WELL_E,
        read_noise_e=read_noise,
        dark_current_e_per_s=0.0,
        gain_e_per_dn=FULL_WELL_E / (2**bits - 1 - black),
        bits=bits,
        black_level_dn=black,
    )
    return photon_counting.with_iso(base, iso)


def saturation_e(camera: Sensor) -> float:
    """Electrons at which a pixel saturates: the well or the converter is full."""
    top = (camera.highest_dn - camera.black_level_dn) * camera.gain_e_per_dn
    return min(camera.full_well_e, top)


def floor_e2(camera: Sensor, dark: float) -> float:
    """Variance without light, in electrons squared: read noise, dark signal, rounding."""
    return camera.read_noise_e**2 + dark + camera.gain_e_per_dn**2 / 12


def patch_means_e(exposure: float) -> Floats:
    """(24,) electrons freed by light in a cell of each patch."""
    return BRIGHTEST_E * 2.0 ** (exposure - STOPS)


def light(exposure: float, photograph: Photograph | None) -> Floats:
    """Electrons freed by light: (24,) for the patches, or (24, 1600) for the reader's picture,
    whose white fills the well at 0 EV."""
    if photograph is None:
        return patch_means_e(exposure)
    grey = luminance(decode_srgb(np.float32(1 / 255) * photograph.codes))
    tiles = grey.reshape(ROWS, PATCH_PX, COLUMNS, PATCH_PX).swapaxes(1, 2)
    return FULL_WELL_E * 2.0**exposure * tiles.reshape(STOPS.size, -1)


def patch_light_e(light: Floats) -> Floats:
    """(24,) the mean of each patch."""
    return light if light.ndim == 1 else light.mean(axis=1, dtype=np.float64)


def grain(stream: int, new_noise: int) -> Floats:
    """(2, 24, 1600) standard normals of both frames, drawn once: the controls only scale them."""
    rng = np.random.default_rng((new_noise, stream))
    return rng.standard_normal((FRAMES, STOPS.size, PATCH_PX**2), np.float32)


def unequal_cells(light: Floats, unequal: float) -> Floats:
    """The light (24, 1600) measured by cells whose sensitivities differ by ``unequal`` per cent, or
    unchanged for 0. The pattern is the same for all takes."""
    if not unequal:
        return light
    pattern = np.random.default_rng(CELLS).standard_normal((STOPS.size, PATCH_PX**2), np.float32)
    mean_e = light if light.ndim == 2 else light[:, None].astype(np.float32)
    return np.maximum(mean_e * (1 + np.float32(unequal / 100) * pattern), 0)


def count_electrons(
    grain: Floats, cells: Floats, dark: float, new_noise: int, tier: ShotModel
) -> Floats:
    """(2, 24, 1600) electrons of both frames, freed by light and by heat."""
    mean_e = cells + dark
    if tier == "quantile":
        return photon_counting.shot_noise_from_normal(of_cells(mean_e), grain, FULL_WELL_E)
    rng = np.random.default_rng((new_noise, SHOT))
    return np.stack([count_patches(mean_e, rng, tier) for _ in range(FRAMES)])


def count_patches(mean_e: Floats, rng: np.random.Generator, model: ShotModel) -> Floats:
    """(24, 1600) electrons counted, for the means ``mean_e`` of patches or cells."""
    return photon_counting.shot_noise(of_cells(mean_e), rng, FULL_WELL_E, model)


def of_cells(mean_e: Floats) -> Floats:
    """(24, 1600) float32, of patches (24,) or of cells."""
    if mean_e.ndim == 2:
        return mean_e.astype(np.float32)
    return np.repeat(mean_e[:, None].astype(np.float32), PATCH_PX**2, axis=1)


def read(electrons: Floats, grain: Floats, bits: int, iso: float, read_noise: float) -> Codes:
    quiet = sensor_of(bits, iso, 0.0)  # the grain includes the read noise
    reported = electrons + np.float32(read_noise) * grain if read_noise else electrons
    signal = photon_counting.read_out(reported, quiet, np.random.default_rng(0))
    return photon_counting.quantise(signal, quiet.bits)


def measure(codes: Codes, bits: int, iso: float, read_noise: float, dark: float) -> Transfer:
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
    try:
        gain = estimate_gain(mean[~clipped], variance[~clipped], PATCH_PX**2)
    except ValueError:  # other noise or rounding hides the rise of the variance with the light
        gain = None
    return Transfer(
        mean_dn=mean,
        variance_dn=variance,
        one_frame_dn2=one_frame,
        fitted=fitted,
        clipped=clipped,
        gain=gain,
    )


def picture(codes: Codes, bits: int) -> Raster:
    """The patches of the first frame in four rows of six, brightest first."""
    tiles = colour_of_code(bits)[codes[0]]
    rows = tiles.reshape(ROWS, COLUMNS, PATCH_PX, PATCH_PX, 4).swapaxes(1, 2)
    return rows.reshape(ROWS * PATCH_PX, COLUMNS * PATCH_PX, 4)


@cache
def colour_of_code(bits: int) -> NDArray[np.uint8]:
    """(codes, 4) canvas bytes of each code, the same for any ISO."""
    linear = photon_counting.develop(np.arange(2.0**bits), sensor_of(bits, ISOS[0], 0.0))
    colours: NDArray[np.uint8] = to_rgba8(encode_srgb(np.clip(linear, 0, 1))[None])[0]
    colours.flags.writeable = False
    return colours


@cache
def room_light() -> Floats:
    """(160, 240, 3) light of the room at dusk, of which 1 fills the well at 0 EV."""
    columns, rows = PHOTOGRAPH_PX
    K = intrinsics(190.0, ((columns - 1) / 2, (rows - 1) / 2))
    light = light_of(K, ROOM_POSE, columns, rows, Lighting(60.0, lamp=0.6))
    return np.ascontiguousarray(light.transpose(1, 2, 0))


@lru_cache(maxsize=3)
def room_grain(seed: tuple[int, ...], count: int) -> NDArray[np.float32]:
    """(count, 160, 240, 3) standard normal deviates."""
    rng = np.random.default_rng(seed)
    return rng.standard_normal((count, *room_light().shape), np.float32)


def room(
    exposure: float,
    iso: float,
    read_noise: float,
    dark: float,
    unequal: float,
    bits: int,
    new_noise: int,
) -> Raster:
    """The room by this sensor, its three colours counted by cells of their own."""
    light, quiet = room_light(), sensor_of(bits, iso, 0.0)
    mean_e = np.float32(FULL_WELL_E * 2.0**exposure) * light
    if unequal:
        (cells,) = room_grain((CELLS,), 1)
        mean_e *= 1 + np.float32(unequal / 100) * cells
    shot, amplifier = room_grain((new_noise, ROOM), 2)
    counted = photon_counting.shot_noise_from_normal(
        np.maximum(mean_e, 0) + np.float32(dark), shot, FULL_WELL_E
    )
    noisy = counted + np.float32(read_noise) * amplifier
    signal = photon_counting.read_out(noisy, quiet, np.random.default_rng(0))
    return opaque(colour_of_code(bits)[:, 0][photon_counting.quantise(signal, bits)])


STAGES = (
    Stage("light", light),
    Stage("shot grain", partial(grain, SHOT)),
    Stage("read grain", partial(grain, READ)),
    Stage("cells", unequal_cells, ("light",)),
    Stage("electrons", count_electrons, ("shot grain", "cells")),
    Stage("codes", read, ("electrons", "read grain")),
    Stage("transfer", measure, ("codes",)),
    Stage("picture", picture, ("codes",)),
    Stage("room", room),
)


def estimate(settings: Settings, outputs: Outputs, tier: str) -> Iterator[Readout]:
    """The largest gap between the cumulatives of the electrons counted and of Poisson's
    distribution.

    As 1600 pixels of a patch are few, each step adds another exposure of the same patches. If the
    light or the cells differ within a patch, uniform patches of the same brightness are used.
    """
    mean_e = patch_light_e(outputs["light"]) + settings.dark
    rng, model = np.random.default_rng((settings.new_noise, 3)), cast(ShotModel, tier)
    even = not (outputs["photograph"] or settings.unequal)
    counted = outputs["electrons"][0] if even else count_patches(mean_e, rng, model)
    for exposures in range(1, EXPOSURES + 1):
        if exposures > 1:
            counted = np.concatenate((counted, count_patches(mean_e, rng, model)), axis=1)
        gap = max(map(gap_from_poisson, counted, mean_e, repeat(FULL_WELL_E)))
        chance = largest_chance_gap(*counted.shape)
        label = (
            f"Largest gap to Poisson’s cumulative, {exposures} of {EXPOSURES} exposures "
            f"(chance: {format_number(chance, 3)})"
        )
        yield Readout("error", label, format_number(gap, 3), "probability", role="error")
