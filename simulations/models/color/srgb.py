"""Colour: the sRGB curve, luminance and CIE XYZ, L*a*b*, YCbCr, white balance.

Colours are arrays (..., 3). *Linear* values are proportional to light; *sRGB* values are
encoded for a display (IEC 61966-2-1). Both lie in [0, 1] for colours that a display shows.

What is beyond all numbers becomes infinite, and what is undefined NaN, without a warning: these
functions run on pictures, and `simulations.engine.raster.to_rgba8` cleans those up at the end.
Szeliski, 2nd ed., section 2.3.2.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_colours, as_floats
from simulations.models.require import require, require_positive

SRGB_PRIMARIES_XY = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
"""CIE xy chromaticities of the red, green and blue of sRGB (ITU-R BT.709)."""
D65_XY = (0.3127, 0.3290)
"""CIE xy chromaticity of average daylight, the white of sRGB."""

YCBCR_FROM_RGB = np.array(
    [
        [0.299, 0.587, 0.114],
        [-0.299 / 1.772, -0.587 / 1.772, 0.5],
        [0.5, -0.587 / 1.402, -0.114 / 1.402],
    ]
)
"""Full-range luma and colour differences of JPEG (ITU-R BT.601, JFIF 1.02)."""


def encode_srgb(linear: ArrayLike) -> Floats:
    """Linear light (...) as sRGB values: a straight toe, then the power 1/2.4.

    Exact on [0, 1]. Values outside are extended: above 1 by the same power, below 0 by odd
    symmetry, so that out-of-gamut colours survive a round trip. NaN stays NaN.
    """
    x = as_floats(linear)
    size = np.abs(x)
    curve = 1.055 * np.maximum(size, 0.0031308) ** (1 / 2.4) - 0.055
    toe = 12.92 * np.minimum(size, 0.0031308)
    return np.copysign(np.where(size <= 0.0031308, toe, curve), x)


def decode_srgb(srgb: ArrayLike) -> Floats:
    """sRGB values as linear light; the inverse of `encode_srgb`."""
    x = as_floats(srgb)
    size = np.abs(x)
    with np.errstate(over="ignore"):
        curve = ((np.maximum(size, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.copysign(np.where(size <= 0.04045, size / 12.92, curve), x)


def encode_gamma(linear: ArrayLike, gamma: float = 2.2) -> Floats:
    """The common stand-in for sRGB, ``linear^(1/gamma)``: up to 8.5 codes of 255 off.

    Negative light is taken as none. Raises `ValueError` for a gamma of 0 or less.
    """
    require_positive("gamma", gamma)
    with np.errstate(over="ignore"):
        return np.maximum(as_floats(linear), 0) ** (1 / gamma)


_TABLE = encode_srgb(np.linspace(0.0, 1.0, 65536)).astype(np.float32)


def encode_srgb_table(linear: ArrayLike) -> NDArray[np.float32]:
    """`encode_srgb` from a table of 65 536 entries: quicker, for pictures.

    Clips to [0, 1] and takes NaN as 0. In the shadows, where the curve is steepest, an entry
    stands for 0.05 codes of 255: the table is off by half of that at most.
    """
    place = np.asarray(np.maximum(as_floats(linear), 0))  # from here on in place: a new array
    if np.isnan(np.max(place, initial=0)):  # a cast of NaN to an index would be undefined
        np.fmax(place, 0, out=place)
    np.minimum(place, 1, out=place)
    place *= len(_TABLE) - 1
    place += 0.5
    return _TABLE[place.astype(np.intp)]  # int32 would be converted


def rgb_to_xyz_matrix(
    primaries_xy: ArrayLike = SRGB_PRIMARIES_XY, white_xy: ArrayLike = D65_XY
) -> Floats:
    """The (3, 3) matrix from linear RGB to CIE XYZ, built from the display's own colours.

    The columns are the primaries, each scaled so that RGB = (1, 1, 1) is the white with
    Y = 1. Raises `ValueError` where the three primaries lie on one line.
    """
    primaries = np.asarray(primaries_xy, np.float64)
    if primaries.shape != (3, 2):
        raise ValueError(f"primaries of shape {primaries.shape}; legal: (3, 2)")
    columns = np.stack([_xyz_of(xy) for xy in primaries], axis=1)
    if abs(np.linalg.det(columns)) < 1e-9:
        raise ValueError(f"primaries {primaries_xy!r}; legal: three that span a triangle")
    scale = np.linalg.solve(columns, _xyz_of(np.asarray(white_xy, np.float64)))
    return columns * scale


def _xyz_of(xy: Floats) -> Floats:
    """XYZ of a chromaticity at Y = 1. Primaries may lie outside all colours, at a negative y."""
    if xy.shape != (2,) or not (np.isfinite(xy).all() and abs(xy[1]) > 1e-6):
        raise ValueError(f"chromaticity {xy.tolist()}; legal: x, y finite, y not 0")
    x, y = xy
    return np.array([x / y, 1.0, (1 - x - y) / y])


_XYZ_FROM_RGB = rgb_to_xyz_matrix()
_RGB_FROM_XYZ = np.linalg.inv(_XYZ_FROM_RGB)
_RGB_FROM_YCBCR = np.linalg.inv(YCBCR_FROM_RGB)


def linear_rgb_to_xyz(linear: ArrayLike) -> Floats:
    """Linear sRGB to CIE XYZ (D65; white has Y = 1)."""
    return _apply(_XYZ_FROM_RGB, linear)


def xyz_to_linear_rgb(xyz: ArrayLike) -> Floats:
    """CIE XYZ to linear sRGB; colours outside the display's triangle get negative parts."""
    return _apply(_RGB_FROM_XYZ, xyz)


def luminance(linear_rgb: ArrayLike) -> Floats:
    """Relative luminance Y (...) of linear RGB: 0.2126 R + 0.7152 G + 0.0722 B."""
    rgb = as_colours(linear_rgb)
    with np.errstate(over="ignore", invalid="ignore"):
        return rgb @ _XYZ_FROM_RGB[1].astype(rgb.dtype)


def xyz_to_lab(xyz: ArrayLike, white_xy: ArrayLike = D65_XY) -> Floats:
    """CIE XYZ to L*a*b*: lightness 0 to 100, then green-red and blue-yellow.

    The cube root becomes a line below (6/29)^3, so that black and negative values are safe.
    """
    delta = 6 / 29
    white = _xyz_of(np.asarray(white_xy, np.float64))
    require("white", np.asarray(white_xy), (white > 0).all(), "x, y, 1 − x − y above 0")
    with np.errstate(over="ignore", invalid="ignore"):
        ratio = as_colours(xyz) / white
        f = np.where(ratio > delta**3, np.cbrt(ratio), ratio / (3 * delta**2) + 4 / 29)
        fx, fy, fz = f[..., 0], f[..., 1], f[..., 2]
        return np.stack([116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)], axis=-1)


def linear_rgb_to_lab(linear: ArrayLike) -> Floats:
    """Linear sRGB to CIE L*a*b* under D65."""
    return xyz_to_lab(linear_rgb_to_xyz(linear))


def rgb_to_ycbcr(srgb: ArrayLike) -> Floats:
    """sRGB-encoded values to luma in [0, 1] and colour differences in [-0.5, 0.5]."""
    return _apply(YCBCR_FROM_RGB, srgb)


def ycbcr_to_rgb(ycbcr: ArrayLike) -> Floats:
    """The inverse of `rgb_to_ycbcr`."""
    return _apply(_RGB_FROM_YCBCR, ycbcr)


def white_balance(linear: ArrayLike, illuminant_rgb: ArrayLike) -> Floats:
    """Divide out the colour of the light, keeping green as it is (von Kries, in camera RGB).

    Raises `ValueError` if the light lacks a channel altogether: nothing can restore it.
    """
    light = np.asarray(illuminant_rgb, np.float64)
    if light.shape != (3,) or not np.all((light > 0) & np.isfinite(light)):
        raise ValueError(f"illuminant {light.tolist()}; legal: three finite numbers above 0")
    rgb = as_colours(linear)
    with np.errstate(over="ignore", invalid="ignore"):
        return rgb * (light[1] / light).astype(rgb.dtype)


def grey_world(linear: ArrayLike) -> Floats:
    """Estimate of the light's colour, (3,): the mean of the picture, were the world grey."""
    colours = as_colours(linear)
    if not colours.size:
        raise ValueError(f"picture of shape {colours.shape}; legal: one pixel or more")
    with np.errstate(over="ignore", invalid="ignore"):
        return colours.reshape(-1, 3).mean(axis=0)


def _apply(matrix: Floats, colours: ArrayLike) -> Floats:
    values = as_colours(colours)
    with np.errstate(over="ignore", invalid="ignore"):
        return values @ matrix.T.astype(values.dtype)
