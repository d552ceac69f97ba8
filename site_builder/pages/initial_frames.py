"""The first frame of every figure, computed at build time by the code that runs in the page."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from simulations.engine.controls import Value
from simulations.engine.frame import Frame
from simulations.engine.settings import values_of
from site_builder.book import Book
from site_builder.diagnostics import Diagnostics, cause
from site_builder.drawing.frames import Print, print_at
from site_builder.page_model.blocks import Simulation
from site_builder.pages.prerendered_frames import Strip, render_strip
from site_builder.sandbox import side_by_side


@dataclass(frozen=True, slots=True)
class StillPicture:
    """The pixels of a panel, as a page asks for them."""

    file: str
    """Name of the WebP."""
    width: int
    height: int


@dataclass(frozen=True, slots=True)
class InitialFrame:
    """A figure as it first appears."""

    figure: Simulation
    values: Mapping[str, Value]
    """Every control's starting value."""
    frame: Frame
    """Without its pixels."""
    pictures: Mapping[str, StillPicture]
    """By panel, for panels that have pixels."""
    strip: Strip | None = None
    """What can be shown of it before Python has started."""


type InitialFrames = dict[tuple[str, int], InitialFrame]
"""By the place of the directive: path and line."""


def render_initial_frames(
    book: Book, problems: Diagnostics, *, strips: bool = False
) -> tuple[InitialFrames, dict[str, bytes]]:
    """The frames of all figures, and their pictures by file name; ``strips`` too, if wanted."""
    initial_frames: InitialFrames = {}
    files: dict[str, bytes] = {}
    places = [(chapter.id, figure) for chapter in book.chapters for figure in chapter.simulations]
    if book.hero:
        places.insert(0, ("cover", book.hero))
    drawn = side_by_side(partial(_drawn, page, figure, strips=strips) for page, figure in places)
    for (page, figure), done in zip(places, drawn, strict=True):
        try:
            printed, strip = done.result()
        except Exception as error:  # whatever a scene's own code may raise is the author's to see
            message = f"simulation {figure.scene.id!r} cannot be drawn: {cause(error)}"
            problems.add(figure.path, figure.line, message)
            continue
        pictures = {}
        for panel, picture in printed.pictures.items():
            name = f"{page}--{figure.id}--{panel}.webp"
            pictures[panel] = StillPicture(name, picture.width, picture.height)
            files[name] = picture.webp
        values = values_of(figure.scene.check(figure.values))
        initial_frames[figure.path, figure.line] = InitialFrame(
            figure, values, printed.frame, pictures, strip
        )
    return initial_frames, files


def _drawn(page: str, figure: Simulation, *, strips: bool) -> tuple[Print, Strip | None]:
    printed = print_at(figure.scene, figure.scene.check(figure.values), figure.tier)
    return printed, render_strip(page, figure) if strips else None
