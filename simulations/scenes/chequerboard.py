"""A Board to Print: a chequerboard on the smallest sheet of paper that has room for it."""

import math
from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drafting import dimension, swatch_polygon
from simulations.engine.drawing import rectangle, text
from simulations.engine.export import Export
from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats, Mask
from simulations.models.chequerboard.board import FOOT_MM, Board, board_pdf, board_svg

WIDTH, HEIGHT = 400, 300
PIXELS = 2  # per unit of the view box
LEFT, TOP = 20.0, 18.0  # corner of the sheet, in units
ROOM = (360.0, 240.0)  # of the largest sheet, in units
OAK = np.array([168.0, 132.0, 95.0])  # codes of the table
THROW, DARKEST = 6.0, 0.7  # reach of the sheet's shadow, units, and the root of its depth
PAPERS = {
    "iso": {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0)},
    "us": {"Letter": (279.4, 215.9), "Tabloid": (431.8, 279.4), "ANSI C": (558.8, 431.8)},
}
"""Width and height in mm of sheets that lie on their long side (ISO 216; ANSI Y14.1)."""
PENCIL_MM, THICK_MM = 175.0, 7.5
PENCIL_END = (388.0, 284.0)  # of its rubber, in units; it points to the left
PENCIL: tuple[tuple[tuple[float, float], tuple[float, float], tuple[float, float, float]], ...] = (
    # Shares of the length, shares of the thickness, and the colour (sRGB) of each part
    ((0.0, 0.05), (0.0, 1.0), (0.85, 0.52, 0.50)),
    ((0.05, 0.10), (0.0, 1.0), (0.72, 0.72, 0.70)),
    ((0.10, 0.89), (0.0, 0.33), (0.98, 0.80, 0.30)),
    ((0.10, 0.89), (0.33, 0.67), (0.93, 0.70, 0.16)),
    ((0.10, 0.89), (0.67, 1.0), (0.74, 0.50, 0.10)),
)
WHITE, BLACK = (
    np.array(code, np.uint8).view(np.uint32)[0] for code in ((255,) * 4, (0, 0, 0, 255))
)
WOOD, LEAD = (0.91, 0.76, 0.57), (0.2, 0.2, 0.22)
ACROSS, DOWN = (4, 16), (3, 12)  # least and most squares


@dataclass(frozen=True, slots=True)
class Settings:
    side: int = slider("Side of a square", 20, 8, 60, 1, unit="mm")
    across: int = slider("Squares across", 10, *ACROSS, 1)
    down: int = slider("Squares down", 7, *DOWN, 1)
    series: str = choice("Paper", {"iso": "A4 or larger", "us": "Letter or larger"})


@dataclass(frozen=True, slots=True)
class Sheet:
    """The paper, and where the board lies on it, in the middle."""

    name: str
    """Empty if none is large enough; it is then as large as the board and its margin."""
    width_mm: float
    height_mm: float
    left_mm: float
    top_mm: float

    @property
    def scale(self) -> float:
        """Units per mm."""
        return min(ROOM[0] / self.width_mm, ROOM[1] / self.height_mm)

    def place(self, x_mm: float, y_mm: float) -> Point:
        """View box units of a place in mm from the corner of the board."""
        return (LEFT + self.scale * (self.left_mm + x_mm), TOP + self.scale * (self.top_mm + y_mm))


def board_of(settings: Settings) -> Board:
    return Board(settings.across, settings.down, float(settings.side))


def sheet_of(board: Board, series: str) -> Sheet:
    """The smallest paper of a series with room for the squares, a margin of one square, and a
    ruler."""
    side = board.side_mm
    width, height = (board.across + 2) * side, (board.down + 2) * side + FOOT_MM
    for name, (across, down) in PAPERS[series].items():
        if width <= across and height <= down:
            left, top = (across - width) / 2.0 + side, (down - height) / 2.0 + side
            return Sheet(name, across, down, left, top)
    return Sheet("", width, height, side, side)


def picture_of(board: Board, sheet: Sheet) -> Raster:
    """The board and the ruler on the sheet, which casts a shadow on a table."""
    y, x = (np.arange(PIXELS * length) + 0.5 for length in (HEIGHT, WIDTH))
    x_mm = (x / PIXELS - LEFT) / sheet.scale
    y_mm = (y / PIXELS - TOP) / sheet.scale
    column = np.floor((x_mm - sheet.left_mm) / board.side_mm)
    row = np.floor((y_mm - sheet.top_mm) / board.side_mm)
    shadow = np.multiply.outer(
        shadow_along(y, TOP, sheet.scale * sheet.height_mm),
        shadow_along(x, LEFT, sheet.scale * sheet.width_mm),
    )
    pixels = np.full((len(y), len(x), 4), 255, np.uint8)
    for channel, codes in enumerate(table()):  # faster than all channels in one product
        np.multiply(codes, 1.0 - shadow, out=pixels[..., channel], casting="unsafe")
    packed = pixels.view(np.uint32)[..., 0]
    paper = (
        span((y_mm >= 0) & (y_mm < sheet.height_mm)),
        span((x_mm >= 0) & (x_mm < sheet.width_mm)),
    )
    packed[paper] = WHITE
    rows, columns = (
        span((row >= 0) & (row < board.down)),
        span((column >= 0) & (column < board.across)),
    )
    packed[rows, columns][np.add.outer(row[rows], column[columns]) % 2 == 0] = BLACK
    along = span((x_mm >= sheet.left_mm) & (x_mm < sheet.left_mm + board.ruler_mm))
    ruler_mm = sheet.top_mm + (board.down + 1) * board.side_mm
    packed[span(np.abs(y_mm - ruler_mm) < 0.5 / sheet.scale), along] = BLACK
    return pixels


def span(inside: Mask) -> slice:
    """From the first to the last place (n,) that is inside."""
    places = np.flatnonzero(inside)
    return slice(places[0], places[-1] + 1) if places.size else slice(0)


def shadow_along(places: Floats, start: float, length: float) -> Floats:
    """(n,) how dark the sheet's shadow is along one axis: it lies a little farther on."""
    off = np.abs(places / PIXELS - start - length / 2 - THROW) - length / 2
    return np.asarray(DARKEST * np.exp(-((np.maximum(off, 0.0) / THROW) ** 2)), np.float32)


@cache
def table() -> NDArray[np.float32]:
    """(3, 600, 800) codes of its wood."""
    y, x = np.arange(PIXELS * HEIGHT)[:, None], np.arange(PIXELS * WIDTH)
    grain = 1.0 + 0.05 * np.sin(0.9 * y + 5.0 * np.sin(0.006 * x + 0.02 * y))
    return np.multiply.outer(OAK, grain).astype(np.float32)


def pencil(units_per_mm: float) -> str:
    """A pencil on the table, to the scale of the sheet."""
    long, thick = PENCIL_MM * units_per_mm, THICK_MM * units_per_mm

    def at(along: float, aside: float) -> Point:
        return PENCIL_END[0] - along * long, PENCIL_END[1] + (aside - 0.5) * thick

    bars = (
        swatch_polygon([at(a, top), at(b, top), at(b, foot), at(a, foot)], colour)
        for (a, b), (top, foot), colour in PENCIL
    )
    return "".join(
        (
            *bars,
            swatch_polygon([at(0.89, 0.0), at(1.0, 0.5), at(0.89, 1.0)], WOOD),
            swatch_polygon([at(0.97, 0.36), at(1.0, 0.5), at(0.97, 0.64)], LEAD),
        )
    )


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The sheet with the board, and the size of both."""
    board = board_of(settings)
    sheet = sheet_of(board, settings.series)
    corners = "{} × {}".format(*board.corners)
    paper = sheet.name or f"larger than {list(PAPERS[settings.series])[-1]}"
    size = " × ".join(format_number(length, 0) for length in (sheet.width_mm, sheet.height_mm))
    width, height = sheet.scale * sheet.width_mm, sheet.scale * sheet.height_mm
    (left, top), (right, _) = sheet.place(0.0, 0.0), sheet.place(board.side_mm, 0.0)
    above = top - 8.0  # of the first square, whose side is dimensioned
    ruler_end, ruler = sheet.place(board.ruler_mm, (board.down + 1) * board.side_mm)
    overlay = (
        rectangle((LEFT, TOP), width, height, "muted thin")
        + pencil(sheet.scale)
        + text((LEFT + 6.0, TOP + height + 24.0), f"{paper}, {size} mm", "small ground")
        + text((ruler_end + 6.0, ruler + 4.0), f"{board.ruler_mm} mm", "world small ground")
        + dimension((left, above), (right, above), "casing")
        + dimension((left, above), (right, above), "world")
        + text((right + 6.0, above + 4.0), f"{settings.side} mm", "world small ground")
    )
    picture, title = picture_of(board, sheet), "The board on its sheet"
    return Frame(
        (Panel("sheet", title, WIDTH, HEIGHT, picture, overlay, lead=True),),
        (
            Readout("corners", "Inner corners", corners, "", role="image"),
            Readout("paper", "Paper", paper, f"{size} mm"),
        ),
        f"A chequerboard of {settings.across} × {settings.down} squares of {settings.side} mm "
        f"with {corners} inner corners, on paper {paper} of {size} mm, beside a pencil.",
    )


def last_corner(board: Board, series: str) -> Point:
    """The place where the last square ends."""
    side = board.side_mm
    return sheet_of(board, series).place(board.across * side, board.down * side)


def last_corner_pulled(settings: Settings, place: Point) -> dict[str, int]:
    """The board that ends nearest, of all: each count may come with paper of another size."""
    counts = product(*(range(least, most + 1) for least, most in (ACROSS, DOWN)))
    boards = (Board(across, down, float(settings.side)) for across, down in counts)
    nearest = min(boards, key=lambda board: math.dist(last_corner(board, settings.series), place))
    return {"across": nearest.across, "down": nearest.down}


def as_pdf(settings: Settings, _outputs: Outputs) -> str:
    board = board_of(settings)
    sheet = sheet_of(board, settings.series)
    paper, corner = (sheet.width_mm, sheet.height_mm), (sheet.left_mm, sheet.top_mm)
    return board_pdf(board, paper, corner, f"{settings.side} mm a square")


def as_svg(settings: Settings, _outputs: Outputs) -> str:
    return board_svg(board_of(settings), f"{settings.side} mm a square")


SCENE = Scene(
    "chequerboard",
    "A Board to Print",
    Settings,
    draw,
    handles=(
        Handle(
            "corner",
            "sheet",
            "Last corner of the board",
            drives=("across", "down"),
            at=lambda settings, _: last_corner(board_of(settings), settings.series),
            pull=last_corner_pulled,
            role="image",
            reversed=("down",),
        ),
    ),
    instrument=Instrument(
        exports=(
            Export("board", "PDF to print", ".pdf", as_pdf),
            Export("chequerboard", "SVG", ".svg", as_svg),
        )
    ),
)
