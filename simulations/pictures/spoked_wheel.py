"""A coach's wheel as a film frame records it: exact coverage, and exact blur of turning spokes.

Along a circle of radius r the spokes are a row of equal bars. A pixel records their mean over its
width on that circle and over the angle swept while the shutter is open. Both means are differences
of an integral in closed form, so that a blur over many spokes costs no more than a sharp picture.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.engine.raster import opaque
from simulations.models.arrays import Floats, Mask, centred
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.require import as_whole
from simulations.pictures.stagecoach import stagecoach

WIDTH, HEIGHT = 480, 360
RADIUS = 138.0  # outer edge of the rim, pixels
RIM, HUB, SPOKE = 18.0, 21.0, 9.75  # width of the rim, radius of the hub, width of a spoke, pixels

TYRE = 5.0  # width of the iron around the rim, pixels
WOOD, IRON = np.array([[0.85, 0.55, 0.12], [0.05, 0.05, 0.055]], np.float32)
"""Linear light of the painted wheel and of its tyre."""

NARROWEST = 1e-5  # least width of a mean, in spacings, to avoid division by zero


@dataclass(frozen=True, slots=True, kw_only=True)
class Canvas:
    """The parts of the picture that depend on no parameter."""

    between: Mask
    """(H, W) pixels that lie, at least in part, between hub and rim."""
    angle_rad: Floats
    """(n,) angles of those pixels, clockwise from the right."""
    radius: Floats
    """(n,) radii of those pixels, at least half of the hub's; in pixels."""
    solid: Floats
    """(H, W) share of each pixel that rim or hub cover."""
    behind: Floats
    """(3, n) linear light behind the spokes at those pixels, with rim and hub over it."""
    still: NDArray[np.uint8]
    """(H, W, 4) bytes of all without the spokes."""


def build_canvas() -> Canvas:
    """The `Wheel`: angles, radii and the parts that do not change as the wheel turns."""
    x = centred(WIDTH)
    y = centred(HEIGHT)[:, None]
    radius = np.hypot(x, y)
    rim = _inside(radius, RADIUS) - _inside(radius, RADIUS - RIM)
    solid = rim + _inside(radius, HUB)
    between = (radius > HUB - 1) & (radius < RADIUS - RIM + 1)
    angle = np.arctan2(y, x)
    light = stagecoach(WIDTH, HEIGHT)
    tyre = _inside(radius, RADIUS) - _inside(radius, RADIUS - TYRE)
    for cover, colour in ((solid, WOOD), (tyre, IRON)):
        light += cover[..., None].astype(np.float32) * (colour - light)
    still = opaque(encode_srgb_codes(light))
    radii = np.maximum(radius[between], HUB / 2)
    return Canvas(
        between=between,
        angle_rad=angle[between],
        radius=radii,
        solid=solid,
        behind=np.ascontiguousarray(light[between].T),
        still=still,
    )


def _inside(radius: Floats, edge: float) -> Floats:
    """Share of each pixel within a circle, to the accuracy of a straight edge."""
    return np.clip(edge - radius + 0.5, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Bars:
    """The spokes at each pixel between hub and rim; lengths are in spacings between spokes."""

    place: Floats
    """(n,) from the middle of the first spoke as the shutter opens, clockwise."""
    duty: Floats
    """(n,) width of a spoke."""
    pixel: Floats
    """(n,) width of the pixel."""
    swept: float
    """Rotation of the spokes while the shutter is open, of either sign."""


type Exposure = Callable[[Bars], Floats]
"""The share (n,) of each pixel that spokes cover, on average over the exposure."""


def bars(canvas: Canvas, spokes: int, first_angle_rad: float, swept_rad: float) -> Bars:
    """The first spoke starts at ``first_angle_rad``, clockwise from the right; all turn as far."""
    spokes = as_whole("spokes", spokes, 1)
    spacing = 2 * np.pi / spokes
    arc = canvas.radius * spacing
    place = (canvas.angle_rad - first_angle_rad) / spacing
    return Bars(place, SPOKE / arc, 1.0 / arc, swept_rad / spacing)


def exposure_mean(row: Bars) -> Floats:
    """The exact mean over the exposure."""
    if row.swept == 0.0:
        return at_moment(row, 0.0)
    middle = row.place - 0.5 * row.swept
    return mean_coverage(middle, row.duty, row.pixel, abs(row.swept))


def at_moment(row: Bars, time: Floats | float) -> Floats:
    """The spokes' share of each pixel at one moment, 0 to 1, or at a moment (n,) for each."""
    place, half_pixel = row.place - row.swept * time, 0.5 * row.pixel
    bar = np.minimum(row.duty, 1.0)
    covered = _integrated(place + half_pixel, bar) - _integrated(place - half_pixel, bar)
    return covered / row.pixel


def render(
    canvas: Canvas,
    spokes: int,
    first_angle_rad: float,
    swept_rad: float,
    exposure: Exposure = exposure_mean,
) -> NDArray[np.uint8]:
    """Picture (H, W, 4) of the wheel, sRGB bytes. Wood and background mix in linear light.

    The first spoke starts at ``first_angle_rad``, clockwise from the right, and all turn by
    ``swept_rad``, of either sign, while the shutter is open.
    """
    share = exposure(bars(canvas, spokes, first_angle_rad, swept_rad))
    cover = (share * (1.0 - canvas.solid[canvas.between])).astype(np.float32)
    picture = canvas.still.copy()
    for channel, (wood, behind) in enumerate(zip(WOOD, canvas.behind, strict=True)):
        light = behind + cover * (wood - behind)
        picture[canvas.between, channel] = encode_srgb_codes(light)
    return picture


def mean_coverage(place: Floats, duty: ArrayLike, pixel: ArrayLike, swept: float) -> Floats:
    """Share (n,) of a pixel that bars cover, on average over the exposure.

    All lengths are in spacings of the bars: ``place`` (n,) from the middle of a bar, ``duty``
    the width of a bar, ``pixel`` of a pixel, ``swept`` the path of the bars.
    """
    bar = np.minimum(np.asarray(duty, float), 1.0)
    half_pixel = 0.5 * np.maximum(np.asarray(pixel, float), NARROWEST)
    half_swept = 0.5 * max(swept, NARROWEST)
    outer, inner = half_pixel + half_swept, half_pixel - half_swept
    second_difference = (
        _twice_integrated(place + outer, bar)
        - _twice_integrated(place + inner, bar)
        - _twice_integrated(place - inner, bar)
        + _twice_integrated(place - outer, bar)
    )
    share: Floats = second_difference / (4.0 * half_pixel * half_swept)
    return np.clip(share, 0.0, 1.0)


def _integrated(place: Floats, bar: Floats) -> Floats:
    """Antiderivative of bars of width ``bar`` about all whole numbers."""
    whole = np.rint(place)
    return bar * whole + np.clip(place - whole, -0.5 * bar, 0.5 * bar)


def _twice_integrated(place: Floats, bar: Floats) -> Floats:
    """Second antiderivative of bars of width ``bar`` about all whole numbers."""
    whole = np.rint(place)
    aside = place - whole
    near = np.minimum(np.abs(aside), 0.5 * bar)
    # Within a period: |v|²/2 on the bar, then on along the tangent.
    within = near * (np.abs(aside) - 0.5 * near)
    return bar * whole * (0.5 * whole + aside) + within
