"""What is kept of each photograph: its middle, so that two of the same light can be compared."""

import base64
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from simulations.engine.photograph import Codes, Photograph
from simulations.engine.reading import Reading, UnfitError
from simulations.models.sensor.photon_transfer_file import (
    MOST_UNEVEN,
    Taken,
    camera_of,
    planes_of,
    unevenness,
)

SIDE = 256
"""Of the square in the middle, in px; a smaller photograph is kept whole."""
SMALLEST = 64

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
    ``camera`` by the file; ``exposure_s`` or ``None``.

    Raises
    ------
    UnfitError
        For a photograph that is too small, scaled down, or unevenly lit.
    """
    codes, facts = photograph.codes, photograph.facts
    if min(codes.shape[:2]) < SMALLEST:
        raise UnfitError(TOO_SMALL)
    if float(facts.get("full_width", 0)) > codes.shape[1]:
        raise UnfitError(SCALED)
    middle = _middle(codes)
    planes = planes_of(middle)
    if max(map(unevenness, planes.values())) > MOST_UNEVEN:
        raise UnfitError(UNEVEN)
    return {
        "codes": base64.b64encode(middle.tobytes()).decode(),
        "shape": list(middle.shape),
        "mean_code": round(float(middle[..., 1].mean()), 4),
        "camera": camera_of(facts),
        "exposure_s": float(facts["exposure_s"]) if "exposure_s" in facts else None,
    }


def _middle(codes: Codes) -> Codes:
    """From an even row and column on, so that the cells of a mosaic keep their names."""
    top, left = (max(side - SIDE, 0) // 4 * 2 for side in codes.shape[:2])
    return np.ascontiguousarray(codes[top : top + SIDE, left : left + SIDE])


def codes_of(reading: Reading) -> Codes:
    """(h, w, 3) what was kept."""
    shape = tuple(map(int, reading.data["shape"]))
    kept = base64.b64decode(reading.data["codes"])
    return np.frombuffer(kept, np.uint8).reshape(shape)


def taken_of(reading: Reading, grey: bool) -> Taken:
    """Kind and size of the file are of the camera as well: only what is alike makes a pair."""
    data = reading.data
    camera = f"{data['camera']} {data['shape']} {grey}"
    exposure = math.nan if data["exposure_s"] is None else float(data["exposure_s"])
    return Taken(float(data["mean_code"]), camera, exposure)
