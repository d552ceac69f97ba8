"""What is kept of each photograph: its middle, so that two of the same light can be compared."""

import base64
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from simulations.engine.photograph import Facts, Mosaic, Photograph
from simulations.engine.reading import Reading, UnfitError
from simulations.models.sensor.photon_transfer_file import (
    HIGHEST,
    MOST_UNEVEN,
    Taken,
    camera_of,
    cells_of,
    is_grey,
    planes_of,
    unevenness,
)

SIDE = 256
"""Of the square in the middle, in px; a smaller photograph is kept whole."""
SMALLEST = 64
DARK = 0.01 * HIGHEST
"""Added to the mean of a raw file's light before it is asked whether that is even: with black taken
off, a dark picture has nothing but noise."""

TOO_SMALL = f"The photograph is smaller than {SMALLEST} × {SMALLEST} pixels; take a larger one."
SCALED = (
    "The photograph was scaled down, which averages its noise; save the middle of it as a file of "
    "at most 24 megapixels, without scaling."
)
UNEVEN = (
    "The middle of the photograph is not evenly lit; photograph a white wall or the cloudy sky, "
    "out of focus."
)


def read(photograph: Photograph) -> Mapping[str, Any]:
    """The codes of the middle, and how the photograph was taken.

    Returns
    -------
    ``codes``, base64 of ``shape`` (h, w, 3) codes; ``mean_code``, that of green;
    ``camera`` by the file; ``exposure_s`` or ``None``. Of a raw file the codes are (h, w), of 16
    bits, ``cells`` has their ``colours``, ``black`` and ``white``, and ``mean_code`` is the mean
    above black, in 255ths of white.

    Raises
    ------
    UnfitError
        For a photograph that is too small, scaled down, or unevenly lit.
    """
    if photograph.mosaic is not None:
        return _read_cells(photograph.mosaic, photograph.facts)
    codes, facts = photograph.codes, photograph.facts
    if min(codes.shape[:2]) < SMALLEST:
        raise UnfitError(TOO_SMALL)
    if float(facts.get("full_width", 0)) > codes.shape[1]:
        raise UnfitError(SCALED)
    middle = _middle(codes)
    planes = planes_of(middle)
    if max(map(unevenness, planes.values())) > MOST_UNEVEN:
        raise UnfitError(UNEVEN)
    return _kept(middle, float(middle[..., 1].mean()), facts)


def _read_cells(mosaic: Mosaic, facts: Facts) -> Mapping[str, Any]:
    if min(mosaic.codes.shape) < 2 * SMALLEST:
        raise UnfitError(TOO_SMALL)
    middle = np.minimum(_middle(mosaic.codes), np.uint16(mosaic.white))
    cells = cells_of(middle, mosaic.colours).values()
    light = [
        HIGHEST * (cell.astype(float) - black) / (mosaic.white - black)
        for cell, black in zip(cells, mosaic.black, strict=True)
    ]
    if max(unevenness(cell, DARK) for cell in light) > MOST_UNEVEN:
        raise UnfitError(UNEVEN)
    about = {"colours": mosaic.colours, "black": list(mosaic.black), "white": mosaic.white}
    return {**_kept(middle, float(np.mean(light)), facts), "cells": about}


def _kept(middle: NDArray[np.unsignedinteger], mean_code: float, facts: Facts) -> dict[str, Any]:
    return {
        "codes": base64.b64encode(middle.tobytes()).decode(),
        "shape": list(middle.shape),
        "mean_code": round(mean_code, 4),
        "camera": camera_of(facts),
        "exposure_s": float(facts["exposure_s"]) if "exposure_s" in facts else None,
    }


def _middle[T: np.generic](codes: NDArray[T]) -> NDArray[T]:
    """From an even row and column on, so that the cells of a mosaic keep their names."""
    top, left = (max(side - SIDE, 0) // 4 * 2 for side in codes.shape[:2])
    return np.ascontiguousarray(codes[top : top + SIDE, left : left + SIDE])


@dataclass(frozen=True, slots=True)
class Kept:
    """The middle of a photograph, as codes again."""

    kind: Literal["colour", "grey", "raw"]
    planes: Mapping[str, NDArray[np.unsignedinteger]]
    """(h, w) each, by name."""
    highest: int = HIGHEST
    """The largest code."""
    black: Mapping[str, float] = field(default_factory=dict)
    """Code without light of each plane, if the file says."""


def kept_of(reading: Reading) -> Kept:
    """What was kept."""
    data = reading.data
    shape, kept = tuple(map(int, data["shape"])), base64.b64decode(data["codes"])
    if "cells" not in data:
        codes = np.frombuffer(kept, np.uint8).reshape(shape)
        return Kept("grey" if is_grey(codes) else "colour", planes_of(codes))
    about = data["cells"]
    cells = cells_of(np.frombuffer(kept, np.uint16).reshape(shape), about["colours"])
    black = dict(zip(cells, about["black"], strict=True))
    return Kept("raw", cells, int(about["white"]), black)


def taken_of(reading: Reading, kept: Kept) -> Taken:
    """Kind and size of the file are of the camera as well: only what is alike makes a pair."""
    data = reading.data
    camera = f"{data['camera']} {data['shape']} {kept.kind} {list(kept.planes)} {kept.highest}"
    exposure = math.nan if data["exposure_s"] is None else float(data["exposure_s"])
    return Taken(float(data["mean_code"]), camera, exposure)
