"""Bounding boxes of the labels in a drawing, measured in the book's fonts."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from xml.etree import ElementTree

from PIL import ImageFont

from simulations.engine.letters import SCRIPT_SIZE
from simulations.engine.plotting.labels import Rectangle

ITALIC, UPRIGHT = 14.0, 13.5
"""The largest sizes of labels in illustrations, in units of the view box: illustrations.css."""
LARGE, SMALL = 16.0, 15.5
"""The largest font sizes in figures, on the narrowest phone: overlay.css."""
FACES = {
    "sans": ("font_source_sans_pro", "files/SourceSansPro-Regular.ttf"),
    "strong": ("font_source_sans_pro", "files/SourceSansPro-Semibold.ttf"),
    "italic": ("font_source_serif_pro", "files/SourceSerifPro-It.ttf"),
}
MEASURED_AT = 100


@dataclass(frozen=True, slots=True)
class Label:
    """A text of a drawing and its bounding box."""

    text: str
    box: Rectangle


def in_illustrations(style: Sequence[str]) -> float:
    return ITALIC if "italic" in style else UPRIGHT


def in_figures(style: Sequence[str]) -> float:
    return SMALL if "small" in style else LARGE


def labels(
    overlay: str, size_of: Callable[[Sequence[str]], float] = in_illustrations
) -> Iterator[Label]:
    """The labels of a panel's overlay, in view box units; ``size_of`` maps classes to sizes."""
    for element in ElementTree.fromstring(f"<svg>{overlay}</svg>").iter("text"):
        yield Label("".join(element.itertext()), _box(element, size_of))


def _box(element: ElementTree.Element, size_of: Callable[[Sequence[str]], float]) -> Rectangle:
    style = (element.get("class") or "").split()
    size = size_of(style)
    face = "italic" if "italic" in style else "strong" if "strong" in style else "sans"
    width = _width(element.text or "", face, size)
    for span in element:
        scale = SCRIPT_SIZE if span.get("class") else 1.0
        width += _width(span.text or "", face, scale * size)
    share = {"start": 0.0, "middle": 0.5, "end": 1.0}[element.get("text-anchor", "start")]
    left = float(element.get("x", "nan")) - share * width
    baseline = float(element.get("y", "nan"))
    return Rectangle(left, baseline - 0.72 * size, left + width, baseline + 0.2 * size)


def _width(text: str, face: str, size: float) -> float:
    return _length(text, face) * size / MEASURED_AT


@cache
def _length(text: str, face: str) -> float:
    return float(_font(face).getlength(text))


@cache
def _font(face: str) -> ImageFont.FreeTypeFont:
    package, source = FACES[face]
    return ImageFont.truetype(str(files(package).joinpath(source)), MEASURED_AT)
