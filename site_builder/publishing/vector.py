"""Drawings as PNG: the icons of the site, and pictures for editions and cards."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import resvg_py

from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.files.engine import own_or_engine
from site_builder.output.fonts import FACES, Face, source_file


@dataclass(frozen=True, slots=True)
class Fonts:
    """Whole faces, as drawings need them."""

    files: tuple[Path, ...]
    serif: str
    """Name of the family of the text, from its file."""
    sans: str

    @property
    def title(self) -> Path:
        """The face of titles: the first."""
        return self.files[0]


def whole_fonts(faces: Sequence[Face] = FACES) -> Fonts:
    """The files that ``faces`` are cut from, and the names of their families."""
    paths = {face.file: source_file(face) for face in faces}
    serif, sans = (_family(paths[f"{role}-regular.woff2"]) for role in ("serif", "sans"))
    return Fonts(tuple(paths.values()), serif, sans)


def png_of(svg: str, width: int, fonts: Fonts) -> bytes:
    """A drawing, ``width`` pixels wide. Raises `ValueError` where it is not a drawing."""
    return resvg_py.svg_to_bytes(
        svg_string=svg,
        width=width,
        skip_system_fonts=True,
        font_files=list(map(str, fonts.files)),
        font_family=fonts.serif,
        serif_family=fonts.serif,
        sans_serif_family=fonts.sans,
    )


def _family(file: Path) -> str:
    from fontTools.ttLib import TTFont  # slow to import, and not needed while drawings are cached

    with TTFont(file, lazy=True) as font:
        return str(font["name"].getBestFamilyName())


FILE = "static/images/favicon.svg"
SIZES = {"images/favicon.png": 32, "images/touch-icon.png": 180}
"""File among the assets to its width in pixels."""


def make_icons(root: Path) -> Mapping[str, bytes]:
    """From the book's icon, or the engine's. Raises `BuildError` where it is no drawing."""
    file = own_or_engine(root, FILE)
    try:
        return _drawn(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BuildError([Diagnostic(FILE, 1, f"{error}; legal: a drawing in SVG")]) from error


@cached
def _drawn(svg: str) -> dict[str, bytes]:
    fonts = whole_fonts()
    return {name: png_of(svg, width, fonts) for name, width in SIZES.items()}
