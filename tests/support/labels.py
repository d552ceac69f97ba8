"""What room the labels of a drawing take, in the letters of the narrowest phone."""

from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree

import font_source_sans_pro
from PIL import ImageFont

LARGE, SMALL = 16.0, 15.5
"""Sizes in view box units, as ``overlay.css`` has them where a panel is narrowest."""


@lru_cache
def _face(weight: str) -> ImageFont.FreeTypeFont:
    folder = Path(font_source_sans_pro.font_directory)
    return ImageFont.truetype(next(folder.rglob(f"SourceSansPro-{weight}.otf")), 100)


@lru_cache
def _outlines(words: str, weight: str) -> tuple[float, float, float]:
    """Width, and how far above and below the baseline, of letters of size 1."""
    face = _face(weight)
    _, top, _, bottom = face.getbbox(words, anchor="ls")
    return face.getlength(words) / 100, -top / 100, bottom / 100


def box_of(label: ElementTree.Element) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a ``text``."""
    styles = label.attrib["class"].split()
    size = SMALL if "small" in styles else LARGE
    weight = "Semibold" if "strong" in styles else "Regular"
    width, above, below = (size * part for part in _outlines(label.text or "", weight))
    x, y = float(label.attrib["x"]), float(label.attrib["y"])
    left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[label.attrib["text-anchor"]] * width
    return left, y - above, left + width, y + below
