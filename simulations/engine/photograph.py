"""The reader's own pictures, shown in place of the book's; never sent anywhere."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from simulations.engine.exif import exif_facts

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Codes = NDArray[np.uint8]
type Facts = Mapping[str, float | str]
type CellCodes = NDArray[np.uint16]

MOST_MEGAPIXELS = 120.0  # larger ones are refused by the page


@dataclass(frozen=True, slots=True)
class Whole:
    """The size of a photograph that is not cut: its own, unless that has too many pixels."""

    most_megapixels: float = 24.0
    """Photographs of more pixels are scaled down to as many."""
    mosaic: bool = False
    """Whether `read`, or the stages of a scene without it, take the cells of raw files that have a
    Bayer mosaic. The pictures of these photographs are small."""

    def __post_init__(self) -> None:
        if not 0.0 < self.most_megapixels <= MOST_MEGAPIXELS:
            legal = f"above 0, at most {MOST_MEGAPIXELS:g}"
            raise ValueError(f"{self.most_megapixels:g} megapixels; legal: {legal}")


@dataclass(frozen=True, slots=True)
class Mosaic:
    """The codes of a sensor's cells behind a Bayer filter, from a raw file."""

    codes: CellCodes
    """(H, W) in proportion to the light above ``black``, as the sensor lies."""
    colours: str
    """Letters of the four cells of a quad, row by row: ``RGGB``."""
    black: tuple[float, float, float, float]
    """Code without light for each colour."""
    white: int
    """Largest code."""

    def __post_init__(self) -> None:
        codes = self.codes
        if codes.ndim != 2 or codes.dtype != np.uint16 or min(codes.shape) < 2:
            raise ValueError(f"mosaic {codes.shape} {codes.dtype}; legal: (H, W) uint16")
        if not 0 <= max(self.black) < self.white < 1 << 16:
            raise ValueError(f"black {self.black}, white {self.white}; legal: 0 ≤ black < white")


@dataclass(frozen=True, slots=True)
class Photograph:
    """A picture that a reader chose."""

    number: int
    """Number of the reader's picture, by which stages compare it. The `Reading` of the same picture
    has the same number."""
    codes: Codes = field(compare=False, repr=False)
    """(H, W, 3) sRGB, upright."""
    name: str = field(default="", compare=False)
    """Name of the file."""
    facts: Facts = field(default_factory=dict, compare=False)
    """Facts about the file: ``full_width`` and ``full_height`` in px, upright, before it was
    scaled down; and from EXIF, where given, ``focal_mm``, ``focal_35mm_mm``, ``make``, ``model``,
    ``lens``, ``orientation``, ``exposure_s``, ``f_number`` and ``iso``; and ``raw`` of a raw
    file."""
    mosaic: Mosaic | None = field(default=None, compare=False, repr=False)
    """The cells of a raw file, if the scene takes those and it has a Bayer mosaic."""

    def __post_init__(self) -> None:
        codes = self.codes
        if codes.ndim != 3 or codes.shape[2] != 3 or codes.dtype != np.uint8 or not codes.size:
            raise ValueError(f"photograph {codes.shape} {codes.dtype}; legal: (H, W, 3) uint8")

    @property
    def is_scaled(self) -> bool:
        """Whether the file has more pixels than the codes."""
        return float(self.facts.get("full_width", 0)) > self.codes.shape[1]


def photograph_from_page(picture: Any) -> Photograph:
    """A picture as the page hands it over: an object of JavaScript.

    Its fields are ``number``, ``name``, ``width`` and ``height``, the ``full_width`` and
    ``full_height`` before it was scaled down, ``draw``, which fills an array with its codes, and
    ``head``, the first bytes of the file. A raw file also has ``facts``, JSON in place of the Exif
    data, and, if the scene reads it, ``mosaic``.
    """
    codes = np.empty((picture.height, picture.width, 3), np.uint8)
    picture.draw(codes)
    full = {"full_width": picture.full_width, "full_height": picture.full_height}
    raw_facts = getattr(picture, "facts", None)
    return Photograph(
        picture.number,
        codes,
        picture.name,
        {**(json.loads(raw_facts) if raw_facts else exif_facts(picture.head.to_bytes())), **full},
        _mosaic(getattr(picture, "mosaic", None)),
    )


def _mosaic(given: Any) -> Mosaic | None:
    """Its fields are ``codes`` (two bytes each), their ``width`` and ``height``, and ``about``."""
    if given is None:
        return None
    codes = np.frombuffer(given.codes.to_bytes(), "<u2").reshape(given.height, given.width)
    about = json.loads(given.about)
    first, second, third, fourth = map(float, about["black"])
    black = (first, second, third, fourth)
    return Mosaic(codes, about["colours"], black, int(about["white"]))
