"""The complete camera, stage by stage: from rays through the lens to light, electrons, codes and
the bytes of a photograph."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.accuracy import Level
from simulations.engine.controls import Value
from simulations.engine.frame import Raster
from simulations.engine.raster import of_planes, to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.lens import thin_lens
from simulations.models.lens.aperture import aperture_grid, fibonacci_disc
from simulations.models.sensor import photon_counting
from simulations.scenes.camera import lens
from simulations.scenes.camera.lens import STRONGEST_BARREL, Settings, after_step, blur_of
from simulations.world.still_life_camera import (
    COLUMNS,
    ROWS,
    SCALED,
    SCALED_LABEL,
    Rays,
    bend_rays,
    defocus,
    drawing_of,
    enlarge,
    find_surfaces,
    in_focus,
    light_surfaces,
    mean_through_lens,
    overlay,
    pinhole_rays,
    sensor_rays,
    through_lens,
    vignette,
)

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
REFERENCE_GRID = 7
"""Points across the lens of the picture that errors are measured against: 37 in all."""


def level(
    name: str, label: str, *, reduction: int = 1, bent_rays: bool = False, lens_rays: int = 0
) -> Level:
    """``reduction``: pixels per ray each way; ``bent_rays``: whether the rays are bent, or the
    finished picture; ``lens_rays``: through the lens's opening, 0 for a blur instead."""
    stage_values = {"reduction": reduction, "bent_rays": bent_rays, "lens_rays": lens_rays}
    return Level(name, label, stage_values)


BOWED = "bowed"
"""The level at which k₁ costs least: one straight picture, drawn with the widest margin that any k₁
of the slider needs, is bent anew. Elsewhere the margin fits the present k₁."""
LEVELS = (
    level("draft", "A ray for four pixels", reduction=2),
    level(SCALED, SCALED_LABEL),
    level(BOWED, "One wide picture, bent"),
    level("layers", "Bent picture, blurred layers"),
    level("bent-rays", "Bent rays, blurred layers", bent_rays=True),
    level("aperture-rays", "12 bent rays a pixel", bent_rays=True, lens_rays=12),
)


def parameters(settings: Settings, level: str) -> dict[str, Value]:
    """The parameters of the stages that are computed from the settings."""
    now, (across, down) = after_step(settings), (0, 0)
    if level not in ("bent-rays", "aperture-rays"):
        of_lens = now.focal_length, now.focus
        widest = lens.widest_barrel(*of_lens, STRONGEST_BARREL) if level == BOWED else now.k1
        across, down = lens.margin_px(*of_lens, widest)
    return {
        **drawing_of(level == SCALED, now.focal_length, now.focus),
        "focal_length": now.focal_length,
        "focus": now.focus,
        "margin_columns": across,
        "margin_rows": down,
        "largest_blur": blur_of(now),
    }


def aperture_rays(
    rays: Rays,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    back: float,
    lens_rays: int,
) -> Planes:
    """The mean over ``lens_rays`` points of the lens's opening."""
    points = fibonacci_disc(lens_rays)
    return mean_through_lens(rays, points, light_angle, focal_length, aperture, focus, back)


def no_rays(lens_rays: int) -> str:
    return "" if lens_rays else "the blur stands in for rays"


def no_bending(k1: float, bent_rays: bool) -> str:
    if k1 == 0:
        return "k₁ = 0 bends no ray"
    return "" if bent_rays else "the finished picture is bent instead"


def no_warp(k1: float, bent_rays: bool) -> str:
    if k1 == 0:
        return "k₁ = 0 bends nothing"
    return "the rays are bent already" if bent_rays else ""


def no_trim(k1: float, bent_rays: bool) -> str:
    if bent_rays:
        return "the picture has no margin"
    return "" if k1 == 0 else "the lens has fetched what the sensor holds"


def no_enlargement(reduction: int) -> str:
    return "each pixel has its own ray" if reduction == 1 else ""


def no_shot_noise(shot_noise: bool) -> str:
    return "" if shot_noise else "shot noise is switched off"


def no_read_noise(noise_sigma: float) -> str:
    return "σ = 0 adds nothing" if noise_sigma == 0 else ""


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


def expose(irradiance: Planes, exposure: float) -> Planes:
    """Mean electrons; the shutter compensates aperture and focus."""
    return irradiance * np.float32(FULL_WELL_E * 2.0**exposure)


def count_electrons(mean_e: Planes, grain: Grain) -> Planes:
    """Electrons counted: quantiles of the Poisson distribution at the grain's probabilities. Unlike
    with a Poisson sampler, the grain stays the same as the light changes."""
    counted = photon_counting.shot_noise_from_normal(mean_e, grain.shot, FULL_WELL_E)
    return np.asarray(counted, np.float32)


def read(electrons: Planes, grain: Grain, noise_sigma: float) -> Planes:
    """Electrons as the amplifier reports them."""
    return electrons + np.float32(read_noise_e(noise_sigma)) * grain.read


def quantise(electrons: Planes) -> NDArray[np.uint16]:
    """Codes of the converter, which adds no noise: gain and offset."""
    signal = photon_counting.read_out(electrons, ADC, np.random.default_rng(0))
    return photon_counting.quantise(signal, ADC.bits)


def srgb_bytes(linear: Floats) -> NDArray[np.uint8]:
    return to_rgba8(encode_srgb(linear)[None])[0, :, 0]


BYTE_OF_CODE = srgb_bytes(photon_counting.develop(np.arange(2.0**ADC.bits), ADC))
"""(4096,) sRGB byte of each code, without the black level, as a table for all pixels."""
ROOTS = 4096
BYTE_OF_ROOT = srgb_bytes((np.arange(ROOTS + 1) / ROOTS) ** 2)
"""sRGB byte of continuous light, by its square root, in which the curve is nearly straight."""


def encode(codes: NDArray[np.uint16]) -> Raster:
    """The photograph."""
    return of_planes(BYTE_OF_CODE[codes])


def develop_ideal(mean_e: Planes) -> Raster:
    """The photograph of a sensor without noise and quantisation, the reference of the PSNR."""
    root = np.sqrt(np.minimum(mean_e, FULL_WELL_E)) * np.float32(ROOTS / math.sqrt(FULL_WELL_E))
    return of_planes(BYTE_OF_ROOT[np.rint(root).astype(np.uint16)])


STAGES = (
    Stage("pinhole rays", pinhole_rays),
    Stage("bent rays", bend_rays, ("pinhole rays",), neutral=no_bending),
    Stage("surfaces", find_surfaces, ("bent rays",)),
    Stage("light", light_surfaces, ("surfaces",)),
    Stage("defocus", defocus, ("light",), neutral=in_focus),
    Stage("overlay", overlay, ("defocus",)),
    Stage("aperture rays", aperture_rays, ("bent rays",), neutral=no_rays, passes_on="overlay"),
    Stage("enlargement", enlarge, ("aperture rays",), neutral=no_enlargement),
    Stage("lens map", lens.lens_map, ("pinhole rays",), neutral=no_warp),
    Stage("lens distortion", lens.distort_picture, ("enlargement", "lens map"), neutral=no_warp),
    Stage("trimming", lens.trim, ("lens distortion",), neutral=no_trim),
    Stage("vignetting", vignette, ("trimming",)),
    Stage("exposure", expose, ("vignetting",)),
    Stage("grain", draw_grain),
    Stage("shot noise", count_electrons, ("exposure", "grain"), neutral=no_shot_noise),
    Stage("read noise", read, ("shot noise", "grain"), neutral=no_read_noise),
    Stage("quantisation", quantise, ("read noise",)),
    Stage("sRGB", encode, ("quantisation",)),
    Stage("noiseless picture", develop_ideal, ("exposure",)),
)
"""The whole camera, in the order of the light."""


def references(settings: Settings) -> Iterator[Raster]:
    """The noiseless picture seen through more and more points of the lens."""
    focal, aperture, focus = settings.focal_length, settings.aperture, settings.focus
    rays = bend_rays(sensor_rays(focal, focus), settings.k1)
    total = np.zeros((3, ROWS, COLUMNS), np.float32)
    for number, at in enumerate(aperture_grid(REFERENCE_GRID), start=1):
        total += through_lens(rays, at, settings.light_angle, focal, aperture, focus, settings.back)
        light = vignette(total / np.float32(number), focal, focus)
        yield develop_ideal(expose(light, settings.exposure))


def rms_codes(picture: Raster, truth: Raster) -> float:
    """Root mean square of the difference in 8-bit codes; both are opaque."""
    error = np.subtract(picture, truth, dtype=np.float32)
    return math.sqrt(float(np.vdot(error, error)) / (0.75 * error.size))
