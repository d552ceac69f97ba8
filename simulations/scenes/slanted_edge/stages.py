"""The stages of the slanted edge: a picture, the rectangle, and the MTF measured in it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from simulations.engine.photograph import Codes, Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.aliasing import filter_and_sample, gaussian_kernel
from simulations.models.sampling.slanted_edge import (
    FREQUENCIES,
    EdgeReading,
    HalfContrast,
    measure,
)
from simulations.models.sampling.slanted_edge_file import light_of_codes
from simulations.models.sampling.slanted_edge_line import UnfitEdgeError
from simulations.models.sampling.slanted_edge_picture import edge_picture, edge_transfer
from simulations.models.sampling.slanted_edge_pixels import EdgePixels, locate_edge
from simulations.scenes.slanted_edge.rectangle import HEIGHT, WIDTH, Box, box_in, kept_in

ROWS, COLUMNS = 120, 160
"""Size of the simulated picture."""
DARK, STEP = 0.12, 0.7
"""Light of its dark side, and how much lighter the other is: room for halos at both ends."""
HALO_PX = 1.0
"""Standard deviation of the blur whose difference from the picture sharpens it."""
WAVELENGTH_UM = 0.55
MOST_SHOWN = 1200
"""Largest side in px at which a photograph is shown. It is measured in full."""


@dataclass(frozen=True, slots=True)
class Sharpness:
    """What an edge says, or why it says nothing."""

    reading: EdgeReading | None
    half: HalfContrast
    contrast: Floats
    """(51,) MTF at `FREQUENCIES`; NaN where there is none."""
    error: Floats
    """(51,) its standard error."""
    refusal: str = ""
    """What is wrong with the rectangle; empty if nothing is."""


@dataclass(frozen=True, slots=True)
class Place:
    """A rectangle that was kept, and what its edge says."""

    box: Box
    sharpness: Sharpness


def lens_factor(frequency: Floats, aperture: float, pitch: float) -> Floats:
    """Factor (...) of the lens on waves (...) in cycles per pixel."""
    return lens_transfer(1000.0 / pitch * frequency, WAVELENGTH_UM, aperture)


def _light(angle: float, aperture: float, pitch: float) -> Floats:
    """(120, 160) light in each pixel, without noise."""
    edge = edge_picture(
        ROWS, COLUMNS, math.radians(angle), lambda f: lens_factor(f, aperture, pitch)
    )
    return DARK + STEP * edge


def _simulated(light: Floats, noise: float, sharpening: float) -> Codes:
    """(120, 160, 3) the file; its dice fall alike each time."""
    taken = light + np.random.default_rng(0).normal(0.0, 0.01 * noise * STEP, light.shape)
    soft = filter_and_sample(taken, 1, gaussian_kernel(HALO_PX))
    taken += sharpening * (taken - soft)
    return to_rgba8(encode_srgb(np.clip(taken, 0.0, 1.0)))[..., :3]


def _own(photograph: Photograph) -> Codes:
    """(H, W, 3) the reader's file."""
    return photograph.codes


def _none_given(photograph: Photograph | None) -> str:
    return "" if photograph else "no photograph was chosen"


def _shown(codes: Codes) -> Codes:
    """(H', W', 4) the picture in the panel, on a transparent ground: small enough to be painted."""
    apart = math.ceil(max(codes.shape[:2]) / MOST_SHOWN)
    small = codes if apart == 1 else _reduced(codes, apart)
    height, width = small.shape[:2]
    wide, high = (
        max(width, round(height * WIDTH / HEIGHT)),
        max(height, round(width * HEIGHT / WIDTH)),
    )
    shown = np.zeros((high, wide, 4), np.uint8)
    top, left = (high - height) // 2, (wide - width) // 2
    shown[top : top + height, left : left + width, :3] = small
    shown[top : top + height, left : left + width, 3] = 255
    return shown


def _reduced(codes: Codes, apart: int) -> Codes:
    """Means over squares of so many pixels a side."""
    height, width = (side // apart * apart for side in codes.shape[:2])
    total = np.zeros((height // apart, width // apart, 3), np.uint16)
    for down in range(apart):
        for across in range(apart):
            total += codes[down:height:apart, across:width:apart]
    return (total // (apart * apart)).astype(np.uint8)


def _box(codes: Codes, x: float, y: float, width: float, height: float) -> Box:
    return box_in((codes.shape[1], codes.shape[0]), (x, y), (width, height))


def _pixels(codes: Codes, box: Box, response: str) -> EdgePixels | str:
    """The pixels of the edge in the rectangle, or what is wrong with it."""
    cut = codes[box.top : box.bottom, box.left : box.right]
    try:
        return locate_edge(light_of_codes(cut, srgb=response == "srgb"))
    except UnfitEdgeError as problem:
        return str(problem)


def _sharpness(pixels: EdgePixels | str) -> Sharpness:
    unknown = np.full(FREQUENCIES.shape, np.nan)
    nothing = Sharpness(None, HalfContrast(np.nan, np.nan), unknown, unknown)
    if isinstance(pixels, str):
        return replace(nothing, refusal=pixels)
    try:
        reading = measure(pixels)
    except UnfitEdgeError as problem:
        return replace(nothing, refusal=str(problem))
    return Sharpness(reading, reading.half_contrast(), *reading.transfer(FREQUENCIES))


def _kept_places(codes: Codes, kept: str, response: str) -> tuple[Place, ...]:
    boxes = kept_in((codes.shape[1], codes.shape[0]), kept)
    return tuple(Place(box, _sharpness(_pixels(codes, box, response))) for box in boxes)


def _true(angle: float, aperture: float, pitch: float, photograph: Photograph | None) -> Floats:
    """(51,) MTF by the formulae of lens and pixel; NaN for a photograph."""
    if photograph is not None:
        return np.full(FREQUENCIES.shape, np.nan)
    pixel = edge_transfer(FREQUENCIES, math.radians(angle))
    return np.abs(lens_factor(FREQUENCIES, aperture, pitch) * pixel)


STAGES = (
    Stage("light", _light),
    Stage("simulated", _simulated, ("light",)),
    Stage("codes", _own, neutral=_none_given, passes_on="simulated"),
    Stage("shown", _shown, ("codes",)),
    Stage("box", _box, ("codes",)),
    Stage("pixels", _pixels, ("codes", "box")),
    Stage("sharpness", _sharpness, ("pixels",)),
    Stage("places", _kept_places, ("codes",)),
    Stage("true", _true),
)
