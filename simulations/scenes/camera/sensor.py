"""The camera's sensor: from light to electrons, codes and the bytes of a photograph."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.lens import thin_lens
from simulations.models.lens.vignetting import vignetting_cos4
from simulations.models.pixel_grid import centred
from simulations.models.sensor import photon_counting
from simulations.scenes._still_life_camera.rays import COLUMNS, PITCH_MM, ROWS, principal_mm

FULL_WELL_E = 10_000.0
BLACK_DN = 512.0
ADC = photon_counting.Sensor(
    full_well_e=FULL_WELL_E,
    read_noise_e=0.0,
    dark_current_e_per_s=0.0,
    gain_e_per_dn=FULL_WELL_E / (4095.0 - BLACK_DN),
    bits=12,
    black_level_dn=BLACK_DN,
)
"""A 12-bit converter whose top code is a full well."""

BASE_SHUTTER_S, BASE_F_NUMBER = 1 / 60, 8.0
"""Shutter and aperture at which a white surface facing the lamp nearly fills the well, at 0 EV and
focused at infinity."""


def shutter_s(focal_length: float, aperture: float, focus: float, exposure: float) -> float:
    """Exposure time by the automatic, which measures the light through the lens.

    A wider aperture shortens it by the square; a nearer focus, for which the sensor is farther from
    the aperture, lengthens it.
    """
    working = thin_lens.working_f_number(focal_length, aperture, focus * 1000.0)
    return float(BASE_SHUTTER_S * (working / BASE_F_NUMBER) ** 2 * 2.0**exposure)


def read_noise_e(noise_sigma: float) -> float:
    """Electrons for σ given in 8-bit codes of linear light: 255 codes are a full well."""
    return noise_sigma / 255.0 * FULL_WELL_E


@dataclass(frozen=True, slots=True)
class Grain:
    """Random numbers, drawn once: light and amplifier only scale them."""

    shot: Planes
    """(3, rows, columns) standard normal."""
    read: Planes
    """(3, rows, columns) standard normal, of the amplifier."""


def draw_grain(new_noise: int) -> Grain:
    shot, read = (
        np.random.default_rng((new_noise, stream)).standard_normal((3, ROWS, COLUMNS), np.float32)
        for stream in (1, 2)
    )
    return Grain(shot, read)


def vignette(radiance: Planes, focal_length: float, focus: float) -> Planes:
    """Light on the sensor, relative to that of the same surface on the axis."""
    x, y = centred(COLUMNS) * PITCH_MM, centred(ROWS) * PITCH_MM
    falloff = vignetting_cos4(np.hypot(x, y[:, None]) / principal_mm(focal_length, focus))
    return radiance * falloff.astype(np.float32)


def expose(irradiance: Planes, exposure: float) -> Planes:
    """Mean electrons; the shutter compensates aperture and focus."""
    return irradiance * np.float32(FULL_WELL_E * 2.0**exposure)


def count(mean_e: Planes, grain: Grain) -> Planes:
    """Electrons counted: quantiles of the Poisson distribution at the grain's probabilities. Unlike
    with a Poisson sampler, the grain stays the same as the light changes."""
    return np.asarray(
        photon_counting.shot_noise_from_normal(mean_e, grain.shot, FULL_WELL_E), np.float32
    )


def read(electrons: Planes, grain: Grain, noise_sigma: float) -> Planes:
    """Electrons as the amplifier reports them."""
    return electrons + np.float32(read_noise_e(noise_sigma)) * grain.read


def quantise(electrons: Planes) -> NDArray[np.uint16]:
    """Codes of the converter."""
    signal = photon_counting.read_out(
        electrons, ADC, np.random.default_rng(0)
    )  # noiseless: gain and offset
    return photon_counting.quantise(signal, ADC.bits)


def _srgb_bytes(linear: Floats) -> NDArray[np.uint8]:
    return to_rgba8(encode_srgb(linear)[None])[0, :, 0]


BYTE_OF_CODE = _srgb_bytes(photon_counting.develop(np.arange(2.0**ADC.bits), ADC))
"""(4096,) sRGB byte of each code, without the black level, as a table for all pixels."""

ROOTS = 4096
BYTE_OF_ROOT = _srgb_bytes((np.arange(ROOTS + 1) / ROOTS) ** 2)
"""sRGB byte of continuous light, by its square root, in which the curve is nearly straight."""


def encode(codes: NDArray[np.uint16]) -> Raster:
    """The photograph."""
    return _picture(BYTE_OF_CODE[codes])


def develop_ideal(mean_e: Planes) -> Raster:
    """The photograph of a sensor without noise and quantisation, the reference of the PSNR."""
    root = np.sqrt(np.minimum(mean_e, FULL_WELL_E)) * np.float32(ROOTS / math.sqrt(FULL_WELL_E))
    return _picture(BYTE_OF_ROOT[np.rint(root).astype(np.uint16)])


def _picture(planes: NDArray[np.uint8]) -> Raster:
    """Opaque bytes of a canvas from (3, rows, columns)."""
    picture = np.full((*planes.shape[1:], 4), 255, np.uint8)
    for channel, plane in enumerate(planes):
        picture[..., channel] = plane
    return picture
