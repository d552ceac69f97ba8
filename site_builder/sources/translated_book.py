"""Reading the translations of a book, each a book of its own: chapters that are not translated are
those of the original."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, replace
from typing import Any

from simulations.engine.scene import Scene
from site_builder.benchmarks.measurements import Measurements
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Position, Targets
from site_builder.files.text import Sources
from site_builder.languages.words import Words
from site_builder.markdown.chapter import find_targets
from site_builder.markdown.glossary import read_definitions
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.references.terms import read_glossary
from site_builder.sources.book import (
    ChapterFile,
    list_pages,
    read_hero_caption,
    read_links,
    read_shared,
    targets_state,
)
from site_builder.sources.outline import (
    Outline,
    check_parts,
    link_lines,
    positions,
    read_outline,
)
from site_builder.sources.translations.agreement import check_contents, check_places, with_shared
from site_builder.sources.translations.files import (
    file_of,
    folder_of,
    read_labels,
    translated_glossary,
    translated_settings,
)


def read_translations(
    sources: Sources,
    original: Book,
    load_scene: Callable[[str], Scene[Any]],
    measurements: Measurements | None = None,
) -> tuple[Book, ...]:
    """All translations; mistakes are reported and reading goes on."""
    known = sources.aside()  # mistakes of the original are reported already
    outline, problems = read_outline(known), sources.problems
    terms = read_glossary(known, original.words)

    def read(language: str) -> Book:
        own = _outline(sources, original.words_of[language], outline)
        glossary = translated_glossary(sources, own.words, terms)
        shared = read_shared(known, own, glossary, load_scene, measurements)
        pages = list(list_pages(own, shared, known))
        targets = find_targets([page.survey() for page in pages], known.problems)
        chapters = _chapters(pages, targets, original, own, problems)
        definitions = ParseContext(
            file_of(language, "glossary.toml"), shared, problems, targets=targets
        )
        return replace(
            original,
            title=own.settings.title,
            subtitle=own.settings.subtitle,
            prerequisites=own.settings.prerequisites,
            settings=own.settings,
            words=own.words,
            hero=_hero(original, own, shared, problems),
            starts=tuple(_links("starts", original, own, targets, problems)),
            stops=tuple(_links("path", original, own, targets, problems)),
            chapters=tuple(chapters),
            bibliography=shared.bibliography,
            glossary=read_definitions(definitions),
            news=(),
            folder=own.folder,
        )

    return tuple(read(language) for language in list(original.languages)[1:])


def _outline(sources: Sources, words: Words, original: Outline) -> Outline:
    language = words.language
    settings, toml = translated_settings(sources, language, original.settings)
    words = replace(
        words.labelled(asdict(settings.labels)),
        figures=read_labels(sources, language),
    )
    if toml.table.get("parts"):
        begun, path = [*original.settings.parts.values()], file_of(language)
        check_parts(settings.parts, begun, toml, sources.problems, path)
        for chapter in begun:
            if chapter not in settings.parts.values():
                message = f"no part begins with {chapter!r}; legal: the parts of {original.path}"
                sources.problems.add(path, toml.line("parts"), message)
    places: Mapping[str, Position] = dict(positions(settings, words))
    return replace(
        original,
        settings=settings,
        words=words,
        chapters=tuple((name, line, places[name]) for name, line, _ in original.chapters),
        hero_line=toml.line("hero_caption"),
        link_lines=link_lines(settings, toml),
        path=file_of(language),
        folder=folder_of(language),
    )


def _chapters(
    pages: list[ChapterFile],
    targets: Targets,
    original: Book,
    outline: Outline,
    problems: Diagnostics,
) -> Iterator[Chapter]:
    """In their order, and what is not the same in a translation reported."""
    state = targets_state(targets)
    for page, first in zip(pages, original.chapters, strict=True):
        if page.path == first.path:
            yield replace(first, position=page.position)
            continue
        chapter = page.read(targets, state, problems)
        text = Sources(page.shared.root).text(first.path)
        survey = ChapterFile(first.path, text, page.position, page.shared, page.state).survey()
        check_places(first, survey.inside, chapter, targets.inside[chapter.id], problems)
        check_contents(first, chapter, problems)
        yield with_shared(chapter, first, outline.folder)


def _hero(book: Book, outline: Outline, shared: Shared, problems: Diagnostics) -> Simulation | None:
    """The figure of the title page, with its caption translated."""
    is_translated = outline.settings.hero_caption != book.settings.hero_caption
    told = problems if is_translated else Diagnostics()
    return book.hero and replace(book.hero, caption=read_hero_caption(outline, shared, told))


def _links(
    table: str, book: Book, outline: Outline, targets: Targets, problems: Diagnostics
) -> Iterator[tuple[str, str]]:
    links, originals = (getattr(each.settings, table) for each in (outline, book))
    told = problems if links != originals else Diagnostics()
    links = links.stops if table == "path" else links
    for words, address in read_links(links, outline, targets, told):
        there = address.partition("/")[0] in book.languages[outline.settings.language]
        yield words, f"{outline.folder}{address}" if there else address
