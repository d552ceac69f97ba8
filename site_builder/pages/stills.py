"""The first frame of every figure, computed at build time by the code that runs in the page."""

import io
from collections.abc import Mapping
from dataclasses import dataclass

from PIL import Image

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Raster
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache
from site_builder.book import Book, Simulation
from site_builder.diagnostics import Diagnostics, cause


@dataclass(frozen=True, slots=True)
class Still:
    """A figure as it first appears."""

    figure: Simulation
    values: Mapping[str, Value]
    """Every control's starting value."""
    frame: Frame
    pictures: Mapping[str, str]
    """Panel name to the file name of its PNG, for panels that have a raster."""


type Stills = dict[tuple[str, int], Still]
"""By the place of the directive: path and line."""


def render_stills(book: Book, problems: Diagnostics) -> tuple[Stills, dict[str, bytes]]:
    """The frames of all figures, and their PNG files by name."""
    stills: Stills = {}
    files: dict[str, bytes] = {}
    places = [(chapter.id, figure) for chapter in book.chapters for figure in chapter.simulations]
    if book.hero:
        places.insert(0, ("cover", book.hero))
    for page, figure in places:
        settings = figure.scene.check(figure.values)
        try:
            frame = figure.scene.render(settings, figure.tier, StageCache())
        except Exception as error:  # whatever a scene's own code may raise is the author's to see
            message = f"simulation {figure.scene.id!r} cannot be drawn: {cause(error)}"
            problems.add(figure.path, figure.line, message)
            continue
        pictures = {}
        for panel in frame.panels:
            if panel.raster is not None:
                name = f"{page}--{figure.id}--{panel.name}.png"
                pictures[panel.name] = name
                files[name] = png(panel.raster)
        stills[figure.path, figure.line] = Still(figure, values_of(settings), frame, pictures)
    return stills, files


def png(raster: Raster) -> bytes:
    """A raster as a PNG; without its alpha channel where that says nothing."""
    opaque = bool((raster[..., 3] == 255).all())
    buffer = io.BytesIO()
    Image.fromarray(raster[..., :3] if opaque else raster).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
