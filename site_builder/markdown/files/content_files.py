"""Files of ``content/`` that a chapter shows or hands out: whether they are there, their size."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path, PurePosixPath

from site_builder.diagnostics import unknown
from site_builder.markdown.parse_context import ParseContext

PICTURES = (".svg", ".png", ".jpg", ".jpeg", ".webp")
SVG_ROOT = re.compile(r"<svg\b[^>]*>")
ATTRIBUTE = r"\s{name}\s*=\s*[\"']([^\"']*)[\"']"
LENGTH = re.compile(r"\s*(\d+\.?\d*|\.\d+)\s*(px)?\s*")

type Size = tuple[int, int]
"""Width and height in CSS pixels."""


def fault_of_file(name: str, content: Path, kind: str, suffixes: Sequence[str] = ()) -> str:
    """What is wrong with a path below ``content``; nothing where such a file is there.

    ``kind`` is what it is called, ``picture file``; ``suffixes`` are the legal ends of its name.
    """
    path = PurePosixPath(name)
    inside = bool(name) and not path.is_absolute() and ".." not in path.parts
    if not inside or not (content / name).is_file():
        return unknown(kind, name, _names(content, suffixes))
    if not (content / name).resolve().is_relative_to(content.resolve()):
        return f"{kind} {name!r} leads out of content/; legal: a file that lies in it"
    if suffixes and not name.endswith(tuple(suffixes)):
        return f"{kind} {name!r}; legal: a name that ends in {', '.join(suffixes)}"
    return ""


def _names(content: Path, suffixes: Sequence[str]) -> list[str]:
    files = (file.relative_to(content) for file in sorted(content.rglob("*")) if file.is_file())
    return [
        file.as_posix()
        for file in files
        if (not suffixes or file.suffix in suffixes)
        and not any(part.startswith(".") for part in file.parts)
    ]


def found(
    name: str, line: int, context: ParseContext, kind: str, suffixes: Sequence[str] = ()
) -> Path | None:
    """The file, or nothing and a report."""
    content = context.shared.root / "content"
    fault = fault_of_file(name, content, kind, suffixes)
    if fault:
        context.problem(line, fault)
        return None
    return content / name


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
