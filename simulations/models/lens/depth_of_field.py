"""Blur by the thin lens as post-processing: layers of one depth each, blurred and composited.

A picture is a stack of premultiplied layers. Each is blurred by the disc of confusion for its depth
and composited over the layers behind it, so that a sharp object is visible through the soft edge of
a near one. This ignores light from behind an object in the same layer, and changes of depth within
one object. Rays through the whole aperture include both.

Pictures are planar: (C, H, W) float32, linear light.

Source: Szeliski, 2nd ed., section 2.2.3; Potmesil and Chakravarty, "A lens and aperture camera
model for synthetic image generation", SIGGRAPH 1981.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, Planes
from simulations.models.lens.disc_blur import NARROW_RADIUS, check_radius, disc_blur, extended

type Blur = Callable[[Planes, float], Planes]
"""A function that convolves a picture (C, H, W) with a disc of a radius in pixels; returns it
unchanged for 0."""


@dataclass(frozen=True, slots=True)
class Layer:
    """A part of the picture at one depth, premultiplied by its coverage."""

    planes: Planes
    """(4, h, w): red, green, blue times coverage, then coverage in [0, 1]."""
    top: int
    """Row of the picture at the layer's first row; may be negative."""
    left: int
    """Column of the picture at the layer's first column; may be negative."""
    radius_px: float = 0.0
    """Radius of the disc of confusion."""


def blur_by_depth(planes: Planes, radius_px: Floats, blur: Blur = disc_blur) -> Planes:
    """An opaque picture (C, H, W) blurred by a disc whose radius (H, W) varies from place to place.

    The picture is blurred at the largest radius, half of it, a quarter, ... and each pixel mixes
    the two nearest so that its second moment is right, along each axis to 0.12 px²: the most
    blurred pixels, often of a wall of one depth, have their exact disc. Returns the same object
    where every radius is 0.
    """
    smallest, largest = float(radius_px.min(initial=0.0)), float(radius_px.max(initial=0.0))
    for radius in (smallest, largest):
        check_radius(radius)
    if largest == 0:
        return planes
    levels = blur_levels(largest)
    square = np.asarray(radius_px, np.float32) ** 2
    total = np.zeros_like(planes)
    for index, level in enumerate(levels):
        weight = _hat(square, [radius**2 for radius in levels], index)
        if weight.any():
            total += weight * blur(planes, level)
    return total


def blur_levels(largest: float) -> list[float]:
    """Radii from 0 to ``largest``; from `NARROW_RADIUS` on, each is at most twice the last."""
    lowest = min(NARROW_RADIUS, largest)
    halvings = max(0, math.ceil(math.log2(largest / (2 * NARROW_RADIUS))))
    wider = (largest / 2**k for k in range(halvings, -1, -1))
    return [0.0, lowest, *(radius for radius in wider if radius > lowest)]


def _hat(value: NDArray[np.float32], knots: list[float], index: int) -> NDArray[np.float32]:
    """Linear interpolation's weight of knot ``index``."""
    rising = np.zeros(len(knots), np.float32)
    rising[index] = 1.0
    return np.interp(value, knots, rising).astype(np.float32)


def blur_layer(layer: Layer, blur: Blur = disc_blur) -> Layer:
    """The layer convolved with its disc, in a window enlarged by the spread."""
    check_radius(layer.radius_px)
    if layer.radius_px == 0:
        return layer
    grow = math.ceil(layer.radius_px) + 1
    blurred = blur(extended(layer.planes, grow), layer.radius_px)
    return Layer(blurred, layer.top - grow, layer.left - grow, layer.radius_px)


def composite(background: Planes, layers: Iterable[Layer]) -> Planes:
    """Composite ``layers``, farthest first, over an opaque (3, H, W) background; a new array."""
    picture = background.copy()
    height, width = picture.shape[1:]
    for layer in layers:
        rows, columns = layer.planes.shape[1:]
        top, bottom = max(layer.top, 0), min(layer.top + rows, height)
        left, right = max(layer.left, 0), min(layer.left + columns, width)
        if top >= bottom or left >= right:
            continue
        part = layer.planes[
            :, top - layer.top : bottom - layer.top, left - layer.left : right - layer.left
        ]
        under = picture[:, top:bottom, left:right]
        under *= 1.0 - part[3]
        under += part[:3]
    return picture
