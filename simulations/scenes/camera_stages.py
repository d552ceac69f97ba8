"""The complete camera, stage by stage: from rays through the lens to the bytes of a photograph."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Values
from simulations.engine.frame import Raster
from simulations.engine.pipeline import Stage
from simulations.engine.raster import to_rgba8
from simulations.models import optics, projection, sensor
from simulations.models.aperture import fibonacci_disc
from simulations.models.color import encode_srgb_table
from simulations.models.depth_of_field import Planes, blur_by_depth, blur_layer, composite, double
from simulations.models.distortion import Distortion, undistort
from simulations.models.vignetting import vignetting_cos4
from simulations.pictures import still_life, still_life_light, still_life_surfaces
from simulations.pictures.still_life_light import LitScene
from simulations.pictures.still_life_surfaces import Surface

type Floats = NDArray[np.floating]

SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM = 36.0, 24.0
COLUMNS, ROWS = 264, 176
PITCH_MM = SENSOR_WIDTH_MM / COLUMNS
"""A pixel of this picture is as wide as some twenty of a real sensor: coarse enough to be seen."""

FULL_WELL_E = 10_000.0
BLACK_DN = 512.0
ADC = sensor.Sensor(
    full_well_e=FULL_WELL_E,
    read_noise_e=0.0,
    dark_current_e_per_s=0.0,
    gain_e_per_dn=FULL_WELL_E / (4095.0 - BLACK_DN),
    bits=12,
    black_level_dn=BLACK_DN,
)
"""A 12-bit converter whose top code is a full well."""

BASE_SHUTTER_S, BASE_F_NUMBER = 1 / 60, 8.0
"""Shutter and aperture at which a white surface facing the lamp nearly fills the well, at 0 EV."""


TIERS: Mapping[str, Mapping[str, int]] = {
    "draft": {"reduction": 2, "lens_rays": 0},
    "layers": {"reduction": 1, "lens_rays": 0},
    "aperture-rays": {"reduction": 1, "lens_rays": 12},
}
"""Tier to the parameters that it sets: pixels per ray each way, and rays through the lens's opening
in place of a blur (0: blur)."""


@dataclass(frozen=True, slots=True)
class Rays:
    """What each pixel looks along."""

    directions: Floats
    """(rows, columns, 3) in the camera frame, z = 1."""
    valid: NDArray[np.bool_]
    """(rows, columns) false where the lens sends no ray to the pixel."""


def shutter_s(aperture: float, exposure: float) -> float:
    """Exposure time that the automatic chooses: a wider aperture shortens it by the square."""
    return float(BASE_SHUTTER_S * (aperture / BASE_F_NUMBER) ** 2 * 2.0**exposure)


def read_noise_e(noise_sigma: float) -> float:
    """Electrons for σ given in 8-bit codes of linear light: 255 codes are a full well."""
    return noise_sigma / 255.0 * FULL_WELL_E


def blur_px(focal_length: float, aperture: float, focus: float, depth_m: Floats | float) -> Floats:
    """Diameter of the disc of confusion, in pixels, of points ``depth_m`` along the axis."""
    depth_mm = np.asarray(depth_m, float) * 1000.0
    disc = optics.circle_of_confusion_mm(focal_length, aperture, focus * 1000.0, depth_mm)
    return disc / PITCH_MM


@lru_cache(maxsize=4)  # asked for several times a frame
def nearest_depth(focal_length: float, k1: float) -> float:
    """Depth of the nearest thing or spot of floor that the sensor's corners can see, metres."""
    corner = np.array([SENSOR_WIDTH_MM, SENSOR_HEIGHT_MM]) / 2 / focal_length
    (_, down), _ = undistort(corner, Distortion(k1=k1))
    falling = still_life.WORLD_TO_CAMERA[:3, 2] @ (0.0, -down, -1.0)
    floor = still_life.EYE[2] / falling if falling > 0 else math.inf
    return float(min(floor, *(still_life.thing_depth(thing) for thing in still_life.THINGS)))


def largest_blur_px(values: Values) -> float:
    """The widest disc of confusion in the picture; blur grows to both sides of the focus."""
    focal, k1 = values.number("focal_length"), values.number("k1")
    ends = np.array([nearest_depth(focal, k1), still_life.WALL_DISTANCE])
    return float(blur_px(focal, values.number("aperture"), values.number("focus"), ends).max())


def _pinhole(focal_length: float, reduction: int) -> Rays:
    columns, rows = COLUMNS // reduction, ROWS // reduction
    centre = ((columns - 1) / 2, (rows - 1) / 2)
    K = projection.intrinsics(focal_length / (PITCH_MM * reduction), centre)
    return Rays(projection.pixel_rays(K, columns, rows), np.ones((rows, columns), bool))


def _distort(rays: Rays, k1: float) -> Rays:
    """The ray that the lens bends onto each pixel: nothing is resampled, nothing lost."""
    ideal, valid = undistort(rays.directions[..., :2], Distortion(k1=k1))
    return Rays(np.concatenate((ideal, rays.directions[..., 2:]), axis=-1), valid)


def _surfaces(rays: Rays) -> tuple[Surface, ...]:
    return still_life_surfaces.surfaces(still_life.view(rays.directions, rays.valid))


def _light(parts: tuple[Surface, ...], light_angle: float) -> LitScene:
    return still_life_light.light(parts, light_angle)


def _defocus(
    lit: LitScene, focal_length: float, aperture: float, focus: float, reduction: int
) -> LitScene:
    per_radius = 2 * reduction
    discs = blur_px(focal_length, aperture, focus, lit.base_depth)
    base = blur_by_depth(lit.base, discs / per_radius)
    radii = (blur_px(focal_length, aperture, focus, depth) / per_radius for depth in lit.depths)
    layers = tuple(
        blur_layer(replace(layer, radius_px=float(radius)))
        for layer, radius in zip(lit.layers, radii, strict=True)
    )
    return replace(lit, base=base, layers=layers)


def _overlay(lit: LitScene) -> Planes:
    return composite(lit.base, lit.layers)


def through_lens(
    rays: Rays,
    at: tuple[float, float],
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
) -> Planes:
    """The picture seen through one point of the lens: ``at`` = (right, down) in the unit disc."""
    # The picture keeps the scale of a lens focused at infinity; so must the discs of confusion.
    scale = focus / (focus - focal_length / 1000.0)
    radius = scale * focal_length / aperture / 2000.0
    place = (radius * at[0], radius * at[1])
    seen = still_life.view_through(rays.directions, rays.valid, place, focus)
    return _overlay(_light(still_life_surfaces.surfaces(seen), light_angle))


def _aperture_rays(
    _overlaid: Planes,
    rays: Rays,
    light_angle: float,
    focal_length: float,
    aperture: float,
    focus: float,
    lens_rays: int,
) -> Planes:
    """The mean over the lens's opening: edges that hide less than they seem to, and no layers."""
    setting = (light_angle, focal_length, aperture, focus)
    total = np.zeros_like(_overlaid)
    for right, down in fibonacci_disc(lens_rays):
        total += through_lens(rays, (float(right), float(down)), *setting)
    return np.asarray(total / np.float32(lens_rays), np.float32)


def _enlarge(overlaid: Planes, reduction: int) -> Planes:
    for _ in range(reduction.bit_length() - 1):
        overlaid = double(overlaid)
    return overlaid


def _vignette(radiance: Planes, focal_length: float) -> Planes:
    x = (np.arange(COLUMNS) - (COLUMNS - 1) / 2) * PITCH_MM
    y = (np.arange(ROWS) - (ROWS - 1) / 2) * PITCH_MM
    falloff = vignetting_cos4(np.hypot(x, y[:, None]) / focal_length)
    irradiance: Planes = radiance * falloff.astype(np.float32)
    return irradiance


def _expose(irradiance: Planes, exposure: float) -> Planes:
    """Mean electrons; the aperture is made good by the shutter and does not enter."""
    mean_e: Planes = irradiance * np.float32(FULL_WELL_E * 2.0**exposure)
    return mean_e


def _count(mean_e: Planes, shot_noise: bool, new_noise: int) -> Floats:  # noqa: ARG001
    """Electrons counted. The skewed normal keeps its grain as the light changes, as a Poisson
    sampler would not; above 20 electrons the two are hard to tell apart."""
    rng = np.random.default_rng((new_noise, 1))
    return sensor.shot_noise(mean_e, rng, FULL_WELL_E, model="skewed")


def _read(electrons: Floats, noise_sigma: float, new_noise: int) -> Floats:
    """Electrons as the amplifier reports them."""
    amplifier = replace(
        ADC, gain_e_per_dn=1.0, black_level_dn=0.0, read_noise_e=read_noise_e(noise_sigma)
    )
    return sensor.read_out(electrons, amplifier, np.random.default_rng((new_noise, 2)))


def _quantise(electrons: Floats) -> Floats:
    """Linear light in [0, 1] after the converter, black level taken off again."""
    signal = sensor.read_out(electrons, ADC, np.random.default_rng(0))  # noiseless: gain and offset
    codes = sensor.quantise(signal, ADC.bits)
    return sensor.develop(codes.astype(np.float32), ADC)


def _encode(linear: Floats) -> Raster:
    return to_rgba8(encode_srgb_table(linear.transpose(1, 2, 0)))


def _ideal(mean_e: Planes) -> Raster:
    """The photograph of a sensor without noise and without steps: what PSNR is measured against."""
    return _encode(np.minimum(mean_e, FULL_WELL_E) / np.float32(FULL_WELL_E))


def develop_ideal(radiance: Planes, focal_length: float, exposure: float) -> Raster:
    """The noiseless picture of light that has passed the lens."""
    return _ideal(_expose(_vignette(radiance, focal_length), exposure))


def _in_focus(values: Values) -> str:
    largest = largest_blur_px(values)
    return "every circle of confusion is under a pixel" if largest <= 1.0 else ""


def _no_blur(values: Values) -> str:
    return _in_focus(values) or ("rays make the blur" if values["lens_rays"] else "")


def _no_rays(values: Values) -> str:
    return _in_focus(values) or ("" if values["lens_rays"] else "the blur stands in for rays")


STAGES = (
    Stage("pinhole rays", ("focal_length", "reduction"), _pinhole),
    Stage(
        "lens distortion",
        ("k1",),
        _distort,
        ("pinhole rays",),
        lambda values: "k₁ = 0 bends no ray" if values.number("k1") == 0 else "",
    ),
    Stage("surfaces", (), _surfaces, ("lens distortion",)),
    Stage("light", ("light_angle",), _light, ("surfaces",)),
    Stage(
        "defocus",
        ("focal_length", "aperture", "focus", "reduction"),
        _defocus,
        ("light",),
        _no_blur,
    ),
    Stage("overlay", (), _overlay, ("defocus",)),
    Stage(
        "aperture rays",
        ("light_angle", "focal_length", "aperture", "focus", "lens_rays"),
        _aperture_rays,
        ("overlay", "lens distortion"),
        _no_rays,
    ),
    Stage(
        "enlargement",
        ("reduction",),
        _enlarge,
        ("aperture rays",),
        lambda values: "" if values["reduction"] != 1 else "each pixel has its own ray",
    ),
    Stage("vignetting", ("focal_length",), _vignette, ("enlargement",)),
    Stage("exposure", ("exposure",), _expose, ("vignetting",)),
    Stage(
        "shot noise",
        ("shot_noise", "new_noise"),
        _count,
        ("exposure",),
        lambda values: "" if values.toggle("shot_noise") else "shot noise is switched off",
    ),
    Stage(
        "read noise",
        ("noise_sigma", "new_noise"),
        _read,
        ("shot noise",),
        lambda values: "σ = 0 adds nothing" if values.number("noise_sigma") == 0 else "",
    ),
    Stage("quantisation", (), _quantise, ("read noise",)),
    Stage("sRGB", (), _encode, ("quantisation",)),
    Stage("noiseless picture", (), _ideal, ("exposure",)),
)
"""The whole camera, in the order of the light."""
