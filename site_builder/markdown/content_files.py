"""Files of ``content/`` that a chapter shows: whether they are there, their size."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path, PurePosixPath
from xml.etree import ElementTree

from site_builder.diagnostics.diagnostic import unknown
from site_builder.files.folders import folder_files, is_file
from site_builder.markdown.directive import FileKind

PICTURES = FileKind("picture file", (".svg", ".png", ".jpg", ".jpeg", ".webp"))
LENGTH = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*(px)?\s*")

type Size = tuple[int, int]
"""Width and height in CSS pixels."""


def file_error(name: str, content: Path, kind: FileKind) -> str:
    """What is wrong with a path below ``content``; nothing where such a file is there."""
    path = PurePosixPath(name)
    inside = bool(name) and not path.is_absolute() and ".." not in path.parts
    if not inside or not is_file(content / name):
        return unknown(kind.name, name, _names(content, kind.suffixes))
    if not (content / name).resolve().is_relative_to(content.resolve()):
        return f"{kind.name} {name!r} leads out of content/; legal: a file that lies in it"
    if kind.suffixes and path.suffix.lower() not in kind.suffixes:
        return f"{kind.name} {name!r}; legal: a name that ends in {', '.join(kind.suffixes)}"
    return ""


def _names(content: Path, suffixes: Sequence[str]) -> list[str]:
    names = folder_files(content)
    return [name for name in names if not suffixes or name.lower().endswith(tuple(suffixes))]


def picture_size(file: Path) -> Size | None:
    """The size that a file declares; None where it does not, or cannot be read."""
    read: Callable[[Path], Size | None] = (
        _svg_size if file.suffix.lower() == ".svg" else _raster_size
    )
    size = read(file)
    return size if size and all(size) else None


def _raster_size(file: Path) -> Size | None:
    from PIL import Image  # not every book has such pictures

    try:
        with Image.open(file) as picture:
            return picture.size
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        return None


def _svg_size(file: Path) -> Size | None:
    try:
        root = ElementTree.parse(file).getroot()
    except (ElementTree.ParseError, ValueError):
        return None
    shown = [LENGTH.fullmatch(root.get(name, "")) for name in ("width", "height")]
    box = root.get("viewBox", "").replace(",", " ").split()
    drawn = [LENGTH.fullmatch(value) for value in box[2:]] if len(box) == 4 else []
    for found in (shown, drawn):
        sides = [round(float(side[1])) for side in found if side]
        if len(sides) == 2:
            return sides[0], sides[1]
    return None
