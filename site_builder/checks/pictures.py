"""Picture files and drawings: whether they are whole, as their names say, and not too large; and
the classes and labels of a drawing."""

import io
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax import SAXParseException, make_parser
from xml.sax.handler import ContentHandler, feature_namespaces
from xml.sax.xmlreader import AttributesNSImpl

from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.folders import folder_files
from site_builder.files.text import Sources
from site_builder.markdown.content_files import PICTURES

if TYPE_CHECKING:
    from PIL.Image import Image

SVG = "http://www.w3.org/2000/svg"


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """What is wrong in a drawing."""

    line: int
    """Counted from 1."""
    message: str


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
    """In the order of lines; none where browsers show it."""
    classes: frozenset[str]
    labels: tuple[Label, ...] = ()


def read_svg(data: bytes, *, inline: bool = False) -> Drawing:
    """What a file holds. ``inline``: it is a part of a page, where a ``<style>`` would hold for
    all of it, and by its policy for nothing."""
    reader = _SvgReader(inline=inline)
    parser = make_parser()
    parser.setFeature(feature_namespaces, True)
    parser.setContentHandler(reader)
    try:
        parser.parse(io.BytesIO(data))
    except SAXParseException as error:
        reader.faults.append(Fault(error.getLineNumber() or 1, f"no SVG: {error.getMessage()}"))
    except (ValueError, LookupError) as error:  # an unknown encoding
        reader.faults.append(Fault(1, f"no SVG: {error}; legal: UTF-8"))
    return Drawing(
        tuple(sorted(set(reader.faults))), frozenset(reader.classes), tuple(reader.labels)
    )


@cached
def read_overlay(markup: str) -> Drawing:
    """The same of the content of ``<svg>``, as scenes and illustrations draw it."""
    drawing = f'<svg xmlns="{SVG}">{markup}</svg>'
    return read_svg(drawing.encode(errors="surrogatepass"), inline=True)


@dataclass(slots=True, kw_only=True)
class _SvgReader(ContentHandler):
    inline: bool
    faults: list[Fault] = field(default_factory=list)
    classes: set[str] = field(default_factory=set)
    labels: list[Label] = field(default_factory=list)
    moved: list[bool] = field(default_factory=list)
    """Whether each open element, or one around it, has a transform."""
    locator: object = None

    def setDocumentLocator(self, locator: object) -> None:  # noqa: N802 (the parser's name)
        self.locator = locator

    def fault(self, message: str) -> None:
        line = getattr(self.locator, "getLineNumber", lambda: 1)()
        self.faults.append(Fault(int(line or 1), message))

    def startElementNS(  # noqa: N802
        self, name: tuple[str | None, str], _qname: str | None, attrs: AttributesNSImpl
    ) -> None:
        space, local = name
        if not self.moved and (space, local) != (SVG, "svg"):
            self.fault(f'<{local}> at the top; legal: <svg xmlns="{SVG}">')
        elif self.inline and local == "style":
            self.fault("<style> in a drawing; legal: classes of the style sheets, and attributes")
        given = {attribute: str(value) for (_, attribute), value in attrs.items()}
        self.classes.update(given.get("class", "").split())
        self.moved.append("transform" in given or any(self.moved[-1:]) or local == "symbol")
        if local == "text" and not self.moved[-1]:
            with suppress(KeyError, ValueError):
                x, y = float(given["x"]), float(given["y"])
                self.labels.append(Label(x, y, given.get("text-anchor", "start")))

    def endElementNS(self, _name: tuple[str | None, str], _qname: str | None) -> None:  # noqa: N802
        self.moved.pop()


KINDS = {".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".webp": "WEBP"}
GPS = 0x8825
"""The tag of Exif below which the place stands."""
MOST_PIXELS, MOST_BYTES = 40_000_000, 20_000_000


def check_pictures(sources: Sources) -> None:
    """Check all that would be published, shown or not."""
    for name, file in folder_files(sources.root / "content").items():
        if file.suffix.lower() in PICTURES.suffixes:
            _check_picture(file, f"content/{name}", sources.problems)


def _check_picture(file: Path, path: str, problems: Diagnostics) -> None:
    size = file.stat().st_size
    if size > MOST_BYTES:
        expected = f"at most {MOST_BYTES / 1e6:g} MB"
        problems.add(path, 1, f"a picture of {size / 1e6:.1f} MB; legal: {expected}")
        return
    if file.suffix.lower() == ".svg":
        for fault in read_svg(file.read_bytes()).faults:
            problems.add(path, fault.line, fault.message)
    elif message := _raster_error(file):
        problems.add(path, 1, message)
    elif _has_place(file):
        better = "better: without, as by `exiftool -gps:all= FILE`"
        problems.warn(path, 1, f"says where it was taken (GPS), to every reader; {better}")


def _raster_error(file: Path) -> str:
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
