"""JPEG from a picture to whole numbers and back: luma, coarser colour, blocks, rounding.

The steps of the encoder are: colours to luma and colour differences, the differences averaged over
their cells, each plane through `simulations.models.compression.blocks`. Entropy coding, the last
step, loses nothing; `simulations.models.compression.entropy` estimates its bits. Szeliski, 2nd ed.,
section 2.3.3; ITU-T T.81 and T.871 (JFIF).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.color.ycbcr import rgb_to_ycbcr, ycbcr_to_rgb
from simulations.models.compression.blocks import (
    CHROMINANCE_TABLE,
    LUMINANCE_TABLE,
    Codes,
    Transform,
    block_dct,
    quantisation_table,
    quantise_plane,
    restore_plane,
    round_outwards,
)
from simulations.models.compression.chroma_subsampling import coarsen, subsampling_factor
from simulations.models.compression.chroma_upsampling import refine

type Planes = tuple[Floats, Floats, Floats]
"""Luma, blue difference, red difference, in codes about 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Coded:
    """A picture as JPEG stores it."""

    luma: Codes
    """(block rows, block columns, 8, 8) quantised coefficients; rows are vertical frequencies."""
    differences: tuple[Codes, Codes]
    """Quantised coefficients of the blue and the red difference, on their coarser grid."""
    height: int
    """Rows of the picture."""
    width: int
    """Columns of the picture."""
    quality: int
    """1 to 100: the scale of the tables."""
    subsampling: str
    """A name of `chroma_subsampling.SUBSAMPLING`."""

    @property
    def planes(self) -> tuple[Codes, Codes, Codes]:
        """Luma, blue difference, red difference."""
        return (self.luma, *self.differences)


def tables(quality: int) -> tuple[NDArray[np.integer], NDArray[np.integer]]:
    """Quantisation steps (8, 8) of luma and of the differences."""
    return (
        quantisation_table(LUMINANCE_TABLE, quality),
        quantisation_table(CHROMINANCE_TABLE, quality),
    )


def to_planes(srgb: ArrayLike) -> Floats:
    """Y, Cb and Cr (3, H, W) in whole codes about 0 of a picture (H, W, 3), sRGB in [0, 1]."""
    with np.errstate(over="ignore"):  # planes that overflow are rejected below
        planes = round_outwards(255 * np.moveaxis(rgb_to_ycbcr(srgb), -1, 0))
    planes[0] -= 128
    return planes


def encode(
    planes: ArrayLike, quality: int, subsampling: str = "4:4:4", transform: Transform = block_dct
) -> Coded:
    """Average the colour differences, transform, divide, round.

    Parameters
    ----------
    planes : (3, H, W)
        From `to_planes`.
    quality : 1 (coarsest) to 100 (all steps 1)
    subsampling : "4:4:4", "4:2:2" or "4:2:0"
    transform
        See `blocks.quantise_plane`, whose errors it raises.
    """
    luma, *differences = np.asarray(planes, float)
    factor = subsampling_factor(subsampling)
    fine, coarse = tables(quality)
    blue, red = (quantise_plane(coarsen(plane, factor), coarse, transform) for plane in differences)
    codes = quantise_plane(luma, fine, transform)
    return Coded(
        luma=codes,
        differences=(blue, red),
        height=luma.shape[0],
        width=luma.shape[1],
        quality=quality,
        subsampling=subsampling,
    )


def restore(coded: Coded) -> Planes:
    """Luma (H, W) and the two colour differences on their coarser grid, in codes about 0."""
    height, width = coded.height, coded.width
    rows, columns = subsampling_factor(coded.subsampling)
    fine, coarse = tables(coded.quality)
    luma = restore_plane(coded.luma, fine, height, width)
    blue, red = (
        restore_plane(codes, coarse, -(-height // rows), -(-width // columns))
        for codes in coded.differences
    )
    return luma, blue, red


def fill_in_colour(planes: Planes, subsampling: str, upsampling: str) -> Planes:
    """The planes of `restore` with the differences interpolated to every pixel: all three (H, W).

    ``upsampling`` is one of `chroma_upsampling.METHODS`; at 4:4:4 all of them change nothing.
    """
    luma, *differences = planes
    factor = subsampling_factor(subsampling)
    blue, red = (refine(plane, factor, luma, upsampling) for plane in differences)
    return luma, blue, red


def from_planes(planes: Planes) -> Floats:
    """The inverse of `to_planes`: (H, W, 3) sRGB, clipped to [0, 1]."""
    luma, blue, red = planes
    ycbcr = np.stack([luma + 128, blue, red], axis=-1) / 255
    return np.clip(ycbcr_to_rgb(ycbcr), 0, 1)
