"""Drawings as PNG, with the book's own faces: no browser, and the same bytes on every machine."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import resvg_py

from site_builder.output.font_faces import FACES, Face
from site_builder.output.fonts import source_file


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
