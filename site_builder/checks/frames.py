"""What scenes and illustrations drew: that it is SVG, that style sheets know its classes, and that
it is no larger than a page can carry."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from simulations.engine.frame import ROLES, Panel
from site_builder.cache.results import cached
from site_builder.checks.svg import Label, read_overlay
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import Block
from site_builder.document.book import Book
from site_builder.editor.scene_code import formula_fault
from site_builder.figures.initial_frames import InitialFrames
from site_builder.markdown.directives.pictures import DrawnIllustration

MOST_PIXELS, MOST_LETTERS = 4_000_000, 1_000_000
"""Limit for a panel, which a slider draws anew at every step."""
LETTER = 16.0
"""The height of a letter, in units of the view box."""
CLASS = re.compile(r"\.([A-Za-z][\w-]*)")
NO_NUMBER = re.compile(r"[\s,\"'](-?(?:nan|inf))[\s,\"']")


@dataclass(frozen=True, slots=True)
class _Overlay:
    """What was found in the drawing of a panel."""

    faults: tuple[str, ...]
    classes: frozenset[str]
    labels: tuple[Label, ...]


def check_frames(
    book: Book, initial_frames: InitialFrames, static: Mapping[str, Path], problems: Diagnostics
) -> None:
    """Check the figures as they first appear, and the illustrations."""
    known = known_classes(static)
    roles = (*ROLES, *book.colours)
    known |= {*roles, "muted"} if known else known
    for (path, line), still in initial_frames.items():
        scene = still.figure.scene
        if fault := formula_fault(scene):
            problems.add(path, line, f"{scene.id}: {fault}")
        names = [control.name for control in scene.controls] + ["tier"] * bool(scene.tiers)
        names += [readout.name for readout in still.frame.readouts]
        for name in still.figure.in_sight:
            if name not in names:
                which = f"control or readout of {scene.id}"
                problems.add(path, line, unknown(which, name, names))
        shown = [(item.name, item.role) for item in still.frame.readouts]
        for name, role in shown + [(handle.name, handle.role) for handle in scene.handles]:
            if role not in roles:
                said = unknown("colour role", role, roles[1:])
                problems.add(path, line, f"{scene.id}: {name!r} has an {said}")
        for panel in still.frame.panels:
            picture = still.pictures.get(panel.name)
            pixels = picture.width * picture.height if picture else 0
            _check(still.figure.scene.id, panel, pixels, known, (path, line), problems)
    for chapter in book.chapters:
        for block in _all(chapter.body):
            if isinstance(block.content, DrawnIllustration):
                line = block.target.line if block.target else 1
                for panel in block.content.illustration.panels:
                    _check("illustration", panel, 0, known, (chapter.path, line), problems)


def known_classes(static: Mapping[str, Path]) -> frozenset[str]:
    """Classes in the style sheets; none where these have no rules for drawings."""
    sheets = [file for name, file in static.items() if name.startswith("css/")]
    texts = [file.read_text(encoding="utf-8") for file in sheets]
    names = frozenset(name for text in texts for name in CLASS.findall(text))
    return names if "overlay" in names else frozenset()


def _all(blocks: Sequence[Block]) -> Iterator[Block]:
    for block in blocks:
        yield block
        yield from _all(block.inside)


def _check(
    who: str,
    panel: Panel,
    pixels: int,
    known: frozenset[str],
    place: tuple[str, int],
    problems: Diagnostics,
) -> None:
    for message in _faults(panel, pixels, known):
        problems.add(*place, f"{who}: panel {panel.name!r}: {message}")
    if len(panel.overlay) <= MOST_LETTERS:
        for label in _read(panel.overlay).labels:
            if _is_outside(label, panel):
                where = f"a label at ({label.x:g}, {label.y:g}) of {panel.width} × {panel.height}"
                problems.warn(*place, f"{who}: panel {panel.name!r}: {where} is not seen")


def _is_outside(label: Label, panel: Panel) -> bool:
    """Whether no letter of it can be in the panel."""
    before = label.x <= 0 and label.anchor == "end"
    beyond = label.x >= panel.width and label.anchor == "start"
    return before or beyond or label.y <= 0 or label.y >= panel.height + LETTER


def _faults(panel: Panel, pixels: int, known: frozenset[str]) -> Iterator[str]:
    if pixels > MOST_PIXELS:
        yield f"a raster of {pixels:,} pixels; legal: at most {MOST_PIXELS:,}"
    if len(panel.overlay) > MOST_LETTERS:
        yield f"an overlay of {len(panel.overlay):,} letters; legal: at most {MOST_LETTERS:,}"
        return
    overlay = _read(panel.overlay)
    yield from overlay.faults
    if known:
        strange = sorted(overlay.classes - known)
        yield from (unknown("class", name, sorted(known)) for name in strange)


@cached
def _read(markup: str) -> _Overlay:
    drawing = read_overlay(markup)
    faults = [f"overlay: {fault.message}" for fault in drawing.faults[:3]]
    if found := NO_NUMBER.search(markup):
        faults.append(f"overlay: {found[1]!r} as a place or a size; legal: a finite number")
    return _Overlay(tuple(faults), drawing.classes, drawing.labels)
