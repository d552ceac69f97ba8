"""Files of ``content/`` that a chapter shows or hands out: whether they are there, their size."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path, PurePosixPath

from site_builder.diagnostics import unknown
from site_builder.markdown.directive import FileKind

PICTURES = FileKind("picture file", (".svg", ".png", ".jpg", ".jpeg", ".webp"))
SVG_ROOT = re.compile(r"<svg\b[^>]*>")
ATTRIBUTE = r"\s{name}\s*=\s*[\"']([^\"']*)[\"']"
LENGTH = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*(px)?\s*")

type Size = tuple[int, int]
"""Width and height in CSS pixels."""


def fault_of_file(name: str, content: Path, kind: FileKind) -> str:
    """What is wrong with a path below ``content``; nothing where such a file is there."""
    path = PurePosixPath(name)
    inside = bool(name) and not path.is_absolute() and ".." not in path.parts
    if not inside or not (content / name).is_file():
        return unknown(kind.name, name, _names(content, kind.suffixes))
    if not (content / name).resolve().is_relative_to(content.resolve()):
        return f"{kind.name} {name!r} leads out of content/; legal: a file that lies in it"
    if kind.suffixes and not name.endswith(kind.suffixes):
        return f"{kind.name} {name!r}; legal: a name that ends in {', '.join(kind.suffixes)}"
    return ""


def _names(content: Path, suffixes: Sequence[str]) -> list[str]:
    paths = (file.relative_to(content) for file in sorted(content.rglob("*")) if file.is_file())
    return [
        path.as_posix()
        for path in paths
        if (not suffixes or path.suffix in suffixes)
        and not any(part.startswith(".") for part in path.parts)
    ]


def picture_size(file: Path) -> Size | None:
    """As the picture says of itself; None where it does not, or cannot be read."""
    read: Callable[[Path], Size | None] = _svg_size if file.suffix == ".svg" else _raster_size
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
    root = SVG_ROOT.search(file.read_text(encoding="utf-8", errors="replace"))
    if root is None:
        return None
    given = [LENGTH.fullmatch(_attribute(name, root[0])) for name in ("width", "height")]
    if given[0] and given[1]:
        return round(float(given[0][1])), round(float(given[1][1]))
    box = _attribute("viewBox", root[0]).replace(",", " ").split()
    if len(box) != 4 or not all(LENGTH.fullmatch(value) for value in box[2:]):
        return None
    return round(float(box[2])), round(float(box[3]))


def _attribute(name: str, tag: str) -> str:
    given = re.search(ATTRIBUTE.format(name=name), tag)
    return given[1] if given else ""
