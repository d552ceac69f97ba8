"""Picture files of an even surface: their light, and which two make a pair.

A colour file is read as sRGB. A grey file is taken for the mosaic itself, as raw converters and
industrial cameras write it, with codes in proportion to the light. A raw file has that mosaic, and
says which colours its cells see.
"""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.color.srgb import decode_srgb

type Codes = NDArray[np.uint8]

HIGHEST = 255
SRGB_DN: Floats = HIGHEST * decode_srgb(np.linspace(0.0, 1.0, HIGHEST + 1))
"""(256,) light of each code of an sRGB file, in 255ths of white."""
CELLS = ("row 0, column 0", "row 0, column 1", "row 1, column 0", "row 1, column 1")
"""Names of the planes of a grey file: the cells of a mosaic's quad."""
COLOURS = ("red", "green", "blue")
NAMES = dict(zip("RGB", COLOURS, strict=True))
BLOCKS = 16
"""Along each side, whose means tell whether the light is even."""
MOST_UNEVEN = 0.05
"""Standard deviation of the blocks' means, without a smooth fall-off, as a share of the mean."""
ALIKE = 0.03
"""Share of the mean code by which the pictures of a pair may differ ..."""
ALIKE_CODES = 0.5
"""... or so many codes, in the dark."""


def is_grey(codes: Codes) -> bool:
    """Whether the three channels (H, W, 3) are equal."""
    grey: np.bool_ = np.all(codes[..., :1] == codes)
    return bool(grey)


def planes_of(codes: Codes) -> dict[str, Codes]:
    """The channels of a file (H, W, 3), or the four cells of a grey one, each (h, w)."""
    if not is_grey(codes):
        return {name: codes[..., k] for k, name in enumerate(COLOURS)}
    height, width = (side // 2 * 2 for side in codes.shape[:2])
    mosaic = codes[:height, :width, 0]
    return {name: mosaic[k // 2 :: 2, k % 2 :: 2] for k, name in enumerate(CELLS)}


def cells_of[T: np.generic](mosaic: NDArray[T], colours: str) -> dict[str, NDArray[T]]:
    """The four cells (h, w) of a raw file's quads, named by the colours that they see.

    >>> list(cells_of(np.zeros((2, 2)), "RGGB"))
    ['red', 'green, row 0', 'green, row 1', 'blue']
    """
    height, width = (side // 2 * 2 for side in mosaic.shape)
    cells: dict[str, NDArray[T]] = {}
    for k, letter in enumerate(colours):
        name = NAMES.get(letter, letter) + (f", row {k // 2}" if colours.count(letter) > 1 else "")
        cells[name] = mosaic[k // 2 : height : 2, k % 2 : width : 2]
    return cells


def unevenness(plane: NDArray[np.generic], least: float = 0.5) -> float:
    """How much the means of blocks vary about a plane, as a share of their mean plus ``least``,
    which is for dark pictures."""
    rows, columns = (max(side // BLOCKS, 1) for side in plane.shape)
    cut = plane[: rows * (plane.shape[0] // rows), : columns * (plane.shape[1] // columns)]
    means = cut.reshape(cut.shape[0] // rows, rows, cut.shape[1] // columns, columns).mean((1, 3))
    y, x = np.indices(means.shape).reshape(2, -1)
    terms = np.stack([np.ones(x.size), x, y, x * x, x * y, y * y], axis=1)
    values = means.reshape(-1)
    rest = values - terms @ np.linalg.lstsq(terms, values)[0]
    return float(rest.std()) / (float(values.mean()) + least)


@dataclass(frozen=True, slots=True)
class Taken:
    """How a picture was taken."""

    mean_code: float
    """Mean code of the green channel, or of all codes of a grey file."""
    camera: str = ""
    """Maker, model and ISO, and the size and kind of the file: what all pairs must share."""
    exposure_s: float = math.nan
    """NaN if the file does not say."""


def pair_up(taken: Sequence[Taken]) -> tuple[tuple[int, int], ...]:
    """Indices of pictures of the same light: the same camera, exposure, and nearly the same mean.

    Of several cameras, that of the most pictures is used. Pairs come in the order of their light; a
    third picture of the same light is left over.
    """
    if not taken:
        return ()
    camera = Counter(one.camera for one in taken).most_common(1)[0][0]
    order = sorted(
        (k for k, one in enumerate(taken) if one.camera == camera),
        key=lambda k: (taken[k].mean_code, k),
    )
    pairs: list[tuple[int, int]] = []
    while order:
        first = order.pop(0)
        partner = next((k for k in order if _are_alike(taken[first], taken[k])), None)
        if partner is not None:
            order.remove(partner)
            pairs.append((first, partner))
    return tuple(pairs)


def _are_alike(first: Taken, second: Taken) -> bool:
    apart = abs(first.mean_code - second.mean_code)
    near = apart <= max(ALIKE * max(first.mean_code, second.mean_code), ALIKE_CODES)
    times = (first.exposure_s, second.exposure_s)
    unknown = any(map(math.isnan, times))
    return near and (unknown or math.isclose(*times, rel_tol=0.01))


def model_of(facts: Mapping[str, float | str]) -> str:
    """Maker and model by the file, in words; empty if it does not say."""
    return ", ".join(str(facts[name]) for name in ("make", "model") if name in facts)


def camera_of(facts: Mapping[str, float | str]) -> str:
    """Maker, model and ISO by the file, in words; empty if it does not say."""
    iso = f"ISO {float(facts['iso']):.0f}" if "iso" in facts else ""
    return ", ".join(filter(None, (model_of(facts), iso)))
