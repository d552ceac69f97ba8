"""Picture files and drawings: whether they are whole, as their names say, not too large, and
without scripts.

SVG is held to a strict list: shapes, text and paint, all of it inert. Whatever else a file or a
drawing holds, such as scripts, handlers of events or addresses outside of it, is reported with its
line.
"""

import io
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax import SAXParseException
from xml.sax.handler import ContentHandler, feature_namespaces
from xml.sax.xmlreader import AttributesNSImpl

from defusedxml import DefusedXmlException

from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.folders import folder_files
from site_builder.files.text import Sources
from site_builder.markdown.content_files import PICTURES

if TYPE_CHECKING:
    from PIL.Image import Image

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
XML = "http://www.w3.org/XML/1998/namespace"
NOTES = (
    "http://www.inkscape.org/namespaces/inkscape",
    "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd",
    "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "http://creativecommons.org/ns#",
    "http://purl.org/dc/elements/1.1/",
)
"""Namespaces of drawing programs, which browsers ignore."""

DRAWN = (
    "svg g defs symbol use title desc metadata style path rect circle ellipse line polyline polygon"
    " text tspan textPath image marker pattern clipPath mask linearGradient radialGradient stop"
)
FILTERS = (
    "filter feGaussianBlur feOffset feMerge feMergeNode feBlend feColorMatrix feFlood feComposite"
    " feComponentTransfer feFuncR feFuncG feFuncB feFuncA feMorphology feTile feTurbulence"
)
ELEMENTS = f"{DRAWN} {FILTERS}".split()
PLACES = (
    "x y x1 y1 x2 y2 cx cy r rx ry fx fy fr dx dy d points width height viewBox transform rotate"
    " preserveAspectRatio pathLength textLength lengthAdjust startOffset method spacing side offset"
    " refX refY markerWidth markerHeight markerUnits orient overflow clip patternUnits"
    " patternContentUnits patternTransform maskUnits maskContentUnits clipPathUnits gradientUnits"
    " gradientTransform spreadMethod filterUnits primitiveUnits zoomAndPan"
)
PAINT = (
    "fill fill-opacity fill-rule stroke stroke-width stroke-opacity stroke-linecap stroke-linejoin"
    " stroke-miterlimit stroke-dasharray stroke-dashoffset opacity color color-interpolation"
    " color-interpolation-filters color-rendering stop-color stop-opacity flood-color flood-opacity"
    " display visibility clip-path clip-rule mask filter marker-start marker-mid marker-end"
    " paint-order vector-effect shape-rendering text-rendering image-rendering enable-background"
    " mix-blend-mode isolation"
)
LETTERS = (
    "font-family font-size font-style font-weight font-variant font-stretch font text-anchor"
    " dominant-baseline alignment-baseline baseline-shift letter-spacing word-spacing kerning"
    " text-decoration writing-mode direction unicode-bidi line-height"
)
OF_FILTERS = (
    "in in2 result stdDeviation edgeMode mode values operator k1 k2 k3 k4 radius baseFrequency"
    " numOctaves seed stitchTiles tableValues slope intercept amplitude exponent"
)
OTHERS = "id class style lang role tabindex version baseProfile type media"
ATTRIBUTES = f"{PLACES} {PAINT} {LETTERS} {OF_FILTERS} {OTHERS}".split()
"""Attributes without a prefix, beside ``aria-…`` and ``data-…``."""
ADDRESSES = ("href", "src")
OWN_PLACE = re.compile(r"\s*#[^\s]*\s*")
OWN_PICTURE = re.compile(r"\s*data:image/(?:png|jpe?g|gif|webp);base64,[A-Za-z0-9+/=\s]*")
REACHES_OUT = re.compile(
    r"@import|url\(\s*['\"]?(?!#|\s*['\"]?#)|expression\s*\(|-moz-binding|behavior\s*:|\\|<"
    r"|javascript:|image-set|\bsrc\(",
    re.IGNORECASE,
)
"""Parts of a style that load or run something; a backslash could spell any of them."""


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """What is wrong in a drawing."""

    line: int
    """Counted from 1."""
    message: str
    unreadable: bool = False
    """Whether no browser would show it either."""


@dataclass(frozen=True, slots=True)
class Label:
    """Where a text stands that is drawn where it says, and which part of it."""

    x: float
    y: float
    anchor: str


@dataclass(frozen=True, slots=True)
class Drawing:
    """What was found in some SVG."""

    faults: tuple[Fault, ...]
    classes: frozenset[str]
    labels: tuple[Label, ...] = ()


def read_svg(data: bytes, *, in_page: bool = False) -> Drawing:
    """The faults of a file, in the order of its lines; none where it may be published.

    ``in_page``: it is a part of a page, where a ``<style>`` would hold for all of it, and by its
    policy for nothing.
    """
    from defusedxml.sax import make_parser  # slow to import

    reader = _Reader(in_page)
    parser = make_parser()
    parser.setFeature(feature_namespaces, True)
    parser.forbid_dtd = True
    parser.setContentHandler(reader)
    try:
        parser.parse(io.BytesIO(data))
    except SAXParseException as error:
        message = f"no SVG: {error.getMessage()}"
        reader.faults.append(Fault(error.getLineNumber() or 1, message, unreadable=True))
    except DefusedXmlException:
        message = "a DOCTYPE or an entity; legal: neither"
        reader.faults.append(Fault(reader.line, message))
    except (ValueError, LookupError) as error:  # an unknown encoding
        reader.faults.append(Fault(1, f"no SVG: {error}; legal: UTF-8", unreadable=True))
    return Drawing(
        tuple(sorted(set(reader.faults))), frozenset(reader.classes), tuple(reader.labels)
    )


@cached
def read_overlay(markup: str) -> Drawing:
    """The same of the content of ``<svg>``, as scenes and illustrations draw it."""
    return read_svg(f'<svg xmlns="{SVG}">{markup}</svg>'.encode(), in_page=True)


@dataclass(slots=True)
class _Reader(ContentHandler):
    in_page: bool
    faults: list[Fault] = field(default_factory=list)
    classes: set[str] = field(default_factory=set)
    labels: list[Label] = field(default_factory=list)
    moved: list[bool] = field(default_factory=list)
    """Whether each open element, or one around it, has a transform."""
    inside: list[str] = field(default_factory=list)
    style: str = ""
    """The text of the present ``<style>`` so far."""
    locator: object = None

    def setDocumentLocator(self, locator: object) -> None:  # noqa: N802 (the parser's name)
        self.locator = locator

    @property
    def line(self) -> int:
        return int(getattr(self.locator, "getLineNumber", lambda: 1)() or 1)

    def fault(self, message: str) -> None:
        self.faults.append(Fault(self.line, message))

    def processingInstruction(self, target: str, _data: str) -> None:  # noqa: N802
        self.fault(f"<?{target}?>; legal: no such instruction")

    def startElementNS(  # noqa: N802
        self, name: tuple[str | None, str], _qname: str | None, attrs: AttributesNSImpl
    ) -> None:
        space, local = name
        if not self.inside and (space, local) != (SVG, "svg"):
            self.fault(f'<{local}> at the top; legal: <svg xmlns="{SVG}">')
        elif space == SVG and local not in ELEMENTS:
            self.fault(_strange("element", local, ELEMENTS))
        elif space != SVG and space not in NOTES:
            self.fault(f"<{local}> of {space or 'no'} namespace; legal: SVG")
        elif self.in_page and local == "style":
            self.fault("<style> in a drawing; legal: classes of the style sheets, and attributes")
        self.inside.append(local)
        given = {attribute: str(value) for (_, attribute), value in attrs.items()}
        self.moved.append("transform" in given or any(self.moved[-1:]) or local == "symbol")
        if local == "text" and not self.moved[-1]:
            with suppress(KeyError, ValueError):
                x, y = float(given["x"]), float(given["y"])
                self.labels.append(Label(x, y, given.get("text-anchor", "start")))
        for (prefix, attribute), value in attrs.items():
            self._attribute(prefix, attribute, str(value), local)

    def endElementNS(self, _name: tuple[str | None, str], _qname: str | None) -> None:  # noqa: N802
        self.moved.pop()
        if self.inside.pop() == "style":
            if found := REACHES_OUT.search(self.style):
                self.fault(f"{found[0]!r} in a style; legal: paint, and 'url(#id)'")
            self.style = ""

    def characters(self, content: str) -> None:
        if "style" in self.inside:
            self.style += content

    def _attribute(self, space: str | None, name: str, value: str, element: str) -> None:
        if name == "class" and not space:
            self.classes.update(value.split())
        if name in ADDRESSES:
            own = OWN_PLACE.fullmatch(value) or (
                element == "image" and OWN_PICTURE.fullmatch(value)
            )
            if space not in (None, XLINK) or not own:
                shown = value if len(value) <= 40 else f"{value[:40]}…"
                expected = "'#id' of its own, and in <image> 'data:image/png;base64,…'"
                self.fault(f"address {shown!r} in <{element}>; legal: {expected}")
        elif space is None and not (name in ATTRIBUTES or name.startswith(("aria-", "data-"))):
            self.fault(_strange("attribute", name, ATTRIBUTES))
        elif space == XML and name not in ("space", "lang", "id"):
            self.fault(f"attribute 'xml:{name}'; legal: xml:space, xml:lang, xml:id")
        elif space not in (None, XML, XLINK, *NOTES):
            self.fault(f"attribute {name!r} of {space}; legal: SVG's")
        elif not space and name not in ("id", "class") and (found := REACHES_OUT.search(value)):
            self.fault(f"{found[0]!r} in {name!r}; legal: paint, and 'url(#id)'")


def _strange(kind: str, name: str, expected: list[str]) -> str:
    """Without a list of all legal names, which is long, where none is similar."""
    said = unknown(kind, name, expected)
    return said if "did you mean" in said else f"{kind} {name!r}; legal: shapes, text and paint"


KINDS = {".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".webp": "WEBP"}
GPS = 0x8825
"""The tag of Exif below which the place stands."""
MOST_PIXELS, MOST_BYTES = 40_000_000, 20_000_000


def check_pictures(sources: Sources, *, trusted: bool = False) -> None:
    """Check all that would be published, shown or not. In a ``trusted`` book SVG may run code."""
    for name, file in folder_files(sources.root / "content").items():
        if file.suffix.lower() in PICTURES.suffixes:
            _check_picture(file, f"content/{name}", sources.problems, trusted)


def _check_picture(file: Path, path: str, problems: Diagnostics, trusted: bool) -> None:
    size = file.stat().st_size
    if size > MOST_BYTES:
        expected = f"at most {MOST_BYTES / 1e6:g} MB"
        problems.add(path, 1, f"a picture of {size / 1e6:.1f} MB; legal: {expected}")
        return
    if file.suffix.lower() == ".svg":
        for fault in read_svg(file.read_bytes()).faults:
            if not trusted or fault.unreadable:
                problems.add(path, fault.line, fault.message)
    elif message := _fault_of_raster(file):
        problems.add(path, 1, message)
    elif _has_place(file):
        better = "better: without, as by `exiftool -gps:all= FILE`"
        problems.warn(path, 1, f"says where it was taken (GPS), to every reader; {better}")


def _fault_of_raster(file: Path) -> str:
    """What is wrong with a picture of pixels; nothing where nothing is."""
    from PIL import Image, UnidentifiedImageError  # not every book has such pictures

    try:
        with _reading(file) as picture:
            width, height = picture.size
            if width * height > MOST_PIXELS:
                return f"{width} × {height} px; legal: at most {MOST_PIXELS:,} pixels"
            if picture.format != KINDS[file.suffix.lower()]:
                return (
                    f"holds {picture.format}; legal: {KINDS[file.suffix.lower()]}, as its name says"
                )
            picture.load()
    except UnidentifiedImageError:
        return f"no picture; legal: {KINDS[file.suffix.lower()]}"
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        return f"more pixels than can be read; legal: at most {MOST_PIXELS:,}"
    except (OSError, SyntaxError, ValueError, Warning) as error:
        return f"a damaged picture: {error}; legal: a whole {KINDS[file.suffix.lower()]}"
    return ""


def _has_place(file: Path) -> bool:
    with _reading(file) as picture:
        return bool(picture.getexif().get_ifd(GPS))


@contextmanager
def _reading(file: Path) -> "Iterator[Image]":
    """The picture, opened and not yet decoded; its library's doubts about it are errors."""
    from PIL.Image import open as opened

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with opened(file, formats=tuple(dict.fromkeys(KINDS.values()))) as picture:
            yield picture
