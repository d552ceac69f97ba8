"""The colour spaces of the CIE: XYZ, luminance and L*a*b*, from linear RGB and back.

Colours are arrays (..., 3). Values beyond the floats' range become infinite or NaN, as in `srgb`.
Szeliski, 2nd ed., section 2.3.2; CIE 15:2004.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_colours, through_matrix
from simulations.models.require import require

SRGB_PRIMARIES_XY = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
"""CIE xy chromaticities of the red, green and blue of sRGB (ITU-R BT.709)."""
D65_XY = (0.3127, 0.3290)
"""CIE xy chromaticity of average daylight, the white of sRGB."""


def rgb_to_xyz_matrix(
    primaries_xy: ArrayLike = SRGB_PRIMARIES_XY, white_xy: ArrayLike = D65_XY
) -> Floats:
    """The (3, 3) matrix from linear RGB to CIE XYZ, built from the display's own colours.

    The columns are the primaries, each scaled so that RGB = (1, 1, 1) is the white with
    Y = 1. Raises `ValueError` where the three primaries lie on one line.
    """
    primaries = np.asarray(primaries_xy, np.float64)
    require("primaries", primaries.shape, primaries.shape == (3, 2), "(3, 2)")
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


def xyz_to_linear_rgb(xyz: ArrayLike) -> Floats:
    """CIE XYZ to linear sRGB; colours outside the display's triangle get negative parts."""
    return through_matrix(_RGB_FROM_XYZ, xyz)


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
