"""Cards: the pictures that a link to a chapter shows where people share it, 1200 by 630 pixels."""

from base64 import b64encode
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from simulations.engine.frame import Panel
from site_builder.document.blocks import Simulation, contents
from site_builder.document.book import Book, Chapter, Colours
from site_builder.figures.frames import as_png
from site_builder.figures.initial_frames import InitialFrames
from site_builder.markdown.directives.pictures import DrawnIllustration
from site_builder.output.style_sheets import style_of_drawings
from site_builder.pages.environment import render_template
from site_builder.pages.page import BOOK_CARD, card_path
from site_builder.publishing.vector import Fonts, png_of, whole_fonts

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont

WIDTH, HEIGHT = 1200, 630
TITLE_WIDTH = 440
"""What is left for a title beside a figure."""
FIGURE = (560.0, 60.0, 580.0, 510.0)
"""Left, top, width and height of the place of the figure."""
OWN = Path(__file__).with_name("card.css")


@dataclass(frozen=True, slots=True)
class Placed:
    """A panel in its place on a card."""

    panel: Panel
    picture: str
    """Its raster as a ``data:`` address; nothing for a pure drawing."""
    x: float
    y: float
    width: float
    height: float


def make_cards(
    book: Book, initial_frames: InitialFrames, pictures: Mapping[str, bytes], root: Path
) -> dict[str, bytes]:
    """PNG files by path: one for the book, one for each chapter.

    ``pictures`` are the files of the stills; ``root`` is the book's folder.
    """
    fonts = whole_fonts()
    style = card_style(root, fonts, book.colours)
    cover = _still(book.hero, initial_frames, pictures)

    def card(chapter: Chapter | None, title: str, figure: Placed | None) -> bytes:
        size, lines = set_title(title, TITLE_WIDTH if figure else WIDTH - 180, fonts.title)
        svg = render_template(
            "publishing/card.svg", book, style=style, chapter=chapter, size=size, lines=lines,
            figure=figure,
        )  # fmt: skip
        return png_of(svg, WIDTH, fonts)

    return {BOOK_CARD: card(None, book.title, cover)} | {
        card_path(chapter): card(
            chapter, chapter.title, next(_figures(chapter, initial_frames, pictures), cover)
        )
        for chapter in book.chapters
    }


def card_style(root: Path, fonts: Fonts, colours: Colours) -> str:
    """How cards and the drawings on them look, in plain CSS."""
    families = {"--serif": f"'{fonts.serif}'", "--sans": f"'{fonts.sans}'"}
    return style_of_drawings(root, OWN.read_text(encoding="utf-8"), families, colours)


def _figures(
    chapter: Chapter, initial_frames: InitialFrames, pictures: Mapping[str, bytes]
) -> Iterator[Placed]:
    """The chapter's first figure, then its illustrations."""
    for simulation in chapter.simulations[:1]:
        if drawn := _still(simulation, initial_frames, pictures):
            yield drawn
    for item in contents(chapter.body, DrawnIllustration):
        yield _placed(item.illustration.panels[0], "")


def _still(
    simulation: Simulation | None, initial_frames: InitialFrames, pictures: Mapping[str, bytes]
) -> Placed | None:
    """The main panel of a figure."""
    if simulation is None:
        return None
    still = initial_frames[simulation.path, simulation.line]
    panel = still.main_panel
    picture = still.pictures.get(panel.name)
    data = b64encode(as_png(pictures[picture.file])).decode() if picture else ""
    return _placed(panel, data and f"data:image/png;base64,{data}")


def _placed(panel: Panel, picture: str) -> Placed:
    """Place it in the middle, as large as there is room."""
    left, top, width, height = FIGURE
    scale = min(width / panel.width, height / panel.height)
    w, h = panel.width * scale, panel.height * scale
    return Placed(panel, picture, left + (width - w) / 2, top + (height - h) / 2, w, h)


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
