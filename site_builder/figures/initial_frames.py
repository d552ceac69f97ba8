"""The first frame of every figure, and those of its main control for use before Python has started:
computed at build time by the code that runs in the page."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from simulations.engine.controls import Action, Choice, Control, Slider, Toggle, Value
from simulations.engine.frame import Frame, Panel, to_json
from simulations.engine.settings import values_of
from site_builder.diagnostics.diagnostic import Diagnostics, cause, unknown
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book
from site_builder.figures.frames import StaticFrame, small_frames, static_frame
from site_builder.pool.processes import side_by_side


def main_control(figure: Simulation) -> Control | None:
    """The first whose values can be shown side by side. A menu that chooses a picture shows
    less than a slider."""
    controls = figure.scene.controls
    ordered = [*(c for c in controls if isinstance(c, Slider)), *controls]
    if controls and isinstance(controls[0], Choice):
        ordered.insert(0, controls[0])
    return next((c for c in ordered if not isinstance(c, Action | Toggle)), None)


FRAMES = 11
"""Number of frames of a slider, from end to end."""


@dataclass(frozen=True, slots=True)
class PrerenderedFrames:
    """Frames of one control, all others as the figure starts."""

    file: str
    data: bytes
    """JSON: the control, and of each frame its value, its panels' pictures and what the worker
    would send with them."""


def prerender(
    page: str, figure: Simulation, parts: Sequence[Simulation] = ()
) -> PrerenderedFrames | None:
    """The frames of a figure, with the panels of its ``parts``; None where it has no control that
    can be shown so, or is itself a part.

    Raises whatever the scene does, and `KilledError`."""
    control = main_control(figure)
    if control is None or figure.leader:
        return None
    together = (figure, *parts)
    shown = {name for each in together for name in each.panels}
    if not all(each.panels for each in together):
        shown = set()  # all of them
    start = values_of(figure.scene.check(figure.values))
    values = shown_values(control, start[control.name])
    settings = tuple({**start, control.name: value} for value in values)
    frames = []
    for value, small in zip(values, small_frames(figure.scene, settings, figure.tier), strict=True):
        panels = tuple(p for p in small.frame.panels if p.name in shown or not shown)
        frame = json.loads(to_json(replace(small.frame, panels=panels)))
        names = [panel.name for panel in panels]
        pictures = {name: url for name, url in small.pictures.items() if name in names}
        frames.append({"value": value, "pictures": pictures, **frame})
    data = {"control": control.name, "frames": frames}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    return PrerenderedFrames(f"{page}--{figure.id}.json", text.encode())


def shown_values(control: Control, start: Value) -> tuple[Value, ...]:
    """Values of ``control`` from end to end, ``start`` among them."""
    if not isinstance(control, Slider):
        return tuple(control.options) if isinstance(control, Choice) else (start,)
    places = np.linspace(control.minimum, control.maximum, FRAMES)
    return tuple(sorted({float(start), *(control.nearest(float(place)) for place in places)}))


LONGEST_NAME = 255
"""Bytes of a file's name."""


@dataclass(frozen=True, slots=True)
class PanelFile:
    """The pixels of a panel as a file of the site."""

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
    """Without its pixels; its panels are those that the figure shows, in their order."""
    pictures: Mapping[str, PanelFile]
    """By panel, for panels that have pixels."""
    prerendered: PrerenderedFrames | None = None
    """What can be shown of it before Python has started."""

    @property
    def main_panel(self) -> Panel:
        """What stands for the figure where there is room for one panel: a picture rather than a
        drawing, and the lead rather than another."""
        return min(
            self.frame.panels, key=lambda panel: (panel.name not in self.pictures, not panel.lead)
        )


type InitialFrames = dict[tuple[str, int], InitialFrame]
"""Frames by the place of the directive: path and line."""


def describing(initial_frames: InitialFrames) -> Callable[[Simulation], str]:
    """Describes the initial frame of a figure in a sentence."""
    return lambda figure: initial_frames[figure.path, figure.line].frame.description


def render_initial_frames(
    book: Book, problems: Diagnostics, *, prerendered: bool = False
) -> tuple[InitialFrames, dict[str, bytes]]:
    """The initial frames of all figures, with ``prerendered`` ones if wanted; and their pictures by
    file name."""
    initial_frames: InitialFrames = {}
    files: dict[str, bytes] = {}
    places = [(chapter.id, figure) for chapter in book.chapters for figure in chapter.simulations]
    if book.hero:
        places.insert(0, ("cover", book.hero))
    jobs = (
        partial(_drawn, page, figure, parts_of(figure, places) if prerendered else None)
        for page, figure in places
    )
    drawn = side_by_side(jobs, "figures")
    for (page, figure), done in zip(places, drawn, strict=True):
        try:
            first, others = done.result()
        except Exception as error:  # whatever a scene's own code may raise is the author's to see
            message = f"simulation {figure.scene.id!r} cannot be drawn: {cause(error)}"
            problems.add(figure.path, figure.line, message, error)
            continue
        if not first.frame.panels:
            message = f"{figure.scene.id}: a frame without panels; legal: at least one"
            problems.add(figure.path, figure.line, message)
            continue
        panels = {panel.name: panel for panel in first.frame.panels}
        for name in figure.panels:
            if name not in panels:
                message = unknown(f"panel of {figure.scene.id}", name, panels)
                problems.add(figure.path, figure.line, message)
        shown = [panels[name] for name in figure.panels or panels if name in panels]
        pictures = {}
        for panel, picture in first.pictures.items():
            if panels[panel] not in shown:
                continue
            name = f"{page}--{figure.leader or figure.id}--{panel}.webp"
            if "/" in panel or len(name.encode()) > LONGEST_NAME:
                message = f"panel {panel!r} names a file; legal: without '/', and shorter"
                problems.add(figure.path, figure.line, f"{figure.scene.id}: {message}")
                continue
            pictures[panel] = PanelFile(name, picture.width, picture.height)
            files[name] = picture.webp
        values = values_of(figure.scene.check(figure.values))
        initial_frames[figure.path, figure.line] = InitialFrame(
            figure, values, replace(first.frame, panels=tuple(shown)), pictures, others
        )
    return initial_frames, files


def parts_of(figure: Simulation, places: Sequence[tuple[str, Simulation]]) -> list[Simulation]:
    """The parts of a figure, of all figures of a book with their pages."""
    return [part for _, part in places if (part.path, part.leader) == (figure.path, figure.id)]


def _drawn(
    page: str, figure: Simulation, parts: Sequence[Simulation] | None
) -> tuple[StaticFrame, PrerenderedFrames | None]:
    first = static_frame(figure.scene, figure.scene.check(figure.values), figure.tier)
    return first, None if parts is None else prerender(page, figure, parts)
