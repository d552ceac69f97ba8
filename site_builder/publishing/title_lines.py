"""A title set in lines, as large as its place allows."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

SIZES = (68, 60, 52, 46, 40, 34)
MOST_LINES = 4


def set_title(title: str, width: float, font: Path) -> tuple[int, list[str]]:
    """Size in pixels, and the lines, in the face of the file ``font``. A title that is too long at
    any size ends in ``…``."""
    for size in SIZES:
        face = _face(font, size)
        lines = break_lines(title, width, face)
        if len(lines) <= MOST_LINES and all(face.getlength(line) <= width for line in lines):
            return size, lines
    if len(lines) > MOST_LINES:
        lines = [*lines[: MOST_LINES - 1], f"{lines[MOST_LINES - 1]} …"]
    return size, lines


def break_lines(words: str, width: float, face: "FreeTypeFont") -> list[str]:
    """Each no wider than ``width`` pixels, but for a word that is wider alone."""
    lines: list[str] = []
    for word in words.split():
        if lines and face.getlength(f"{lines[-1]} {word}") <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def _face(font: Path, size: int) -> "FreeTypeFont":
    from PIL import ImageFont  # not every book has cards

    # The basic layout is in every Pillow; the other one depends on what else is installed.
    return ImageFont.truetype(font, size, layout_engine=ImageFont.Layout.BASIC)
