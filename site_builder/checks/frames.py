"""What scenes and illustrations drew: that it is SVG, that style sheets know its classes, and that
it is no larger than a page can carry; and the colours that a book names for its ideas."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from itertools import chain
from pathlib import Path

from simulations.engine.frame import ROLES as COLOUR_ROLES
from simulations.engine.frame import Panel
from simulations.engine.scene import Scene
from site_builder.cache.hashing import module_of
from site_builder.cache.results import cached
from site_builder.checks.pictures import Label, read_overlay
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import walk
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Passage
from site_builder.editor.scene_code import formula_fault
from site_builder.figures.initial_frames import InitialFrames
from site_builder.files.engine import book_or_engine_file, static_files
from site_builder.files.folders import data_of, folder_files
from site_builder.files.text import CONTROL, Sources, Toml
from site_builder.markdown.directives.pictures import DrawnIllustration
from site_builder.markdown.roles import ROLES
from site_builder.settings.model import FILE_NAME, Settings

MOST_PIXELS, MOST_LETTERS = 4_000_000, 1_000_000
"""Limit for a panel, which a slider draws anew at every step."""
LETTER = 16.0
"""The height of a letter, in units of the view box."""
MOST_DATA = 2_000_000
"""Bytes of a file beside a module."""
NOT_SHOWN = "legal: a text of characters that can be shown"
CLASS = re.compile(r"\.([A-Za-z][\w-]*)")
NO_NUMBER = re.compile(r"[\s,\"'](-?(?:nan|inf))[\s,\"']")


def check_frames(
    book: Book, initial_frames: InitialFrames, static: Mapping[str, Path], problems: Diagnostics
) -> None:
    """Check the figures as they first appear, and the illustrations."""
    known = known_classes(static)
    roles = (*COLOUR_ROLES, *book.colours)
    known |= {*roles, "muted"} if known else known
    for (path, line), initial_frame in initial_frames.items():
        scene = initial_frame.figure.scene
        if fault := formula_fault(scene):
            problems.add(path, line, f"{scene.id}: {fault}")
        names = [control.name for control in scene.controls] + ["tier"] * bool(scene.accuracy.names)
        names += [readout.name for readout in initial_frame.frame.readouts]
        for name in initial_frame.figure.in_sight:
            if name not in names:
                which = f"control or readout of {scene.id}"
                problems.add(path, line, unknown(which, name, names))
        shown = [(item.name, item.role) for item in initial_frame.frame.readouts]
        for name, role in shown + [(handle.name, handle.role) for handle in scene.handles]:
            if role not in roles:
                said = unknown("colour role", role, roles[1:])
                own = module_of(scene) or ""
                problems.add_of(own, path, line, f"{scene.id}: {name!r} has an {said}")
        parts = (scene.title, scene.accuracy, scene.controls, scene.handles, initial_frame.frame)
        for text in filter(CONTROL.search, _texts(parts)):
            said = f"{scene.id}: {text!r}; {NOT_SHOWN}"
            problems.add_of(module_of(scene) or "", path, line, said)
        for panel in initial_frame.frame.panels:
            picture = initial_frame.pictures.get(panel.name)
            pixels = picture.width * picture.height if picture else 0
            _check_panel(
                scene.id,
                panel,
                pixels=pixels,
                known=known,
                place=(path, line),
                problems=problems,
                module=module_of(scene) or "",
            )
    for chapter in book.chapters:
        for line, text in _unshown(chapter):
            problems.add(chapter.path, line, f"{text!r}; {NOT_SHOWN}")
        for block in walk(chapter.body):
            line = block.target.line if block.target else 1
            if isinstance(block.content, DrawnIllustration):
                for panel in block.content.illustration.panels:
                    _check_panel(
                        "illustration",
                        panel,
                        pixels=0,
                        known=known,
                        place=(chapter.path, line),
                        problems=problems,
                    )


@cached
def _unshown(chapter: Chapter) -> list[tuple[int, str]]:
    """Texts of its blocks that no page can show, with the lines of the blocks."""
    return [
        (block.target.line if block.target else 1, text)
        for block in walk(chapter.body)
        for text in filter(CONTROL.search, _texts(block.content))
    ]


def _texts(value: object) -> Iterator[str]:
    """The texts in tuples, lists, mappings and dataclasses, but for drawings, and Markdown, which
    is checked as it is read."""
    match value:
        case str():
            yield value
        case Panel():
            yield value.title
        case Mapping():
            yield from _texts((*value.values(),))
        case tuple() | list():
            yield from chain.from_iterable(map(_texts, value))
        case _ if is_dataclass(value) and not isinstance(value, type | Passage | Scene):
            yield from _texts([getattr(value, field.name) for field in fields(value)])


def check_data(sources: Sources) -> None:
    """Warn of files beside modules that readers must wait for."""
    for name, module in folder_files(sources.root / "simulations").items():
        for data in data_of(module).values() if name.endswith(".py") else ():
            if (size := data.stat().st_size) > MOST_DATA:
                path = data.relative_to(sources.root).as_posix()
                said = f"{size / 1e6:.1f} MB travel to each reader with simulations/{name}"
                sources.problems.warn(path, 1, f"{said}; better: at most {MOST_DATA / 1e6:g} MB")


def known_classes(static: Mapping[str, Path]) -> frozenset[str]:
    """Classes in the style sheets; none where these have no rules for drawings."""
    sheets = [file for name, file in static.items() if name.startswith("css/")]
    texts = [file.read_text(encoding="utf-8") for file in sheets]
    names = frozenset(name for text in texts for name in CLASS.findall(text))
    return names if "overlay" in names else frozenset()


def _check_panel(
    owner: str,
    panel: Panel,
    *,
    pixels: int,
    known: frozenset[str],
    place: tuple[str, int],
    problems: Diagnostics,
    module: str = "",
) -> None:
    for message in _faults(panel, pixels, known):
        problems.add_of(module, *place, f"{owner}: panel {panel.name!r}: {message}")
    if len(panel.overlay) <= MOST_LETTERS:
        for label in read_overlay(panel.overlay).labels:
            if _is_outside(label, panel):
                where = f"a label at ({label.x:g}, {label.y:g}) of {panel.width} × {panel.height}"
                problems.warn(*place, f"{owner}: panel {panel.name!r}: {where} is not seen")


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
    overlay = read_overlay(panel.overlay)
    yield from (f"overlay: {fault.message}" for fault in overlay.faults[:3])
    if found := NO_NUMBER.search(panel.overlay):
        yield f"overlay: {found[1]!r} as a place or a size; legal: a finite number"
    if known:
        strange = sorted(overlay.classes - known)
        yield from (unknown("class", name, sorted(known)) for name in strange)


NAME = re.compile(r"[a-z]+")
PAIR = re.compile(r"(#[0-9a-f]{6}) (#[0-9a-f]{6})")
GROUND = re.compile(r"--(?:paper|raised|sunken): light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\)")
LEAST_CONTRAST = 4.5
"""Least contrast of text (WCAG 2.2, success criterion 1.4.3)."""

type Rgb = tuple[float, float, float]


def check_colours(settings: Settings, sources: Sources, toml: Toml) -> None:
    """Report names that are taken, values that are no pairs, and pairs that are hard to read."""
    if not settings.colours and not settings.theme.accent:
        return
    taken = known_classes(static_files(sources.root)) | {role.name for role in ROLES} | {"muted"}
    tokens = book_or_engine_file(sources.root, "static/css/tokens.css").read_text(encoding="utf-8")
    grounds = GROUND.findall(tokens)
    accent = {"accent": settings.theme.accent} if settings.theme.accent else {}
    for table, colours in (("colours", settings.colours), ("theme", accent)):
        for name, text in colours.items():
            pair = PAIR.fullmatch(text)
            if table == "colours" and (not NAME.fullmatch(name) or name in taken):
                fault = "; legal: small letters, not the name of a role or of a class"
            elif not pair:
                fault = f" is {text!r}; legal: two in small digits, '#125b9c #7fbaf2'"
            elif (least := _least_contrast(pair.groups(), grounds)) < LEAST_CONTRAST:
                legal = f"{LEAST_CONTRAST} with the light paper and with the dark"
                fault = f" has a contrast of {least:.2f}; legal: {legal}"
            else:
                continue
            sources.problems.add(FILE_NAME, toml.line(table, name), f"colour {name!r}{fault}")


def contrast(one: Rgb, other: Rgb) -> float:
    """Contrast ratio, WCAG 2.2: 1 for equal colours, 21 for black on white; sRGB from 0 to 1."""
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


def rgb(digits: str) -> Rgb:
    """sRGB from 0 to 1 of ``#rrggbb``."""
    red, green, blue = (int(digits[start : start + 2], 16) / 255 for start in (1, 3, 5))
    return red, green, blue


def _least_contrast(pair: tuple[str, ...], grounds: list[tuple[str, str]]) -> float:
    """With any ground of both themes; 21 where there is none."""
    both = ((colour, on) for ground in grounds for colour, on in zip(pair, ground, strict=True))
    return min((contrast(rgb(colour), rgb(on)) for colour, on in both), default=21.0)


def _luminance(colour: Rgb) -> float:
    """Relative luminance, WCAG 2.2."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
