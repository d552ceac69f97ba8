"""Small multiples: on paper, what a figure's main control does is shown by a few stills."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simulations.engine.controls import Choice, Control, Slider, Value
from simulations.engine.frame import Panel
from site_builder.document.book import Book
from site_builder.figures.frames import Picture, StaticFrame, pixels, static_frame
from site_builder.figures.initial_frames import InitialFrame, InitialFrames
from site_builder.figures.prerendered_frames import main_control
from site_builder.languages.words import Words
from site_builder.pages.views.control import value_text

MOST = 4
"""Stills in a row, at most."""
WAYS = (1 / 8, 1 / 2, 7 / 8)
"""The positions of a slider that is at its start, as parts of its range."""


@dataclass(frozen=True, slots=True)
class Multiple:
    """One still of the row."""

    text: str
    """The control's value, as the figure writes it."""
    panel: Panel
    file: str
    """Name of its picture; nothing for a pure diagram."""
    picture: Picture | None


@dataclass(frozen=True, slots=True)
class Row:
    """What one control does to one panel."""

    label: str
    """The control's."""
    multiples: tuple[Multiple, ...]


def render_rows(
    book: Book, initial_frames: InitialFrames
) -> tuple[dict[tuple[str, str], Row], dict[str, bytes]]:
    """The row of each figure that has one, by chapter and element id; and the pictures' files."""
    rows: dict[tuple[str, str], Row] = {}
    files: dict[str, bytes] = {}
    for chapter in book.chapters:
        for figure in chapter.simulations:
            name = f"{chapter.id}--{figure.id}"
            row = _row(name, initial_frames[figure.path, figure.line], files, book.words)
            if row:
                rows[chapter.id, figure.id] = row
    return rows, files


def _row(name: str, still: InitialFrame, files: dict[str, bytes], words: Words) -> Row | None:
    figure, scene = still.figure, still.figure.scene
    control = main_control(figure)
    if control is None:
        return None
    values = shown_values(control, still.values[control.name])
    settings = [scene.check({**figure.values, control.name: value}) for value in values]
    frames = [static_frame(scene, one, figure.tier) for one in settings]
    shown = _most_changed(frames)
    if shown is None:
        return None
    multiples: list[Multiple] = []
    for value, drawn in zip(values, frames, strict=True):
        panel = next(panel for panel in drawn.frame.panels if panel.name == shown)
        picture, file = drawn.pictures.get(shown), ""
        if picture:
            file = f"{name}--{shown}--{len(multiples)}.webp"
            files[file] = picture.webp
        multiples.append(Multiple(value_text(control, value, words), panel, file, picture))
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


def _most_changed(frames: Sequence[StaticFrame]) -> str | None:
    """Name of the panel whose pictures differ most or, where none has any, whose drawings do; None
    where nothing changes."""

    def change(name: str) -> tuple[float, int]:
        panels = [panel for each in frames for panel in each.frame.panels if panel.name == name]
        if len(panels) < len(frames):
            return 0.0, 0
        rasters = [pixels(each.pictures[name].webp) for each in frames if name in each.pictures]
        pairs = ((a, b) for a, b in pairwise(rasters) if a.shape == b.shape)
        difference = sum(float(np.abs(a.astype(float) - b).mean()) for a, b in pairs)
        return difference, len({panel.overlay for panel in panels}) - 1

    changes = {panel.name: change(panel.name) for panel in frames[0].frame.panels}
    name = max(changes, key=changes.__getitem__, default=None)
    return name if name and any(changes[name]) else None
