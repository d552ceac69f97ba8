"""Small multiples: on paper, what a figure's main control does is shown by a few stills."""

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.controls import Choice, Control, Slider, Value
from simulations.engine.frame import Frame, Panel
from simulations.engine.stages import StageCache
from site_builder.book import Book
from site_builder.figures.frames import png
from site_builder.figures.initial_frames import InitialFrame, InitialFrames
from site_builder.figures.main_control import main_control
from site_builder.languages.words import Words
from site_builder.page_model.blocks import Simulation
from site_builder.pages.views.control import value_text

MOST = 4
"""Stills in a row, at most."""
WAYS = (1 / 8, 1 / 2, 7 / 8)
"""Where on its way a slider is shown, if it stands at its start now."""


@dataclass(frozen=True, slots=True)
class Multiple:
    """One still of the row."""

    text: str
    """The control's value, as the figure writes it."""
    panel: Panel
    picture: str
    """File name of its PNG; nothing for a pure diagram."""


@dataclass(frozen=True, slots=True)
class Row:
    """What one control does to one panel."""

    label: str
    """The control's."""
    multiples: tuple[Multiple, ...]


def render_rows(
    book: Book, initial_frames: InitialFrames
) -> tuple[dict[tuple[str, str], Row], dict[str, bytes]]:
    """The row of each figure that has one, by chapter and element id; and the PNG files."""
    rows: dict[tuple[str, str], Row] = {}
    files: dict[str, bytes] = {}
    for chapter in book.chapters:
        for figure in chapter.simulations:
            row = _row(chapter.id, initial_frames[figure.path, figure.line], files, book.words)
            if row:
                rows[chapter.id, figure.id] = row
    return rows, files


def _row(page: str, still: InitialFrame, files: dict[str, bytes], words: Words) -> Row | None:
    figure = still.figure
    control = main_control(figure)
    if control is None:
        return None
    values = shown_values(control, still.values[control.name])
    frames = dict(_frames(figure, control, values))
    shown = _most_changed(list(frames.values()))
    if shown is None:
        return None
    multiples: list[Multiple] = []
    for value, frame in frames.items():
        panel = next(panel for panel in frame.panels if panel.name == shown)
        name = ""
        if panel.raster is not None:
            name = f"{page}--{figure.id}--{shown}--{len(multiples)}.png"
            files[name] = png(panel.raster)
        multiples.append(Multiple(value_text(control, value, words), panel, name))
    return Row(control.label, tuple(multiples))


def shown_values(control: Control, now: Value) -> list[Value]:
    """The values that the row shows, in their order, that of the figure among them."""
    match control:
        case Slider():
            return list(_slider_values(control, float(now)))
        case Choice():
            return _near(list(control.options), str(now))
        case _:
            return []


def _slider_values(slider: Slider, now: float) -> list[float]:
    """Half-way to either end; where there is no way to one of them, points on the other's."""
    low, high = slider.minimum, slider.maximum
    wide = (high - low) / 10
    if now - low > wide and high - now > wide:
        places = [(low + now) / 2, now, (now + high) / 2]
    else:
        end = high if now - low <= wide else low
        places = [now, now + (end - now) * WAYS[1], now + (end - now) * WAYS[2]]
    return sorted({now, *(slider.nearest(place) for place in places if place != now)})


def _near(options: list[str], now: str) -> list[Value]:
    """A window of the options around the present one."""
    start = min(max(0, options.index(now) - MOST // 2), max(0, len(options) - MOST))
    return list(options[start : start + MOST])


def _frames(
    figure: Simulation, control: Control, values: list[Value]
) -> Iterator[tuple[Value, Frame]]:
    cache = StageCache()
    given: Mapping[str, object] = figure.values
    for value in values:
        settings = figure.scene.check({**given, control.name: value})
        yield value, figure.scene.render(settings, figure.tier, cache)


def _most_changed(frames: list[Frame]) -> str | None:
    """Name of the panel that tells most; pictures before diagrams. None if nothing changes."""
    changes = {
        panel.name: (_picture_change(frames, panel.name), _drawing_change(frames, panel.name))
        for panel in frames[0].panels
        if all(panel.name in [other.name for other in frame.panels] for frame in frames)
    }
    name = max(changes, key=lambda name: changes[name], default=None)
    return name if name and any(changes[name]) else None


def _pick(frame: Frame, name: str) -> Panel:
    return next(panel for panel in frame.panels if panel.name == name)


def _picture_change(frames: list[Frame], name: str) -> float:
    rasters = [_pick(frame, name).raster for frame in frames]
    pairs = [
        (a, b)
        for a, b in itertools.pairwise(rasters)
        if a is not None and b is not None and a.shape == b.shape
    ]
    return sum(float(np.abs(a.astype(float) - b.astype(float)).mean()) for a, b in pairs)


def _drawing_change(frames: list[Frame], name: str) -> int:
    """How many of the drawings differ."""
    return len({_pick(frame, name).overlay for frame in frames}) - 1
