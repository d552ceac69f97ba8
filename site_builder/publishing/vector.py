"""Drawings as PNG: the icons of the site, pictures for editions, and the cards that a link to a
chapter shows where people share it, 1200 by 630 pixels."""

from base64 import b64encode
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import resvg_py

from simulations.engine.frame import Panel
from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.blocks import Simulation, contents
from site_builder.document.book import Book, Chapter
from site_builder.figures.frames import as_png
from site_builder.figures.initial_frames import InitialFrames
from site_builder.files.engine import book_or_engine_file
from site_builder.markdown.directives.pictures import DrawnIllustration
from site_builder.output.fonts import FACES, source_file
from site_builder.output.style_sheets import style_of_drawings
from site_builder.pages.environment import render_template
from site_builder.pages.single_page import BOOK_CARD, card_path

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont


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


def uncut_fonts() -> Fonts:
    """The files that the web fonts are cut from, and the names of their families."""
    paths = {face.file: source_file(face) for face in FACES}
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


ICON = "static/images/favicon.svg"
ICONS = {"images/favicon.png": 32, "images/touch-icon.png": 180}
"""File among the assets to its width in pixels."""


def make_icons(root: Path) -> Mapping[str, bytes]:
    """From the book's icon, or the engine's. Raises `BuildError` where it is no drawing."""
    file = book_or_engine_file(root, ICON)
    try:
        return _raster_icons(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BuildError([Diagnostic(ICON, 1, f"{error}; legal: a drawing in SVG")]) from error


@cached
def _raster_icons(svg: str) -> dict[str, bytes]:
    fonts = uncut_fonts()
    return {name: png_of(svg, width, fonts) for name, width in ICONS.items()}


WIDTH, HEIGHT = 1200, 630
TITLE_WIDTH = 440
"""What is left for a title beside a figure."""
FIGURE = (560.0, 60.0, 580.0, 510.0)
"""Left, top, width and height of the place of the figure."""
OWN = Path(__file__).with_name("card.css")


type Placed = dict[str, object]
"""A panel in its place on a card: itself, its raster as a ``data:`` address or nothing, left, top,
width and height."""


def make_cards(
    book: Book, initial_frames: InitialFrames, pictures: Mapping[str, bytes], root: Path
) -> dict[str, bytes]:
    """PNG files by path: one for the book, one for each chapter.

    ``pictures`` are the files of the stills; ``root`` is the book's folder.
    """
    fonts = uncut_fonts()
    families = {"--serif": f"'{fonts.serif}'", "--sans": f"'{fonts.sans}'"}
    style = style_of_drawings(root, OWN.read_text(encoding="utf-8"), families, book.colours)
    cover = _figure_panel(book.hero, initial_frames, pictures)

    def card(chapter: Chapter | None, title: str, figure: Placed | None) -> bytes:
        size, lines = fit_title(title, TITLE_WIDTH if figure else WIDTH - 180, fonts.title)
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


def _figures(
    chapter: Chapter, initial_frames: InitialFrames, pictures: Mapping[str, bytes]
) -> Iterator[Placed]:
    """The chapter's first figure, then its illustrations."""
    for simulation in chapter.simulations[:1]:
        if drawn := _figure_panel(simulation, initial_frames, pictures):
            yield drawn
    for item in contents(chapter.body, DrawnIllustration):
        yield _centred(item.illustration.panels[0], "")


def _figure_panel(
    simulation: Simulation | None, initial_frames: InitialFrames, pictures: Mapping[str, bytes]
) -> Placed | None:
    """The main panel of a figure."""
    if simulation is None:
        return None
    initial_frame = initial_frames[simulation.path, simulation.line]
    panel = initial_frame.main_panel
    picture = initial_frame.pictures.get(panel.name)
    data = b64encode(as_png(pictures[picture.file])).decode() if picture else ""
    return _centred(panel, data and f"data:image/png;base64,{data}")


def _centred(panel: Panel, picture: str) -> Placed:
    """Place it in the middle, as large as there is room."""
    left, top, width, height = FIGURE
    scale = min(width / panel.width, height / panel.height)
    w, h = panel.width * scale, panel.height * scale
    x, y = left + (width - w) / 2, top + (height - h) / 2
    return {"panel": panel, "picture": picture, "x": x, "y": y, "width": w, "height": h}


SIZES = (68, 60, 52, 46, 40, 34)
MOST_LINES = 4


def fit_title(title: str, width: float, font: Path) -> tuple[int, list[str]]:
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

    # Every Pillow has the basic layout; Raqm is optional.
    return ImageFont.truetype(font, size, layout_engine=ImageFont.Layout.BASIC)
