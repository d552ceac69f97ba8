"""The stages of the JPEG figure: planes → blocks → whole numbers → planes → picture, and bits."""

from dataclasses import replace

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.compression import jpeg
from simulations.models.compression.cosine_transforms import TRANSFORMS
from simulations.models.compression.entropy import size
from simulations.models.compression.zigzag import first_in_order
from simulations.models.error_measures import psnr_db
from simulations.pictures.balloon import HEIGHT, WIDTH, balloon
from simulations.scenes._wipe.wipe import wiped
from simulations.scenes.jpeg.settings import ALL

PHOTOGRAPH_PX = (WIDTH, HEIGHT)


def _original(photograph: Photograph | None) -> Floats:
    """(H, W, 3) sRGB of the balloon, or of the reader's own picture, in whole codes of 255.

    Encoded in float64: powers of float32 differ between machines by enough to move a code.
    """
    if photograph:
        return photograph.codes / 255
    return np.asarray(np.rint(255 * encode_srgb(balloon().astype(np.float64))) / 255)


def _coded(planes: Floats, quality: int, subsampling: str, tier: str) -> jpeg.Coded:
    return jpeg.encode(planes, quality, subsampling, TRANSFORMS[tier])


def _used(coded: jpeg.Coded, first: int) -> jpeg.Coded:
    luma, blue, red = (first_in_order(codes, first) for codes in coded.planes)
    return replace(coded, luma=luma, differences=(blue, red))


def _all_used(first: int) -> str:
    return "all coefficients are used" if first == ALL else ""


def _quality(decoded: Floats, original: Floats) -> float:
    return psnr_db(np.rint(255 * decoded) / 255, original)


def _bytes(picture: Floats) -> Raster:
    return to_rgba8(picture)


def _wiped(before: Raster, after: Raster, original: float) -> Raster:
    return wiped(before, after, original)


def _nothing_to_fill_in(subsampling: str) -> str:
    return "every pixel has kept its own colour" if subsampling == "4:4:4" else ""


STAGES = (
    Stage("original", _original),
    Stage("planes", jpeg.to_planes, ("original",)),
    Stage("coded", _coded, ("planes",)),
    Stage("used", _used, ("coded",), neutral=_all_used),
    Stage("restored", jpeg.restore, ("used",)),
    Stage("full colour", jpeg.fill_in_colour, ("restored",), neutral=_nothing_to_fill_in),
    Stage("decoded", jpeg.from_planes, ("full colour",)),
    Stage("bytes of the original", _bytes, ("original",)),
    Stage("bytes of the decoded", _bytes, ("decoded",)),
    Stage("wipe", _wiped, ("bytes of the original", "bytes of the decoded")),
    Stage("size", size, ("used",)),
    Stage("psnr", _quality, ("decoded", "original")),
)
