"""Titles on cards."""

import pytest
from fontTools.ttLib import TTFont

from site_builder.publishing.title_lines import MOST_LINES, set_title
from site_builder.publishing.vector import whole_fonts

FONT = whole_fonts().title

TITLES = ("Connections", "2D Transformations", "Why Study Image Formation?", "Öl & <Licht>")


def advance(line: str, size: int) -> float:
    """Width of a line without kerning, from the face's own table."""
    font = TTFont(FONT)
    names, widths = font.getBestCmap(), font["hmtx"]
    units: int = sum(widths[names[ord(letter)]][0] for letter in line)
    return units * size / float(font["head"].unitsPerEm)


@pytest.mark.parametrize("title", TITLES)
def test_a_title_is_whole_and_inside_its_place(title: str) -> None:
    size, lines = set_title(title, 440, FONT)
    assert " ".join(lines) == title
    assert all(advance(line, size) <= 1.05 * 440 for line in lines)


def test_a_title_without_end_is_cut() -> None:
    lines = set_title("words " * 200, 440, FONT)[1]
    assert len(lines) == MOST_LINES
    assert lines[-1].endswith("…")
