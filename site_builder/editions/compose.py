"""The book as both editions on paper have it: the site's own pages, reduced, the answers, and small
multiples: what a figure's main control does, shown by a few stills."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from operator import attrgetter
from xml.etree.ElementTree import Element

import numpy as np

from simulations.engine.controls import Choice, Control, Slider, Value
from simulations.engine.frame import Panel
from site_builder.assets.page_assets import Files, gather_assets
from site_builder.build import Options, check_site
from site_builder.document.book import Book, Chapter
from site_builder.editions.tree import elements, parse
from site_builder.figures.frames import Picture, StaticFrame, pixels, static_frame
from site_builder.figures.initial_frames import InitialFrame, InitialFrames, main_control
from site_builder.files.folders import address_of
from site_builder.languages.words import Words
from site_builder.pages.back_matter import BACK_MATTER, back_matter_pages
from site_builder.pages.licences import Licence, gather_licences
from site_builder.pages.single_page import Site, render_page
from site_builder.pages.views.question import numbered_quizzes
from site_builder.pages.views.simulation import value_text
from site_builder.render.screen import paper_renderer
from site_builder.runtime.store import Versions

MOST = 4
"""Stills in a row, at most."""
WAYS = (1 / 8, 1 / 2, 7 / 8)
"""The positions of a slider that is at its start, as parts of its range."""


@dataclass(frozen=True, slots=True)
class Multiple:
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
) -> tuple[dict[str, dict[str, Row]], dict[str, bytes]]:
    """The row of each figure that has one, by chapter and element id; and the pictures' files."""
    rows: dict[str, dict[str, Row]] = {chapter.id: {} for chapter in book.chapters}
    files: dict[str, bytes] = {}
    for chapter in book.chapters:
        for figure in (each for each in chapter.simulations if not each.leader):
            initial_frame = initial_frames[figure.path, figure.line]
            row = _row(f"{chapter.id}--{figure.id}", initial_frame, files, book.words)
            rows[chapter.id] |= {figure.id: row} if row else {}
    return rows, files


def _row(
    name: str, initial_frame: InitialFrame, files: dict[str, bytes], words: Words
) -> Row | None:
    figure, scene = initial_frame.figure, initial_frame.figure.scene
    control = main_control(figure)
    if control is None:
        return None
    values = shown_values(control, initial_frame.values[control.name])
    settings = [scene.check({**figure.values, control.name: value}) for value in values]
    frames = [static_frame(scene, one, figure.tier) for one in settings]
    shown = _most_changed(frames, [panel.name for panel in initial_frame.frame.panels])
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
    """The row's values in order, including the figure's own value."""
    match control:
        case Slider():
            return list(_slider_values(control, float(now)))
        case Choice():
            return _near(list(control.options), str(now))
        case _:
            return []


def _slider_values(slider: Slider, now: float) -> list[float]:
    """Half-way to either end; within a tenth of one end, two points towards the other."""
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


def _most_changed(frames: Sequence[StaticFrame], shown: Sequence[str]) -> str | None:
    """Name of the panel, of those ``shown``, whose pictures differ most or, where none has any,
    whose drawings do; None where nothing changes."""

    def change(name: str) -> tuple[float, int]:
        panels = [panel for each in frames for panel in each.frame.panels if panel.name == name]
        if len(panels) < len(frames):
            return 0.0, 0
        rasters = [pixels(each.pictures[name].webp) for each in frames if name in each.pictures]
        pairs = ((a, b) for a, b in pairwise(rasters) if a.shape == b.shape)
        difference = sum(float(np.abs(a.astype(float) - b).mean()) for a, b in pairs)
        return difference, len({panel.overlay for panel in panels}) - 1

    changes = {name: change(name) for name in shown}
    name = max(changes, key=changes.__getitem__, default=None)
    return name if name and any(changes[name]) else None


ANSWERS = "answers"


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundSection:
    """A chapter, or what follows the last."""

    id: str
    """Id of a chapter; else ``answers``, or one of `BACK_MATTER`."""
    title: str
    number: str
    """``Chapter 4``, ``Appendix A``; nothing for what follows."""
    article: Element
    """Its links are those of the site, from ``ID/index.html``."""
    headings: tuple[tuple[str, str], ...] = ()
    """Id and HTML of what the contents list below its title."""
    part: str = ""
    """Title of the part of the book that it is in; nothing where it is in none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Composed:
    """What an edition is made from."""

    book: Book
    sections: tuple[BoundSection, ...]
    cover: str
    """Address of the title page's picture, relative to the site's root; nothing without one."""
    assets: str
    """Folder of the files, relative to the site's root."""
    files: Files
    licences: tuple[Licence, ...]

    @property
    def parts(self) -> tuple[tuple[str, tuple[BoundSection, ...]], ...]:
        groups = groupby(self.sections, attrgetter("part"))
        return tuple((title, tuple(sections)) for title, sections in groups)

    @property
    def ids(self) -> tuple[str, ...]:
        return tuple(section.id for section in self.sections)


def compose(options: Options) -> Composed:
    """Read, check and render the book. Raises `BuildError` with all mistakes found."""
    book, initial_frames, pictures = check_site(options)
    rows, row_pictures = render_rows(book, initial_frames)
    assets = gather_assets(book, options.root, {**pictures, **row_pictures}, {})
    site = Site(
        root=options.root,
        book=book,
        initial_frames=initial_frames,
        assets=assets.folder,
        runtime="",
    )
    licences = gather_licences(options.root, Versions(), settings=book.settings, words=book.words)
    sections = [
        *(_chapter(site, chapter, rows[chapter.id]) for chapter in book.chapters),
        *_answers(site),
        *_back_matter(site),
    ]
    cover = ""
    if book.hero:
        shown = initial_frames[book.hero.path, book.hero.line].pictures.values()
        cover = next((f"{assets.folder}stills/{address_of(picture.file)}" for picture in shown), "")
    return Composed(
        book=book,
        sections=tuple(sections),
        cover=cover,
        assets=assets.folder,
        files=assets.files,
        licences=licences,
    )


def _chapter(site: Site, chapter: Chapter, rows: Mapping[str, Row]) -> BoundSection:
    html = render_page(site, "chapter.html", "../", rows=rows, chapter=chapter, sections=())
    words = paper_renderer()
    headings = tuple((item.id, words(item.words)) for item in chapter.headings if item.level == 2)
    return BoundSection(
        id=chapter.id,
        title=chapter.title,
        number=chapter.name,
        article=parse(html),
        headings=headings,
        part=chapter.part,
    )


def _back_matter(site: Site) -> Iterator[BoundSection]:
    """What the site has of it."""
    for id, context in back_matter_pages(site.book).items():
        html = render_page(site, f"{id}.html", "../", rows={}, **context)
        yield BoundSection(
            id=id, title=site.book.words(BACK_MATTER[id]), number="", article=parse(html)
        )


def _answers(site: Site) -> Iterator[BoundSection]:
    chapters = [
        (chapter, questions)
        for chapter in site.book.chapters
        if (questions := list(numbered_quizzes(chapter.body)))
    ]
    if chapters:
        html = render_page(site, "editions/answers.html", "../", rows={}, chapters=chapters)
        article = parse(html)
        for (chapter, _), answers in zip(
            chapters, elements(article, kind="answers-of"), strict=True
        ):
            for link in elements(answers, "a"):
                if (place := link.get("href", "")).startswith("#"):  # on the question's page
                    link.set("href", f"../{chapter.url}{place}")
        yield BoundSection(
            id=ANSWERS, title=site.book.words("edition.answers"), number="", article=article
        )
