"""Blur by the thin lens, after the fact: layers of one depth each, discs of confusion, compositing.

A picture is a stack of premultiplied layers. Each is blurred by the disc that its depth deserves
and laid over what is behind it, so that a sharp object shows up through the soft edge of a near
one. What this leaves out: light that a lens would catch from behind an object in the same layer,
and changes of depth within one object. Rays through the whole aperture would have both.

Pictures are planar: (C, H, W) float32, linear light.

Source: Szeliski, 2nd ed., section 2.2.3; Potmesil and Chakravarty, "A lens and aperture camera
model for synthetic image generation", SIGGRAPH 1981.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

type Planes = NDArray[np.float32]

LARGEST_KERNEL_RADIUS = 3.5
"""Pixels. Wider discs are drawn on a grid reduced by a power of two: the same picture, as a disc
that wide has no finer detail to lose, at a cost that falls with the square of the reduction."""

LARGEST_RADIUS = 1024.0
"""Pixels. The reduced grid reaches as far beyond the picture as the disc: memory sets the limit."""


@dataclass(frozen=True, slots=True)
class Layer:
    """A part of the picture at one depth, premultiplied by its coverage."""

    planes: Planes
    """(4, h, w): red, green, blue times coverage, then coverage in [0, 1]."""
    top: int
    """Row of the picture where the layer's first row lies; may be negative."""
    left: int
    """Column likewise."""
    radius_px: float = 0.0
    """Radius of its disc of confusion."""


def disc_kernel(radius_px: float) -> Planes:
    """(2n+1, 2n+1) weights of a uniform disc, summing to 1.

    Each row holds the exact area of the disc's strip, spread over the row's chord, so that the
    kernel changes smoothly with the radius; at 0 it is a single 1.
    """
    _check_radius("disc_kernel", radius_px)
    reach = math.ceil(radius_px - 0.5) if radius_px > 0.5 else 0
    if reach == 0:
        return np.ones((1, 1), np.float32)
    offsets = np.arange(-reach, reach + 1, dtype=float)
    half_chord = 0.5 * np.diff(_disc_area_up_to(np.append(offsets - 0.5, reach + 0.5), radius_px))
    reached = np.clip(half_chord[:, None] + 0.5 - np.abs(offsets), 0.0, 1.0)
    weights = np.where(half_chord[:, None] < 0.5, 2 * half_chord[:, None] * (offsets == 0), reached)
    return np.asarray(weights / weights.sum(), np.float32)


def _check_radius(function: str, radius_px: float) -> None:
    if not 0 <= radius_px <= LARGEST_RADIUS:
        raise ValueError(f"{function}: radius_px {radius_px!r}; legal: 0 to {LARGEST_RADIUS:g}")


def _disc_area_up_to(height: NDArray[np.floating], radius: float) -> NDArray[np.floating]:
    """Area of a disc between its centre line and a parallel at ``height``; negative below it."""
    sine = np.clip(height / radius, -1.0, 1.0)
    area: NDArray[np.floating] = radius**2 * (np.arcsin(sine) + sine * np.sqrt(1.0 - sine**2))
    return area


def disc_blur(planes: Planes, radius_px: float) -> Planes:
    """``planes`` (C, H, W) convolved with a disc; the picture goes on beyond its edge unchanged.

    Returns the same object where the disc lies within a pixel (radius up to 1/2). Beyond
    `LARGEST_KERNEL_RADIUS` the disc is drawn on a reduced grid; its radius is then shortened so
    that the second moment, the blur's strength, still comes out right.
    """
    _check_radius("disc_blur", radius_px)
    if radius_px <= 0.5:
        return planes
    factor = 1
    while radius_px / factor > LARGEST_KERNEL_RADIUS:
        factor *= 2
    height, width = planes.shape[1:]
    small, halvings = planes, factor.bit_length() - 1
    for _ in range(halvings):
        small = _halve(small)
    # Going down and up again is itself a blur, of variance (factor² - 1) / 2 per axis; a disc of
    # radius r has r² / 4.
    rest = math.sqrt(radius_px**2 - 2.0 * (factor**2 - 1)) / factor
    small = _convolve(small, disc_kernel(rest))
    for _ in range(halvings):
        small = double(small)
    return np.ascontiguousarray(small[:, :height, :width])


def _convolve(planes: Planes, kernel: Planes) -> Planes:
    """Sum of shifted copies: the fastest way for the small kernels used here."""
    reach = kernel.shape[0] // 2
    if reach == 0:
        return planes
    height, width = planes.shape[1:]
    padded = np.pad(planes, ((0, 0), (reach, reach), (reach, reach)), mode="edge")
    total = np.zeros_like(planes)
    for row, column in zip(*np.nonzero(kernel), strict=True):
        total += kernel[row, column] * padded[:, row : row + height, column : column + width]
    return total


def _halve(planes: Planes) -> Planes:
    """Half the grid by weights (1, 3, 3, 1) / 8 each way, the transpose of `double`.

    Unlike means of 2 × 2 pixels these keep every point of light where it is.
    """
    return _halve_last(_halve_last(planes).swapaxes(1, 2)).swapaxes(1, 2)


def _halve_last(planes: Planes) -> Planes:
    padded = np.pad(planes, ((0, 0), (0, 0), (1, 1 + planes.shape[2] % 2)), mode="edge")
    outer = padded[..., 0:-3:2] + padded[..., 3::2]
    inner = padded[..., 1:-2:2] + padded[..., 2:-1:2]
    half: Planes = np.float32(0.125) * outer + np.float32(0.375) * inner
    return half


def double(planes: Planes) -> Planes:
    """Linear interpolation onto twice the grid, the inverse placement of `_halve`."""
    return _double_last(_double_last(planes).swapaxes(1, 2)).swapaxes(1, 2)


def _double_last(planes: Planes) -> Planes:
    near = np.float32(0.75) * planes
    far = np.float32(0.25) * planes
    doubled = np.empty((*planes.shape[:2], 2 * planes.shape[2]), np.float32)
    doubled[..., 0::2] = near
    doubled[..., 1::2] = near
    doubled[..., 2::2] += far[..., :-1]
    doubled[..., 1:-1:2] += far[..., 1:]
    doubled[..., 0] += far[..., 0]
    doubled[..., -1] += far[..., -1]
    return doubled


def blur_by_depth(planes: Planes, radius_px: NDArray[np.floating]) -> Planes:
    """An opaque picture (C, H, W) blurred by a disc whose radius (H, W) varies from place to place.

    The picture is blurred at the radii 1, 2, 4, ... and each pixel mixes the two nearest so that
    its second moment is right. Returns the same object where no radius exceeds half a pixel.
    """
    largest = float(radius_px.max(initial=0.0))
    _check_radius("blur_by_depth", largest)
    if largest <= 0.5:
        return planes
    levels = [0.0, *(2.0**k for k in range(max(0, math.ceil(math.log2(largest))) + 1))]
    square = np.asarray(radius_px, np.float32) ** 2
    total = np.zeros_like(planes)
    for index, level in enumerate(levels):
        weight = _hat(square, [radius**2 for radius in levels], index)
        if weight.any():
            total += weight * disc_blur(planes, level)
    return total


def _hat(value: NDArray[np.float32], knots: list[float], index: int) -> NDArray[np.float32]:
    """Linear interpolation's weight of knot ``index``."""
    rising = np.zeros(len(knots), np.float32)
    rising[index] = 1.0
    return np.interp(value, knots, rising).astype(np.float32)


def blur_layer(layer: Layer) -> Layer:
    """The layer with its disc applied, on a window grown to hold the spread."""
    _check_radius("blur_layer", layer.radius_px)
    if layer.radius_px <= 0.5:
        return layer
    grow = math.ceil(layer.radius_px) + 1
    padded = np.pad(layer.planes, ((0, 0), (grow, grow), (grow, grow)), mode="edge")
    blurred = disc_blur(padded, layer.radius_px)
    return Layer(blurred, layer.top - grow, layer.left - grow, layer.radius_px)


def composite(background: Planes, layers: Iterable[Layer]) -> Planes:
    """``layers``, farthest first, laid over an opaque (3, H, W) background; a new array."""
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
