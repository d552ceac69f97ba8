"""The stages of the Bayer figure: picture → mosaic → demosaic → display → error.

Picture, mosaic and reconstruction are in linear light, which a sensor counts. The error is that of
encoded values, which a display shows.
"""

from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.bayer import mosaic, through_filters
from simulations.models.sensor.demosaicing import demosaic
from simulations.models.sensor.shared_detail import shared_detail
from simulations.pictures.balloon import HEIGHT, WHOLE, WIDTH
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes._wipe.wipe import wiped

type Picture = Floats

PATTERN = "RGGB"
CROP = 8
"""Border in pixels, left out of the error measures."""
AMPLIFY = 4
"""Amplification of the error picture: a quarter of the range is shown as full."""
PHOTOGRAPH_PX = (WIDTH, HEIGHT)


@dataclass(frozen=True, slots=True)
class Errors:
    """The errors of a reconstruction."""

    absolute: Picture
    """(H, W, 3) in [0, 1], of encoded values."""
    psnr_db: float
    """PSNR as displayed."""
    light_psnr_db: float
    """PSNR before the display's curve."""
    worst_codes: int
    """Largest error in codes of 255, without the border."""
    worst_at: tuple[int, int]
    """Row and column of it."""


def compare(truth: Picture, guess: Picture, shown_truth: Picture, shown: Picture) -> Errors:
    """Errors of a picture in linear light (H, W, 3), and of the same picture encoded."""
    absolute = np.abs(shown - shown_truth)
    inner = absolute[CROP:-CROP, CROP:-CROP].max(axis=2)
    row, column = divmod(int(inner.argmax()), inner.shape[1])
    return Errors(
        absolute,
        psnr_db(shown, shown_truth, crop=CROP),
        psnr_db(guess, truth, crop=CROP),
        round(255 * float(inner.max())),
        (row + CROP, column + CROP),
    )


def rms_codes(errors: Errors) -> Picture:
    """RMS error of each colour (3,) in codes of 255, inside the border."""
    inner = errors.absolute[CROP:-CROP, CROP:-CROP].astype(np.float64)
    return 255.0 * np.sqrt(np.mean(inner * inner, axis=(0, 1)))


def _reconstruct(cfa: Picture, method: str) -> Picture:
    """The full picture in linear light, clipped to [0, 1]."""
    return np.clip(demosaic(cfa, PATTERN, method), 0, 1)


def _seen(picture: str, photograph: Photograph | None) -> Picture:
    """The picture in linear light, float32."""
    if photograph:
        return decode_srgb(np.float32(1 / 255) * photograph.codes)
    return SUBJECTS[picture].draw(WHOLE)


def _cells(cfa: Picture) -> Raster:
    """Each cell in the colour of its filter."""
    return to_rgba8(encode_srgb(through_filters(cfa, PATTERN)))


def _amplified(errors: Errors) -> Raster:
    return to_rgba8(AMPLIFY * errors.absolute)


def _mosaic(picture: Floats) -> Floats:
    """The mosaic (H, W), one colour per cell."""
    return mosaic(picture, PATTERN)


def _bytes(shown: Floats) -> Raster:
    """An encoded picture (H, W, 3) for the page."""
    return to_rgba8(shown)


def _wiped(reconstruction: Raster, cells: Raster, split: float) -> Raster:
    return wiped(reconstruction, cells, split)


def _no_mosaic(split: float) -> str:
    return "the whole picture is demosaiced" if split == 1 else ""


def _twice(shown: Raster) -> Raster:
    """Two samples per cell, as the fine pattern would beat with the screen's pixels."""
    return shown.repeat(2, axis=0).repeat(2, axis=1)


STAGES = (
    Stage("picture", _seen),
    Stage("mosaic", _mosaic, ("picture",)),
    Stage("shown picture", encode_srgb, ("picture",)),
    Stage("shared detail", shared_detail, ("picture",)),
    Stage("demosaic", _reconstruct, ("mosaic",)),
    Stage("display", encode_srgb, ("demosaic",)),
    Stage("error", compare, ("picture", "demosaic", "shown picture", "display")),
    # As bytes for the page, which stay cached while the loupe moves.
    Stage("bytes of the mosaic", _cells, ("mosaic",)),
    Stage("bytes of the reconstruction", _bytes, ("display",)),
    Stage("wipe", _wiped, ("bytes of the reconstruction", "bytes of the mosaic")),
    Stage("doubled", _twice, ("wipe",), neutral=_no_mosaic),
    Stage("bytes of the error", _amplified, ("error",)),
)
