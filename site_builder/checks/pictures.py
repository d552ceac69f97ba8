"""Whether the author's picture files are whole, of the kind in their names, not too large, and
without scripts."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from site_builder.checks.svg import read_svg
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.folders import folder_files
from site_builder.files.text import Sources
from site_builder.markdown.content_files import PICTURES

if TYPE_CHECKING:
    from PIL.Image import Image

KINDS = {".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".webp": "WEBP"}
GPS = 0x8825
"""The tag of Exif below which the place stands."""
MOST_PIXELS, MOST_BYTES = 40_000_000, 20_000_000


def check_pictures(sources: Sources, *, trusted: bool = False) -> None:
    """Check all that would be published, shown or not. In a ``trusted`` book SVG may run code."""
    for name, file in folder_files(sources.root / "content").items():
        if file.suffix in PICTURES.suffixes:
            _check_picture(file, f"content/{name}", sources.problems, trusted)


def _check_picture(file: Path, path: str, problems: Diagnostics, trusted: bool) -> None:
    size = file.stat().st_size
    if size > MOST_BYTES:
        expected = f"at most {MOST_BYTES / 1e6:g} MB"
        problems.add(path, 1, f"a picture of {size / 1e6:.1f} MB; legal: {expected}")
        return
    if file.suffix == ".svg":
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
            if picture.format != KINDS[file.suffix]:
                return f"holds {picture.format}; legal: {KINDS[file.suffix]}, as its name says"
            picture.load()
    except UnidentifiedImageError:
        return f"no picture; legal: {KINDS[file.suffix]}"
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        return f"more pixels than can be read; legal: at most {MOST_PIXELS:,}"
    except (OSError, SyntaxError, ValueError, Warning) as error:
        return f"a damaged picture: {error}; legal: a whole {KINDS[file.suffix]}"
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
