"""Photographs of even light for the noise figure, and the data sheet that this Python makes of
them."""

from collections.abc import Sequence

import numpy as np
from support.dng import dng
from support.flat_fields import as_srgb, light_of, pairs_of

from simulations.engine.photograph import Mosaic, Photograph
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.scenes.photon_transfer.frames import read
from simulations.scenes.photon_transfer.results import sheet
from simulations.scenes.photon_transfer.scene import SCENE

LEVELS = (20.0, 60.0, 110.0, 170.0)
PHOTOGRAPHS = [
    as_srgb(light_of(level, 2 * k + i)) for k, level in enumerate(LEVELS) for i in (0, 1)
]
"""Four pairs."""
BLACK = (64.0, 70.0, 67.0, 73.0)
RAW = [
    np.minimum(frame + np.tile(np.array([[0, 6], [3, 9]], np.uint16), (75, 75)), 4095)
    for pair in pairs_of(150, 5, count=8)[1:5]
    for frame in pair
]
"""Four pairs of the cells of a raw file, each colour above its own black."""


def dng_files() -> list[bytes]:
    """These cells as DNG."""
    return [dng(codes, black=BLACK, exposure_s=0.01 * (k // 2)) for k, codes in enumerate(RAW, 2)]


def sheet_of_photographs() -> list[list[str]]:
    return _lines([Photograph(index, codes) for index, codes in enumerate(PHOTOGRAPHS)])


def sheet_of_raw() -> list[list[str]]:
    picture = np.zeros((8, 8, 3), np.uint8)
    mosaics = [Mosaic(codes, "RGGB", BLACK, 4095) for codes in RAW]
    return _lines([Photograph(k, picture, mosaic=mosaic) for k, mosaic in enumerate(mosaics)])


def _lines(photographs: Sequence[Photograph]) -> list[list[str]]:
    """Label and text of each line of the sheet."""
    readings = tuple(Reading(one.number, one.name, read(one)) for one in photographs)
    settings = SCENE.check({})
    outputs = SCENE.run(settings, "", StageCache(), None, readings).outputs
    return [[line.label, line.text] for line in sheet(settings, outputs)]
