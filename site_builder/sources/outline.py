"""``book.toml`` of a book, its settings and words, and its chapters in order;
``content/lecture-plan.toml``: the sections of another textbook, and ours that teach them; and
``content/search.toml``: sections, and the words by which readers look for them.

The lecture plan only names sections. Their figures and questions are found in the chapters.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import takewhile
from string import ascii_uppercase

from site_builder.checks.frames import check_colours
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.book import OUTLINE, LecturePlan, Lesson, Taught
from site_builder.document.places import Position, Target, Targets, chapter_id
from site_builder.files.text import Sources, Toml
from site_builder.formulae.temml import Macros
from site_builder.languages.words import FOLDER, Words, book_words, languages, load_words
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.numbering import slug
from site_builder.settings.declared import Key, Reader, texts
from site_builder.settings.model import Settings, read_settings


def part_titles(parts: Mapping[str, str], chapters: Sequence[str]) -> list[str]:
    """For each of the ``chapters``, by id, the title of the part that it is in; nothing before the
    first part. ``parts``: title to the id of the first chapter."""
    begun = {first: title for title, first in parts.items()}
    titles, title = [], ""
    for chapter in chapters:
        title = begun.get(chapter, title)
        titles.append(title)
    return titles


def _check_parts(
    parts: Mapping[str, str], chapters: Sequence[str], toml: Toml, problems: Diagnostics
) -> None:
    """Report parts that begin with no chapter, and those that are not in the order of chapters."""
    last, before = -1, ""
    for title, first in parts.items():
        line = toml.line("parts", title)
        if first not in chapters:
            problems.add(OUTLINE, line, unknown("chapter", first, chapters))
            continue
        if (place := chapters.index(first)) <= last:
            message = f"part {title!r} begins with {first!r}, where {before!r} has begun"
            problems.add(OUTLINE, line, f"{message}; legal: a chapter after {chapters[last]!r}")
        last, before = max(last, place), title


OWN_FOLDERS = (
    "assets", "cards", "class", "embed", "glossary", "index-of-terms", "lecture-plan", "licences",
    "references", "runtime", "search", "source", "symbols",
)  # fmt: skip
"""Folders of the site beside those of its chapters."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outline:
    """``book.toml``, with its chapters in order."""

    settings: Settings
    words: Words
    """The language's, with the author's labels."""
    chapters: tuple[tuple[str, int, Position], ...]
    """File names without ``.md``, each with its line in this file and its place in the book."""
    hero_line: int
    link_lines: Mapping[str, int]
    """Of the title page, by the words of the link."""
    macros: Macros
    """Macros whose names are legal."""


def read_outline(sources: Sources) -> Outline:
    """The outline; mistakes are reported."""
    problems = sources.problems
    settings, toml = read_settings(sources)
    own = settings.language
    if own not in (known := languages(sources.root)):
        said = f"unknown language {own!r}; legal: {', '.join(known)}, or {FOLDER}/{own}.toml"
        problems.add(OUTLINE, toml.line("language"), said)
        settings = replace(settings, language="en")
    words = read_words(sources, settings.language).labelled(asdict(settings.labels))
    check_colours(settings, sources, toml)
    _check_parts(settings.parts, [*map(chapter_id, settings.chapters)], toml, problems)
    return Outline(
        settings=settings,
        words=words,
        chapters=tuple(
            (name, toml.line_of_text(name), position)
            for name, position in _positions(settings, words)
        ),
        hero_line=toml.line("hero"),
        link_lines=_link_lines(settings, toml),
        macros=_sound_macros(settings.macros, toml, problems),
    )


def read_words(sources: Sources, language: str) -> Words:
    """The words of a language, those of the book's own file first; its mistakes are reported."""
    path = f"{FOLDER}/{language}.toml"
    toml = sources.toml(path)
    if toml is None:
        return load_words(language if language in languages() else "en")
    words, faults, missing = book_words(language, toml.table)
    for key, fault in faults.items():
        sources.problems.add(path, toml.line(*key.split(".")), fault)
    if missing and not faults and language not in languages():
        said = f"{missing} texts of the interface are missing, and English; better: all of them"
        sources.problems.warn(path, 1, said)
    return words


def _link_lines(settings: Settings, toml: Toml) -> dict[str, int]:
    tables = {
        ("starts",): settings.starts,
        ("path", "stops"): settings.path.stops,
        ("boxes",): settings.boxes,
    }
    return {words: toml.line(*at, words) for at, links in tables.items() for words in links}


def _sound_macros(macros: Macros, toml: Toml, problems: Diagnostics) -> Macros:
    """Macros that TeX can name; the others are reported."""
    sound = {name: body for name, body in macros.items() if re.fullmatch(r"[A-Za-z]+", name)}
    for name in macros.keys() - sound.keys():
        message = f"macro {name!r} is no name; legal: letters, without a backslash"
        problems.add(OUTLINE, toml.line("macros", name), message)
    return sound


def _positions(settings: Settings, words: Words) -> Iterator[tuple[str, Position]]:
    """Chapters are numbered, appendices lettered from A."""
    chapters, first = settings.chapters, settings.first_number
    parts = part_titles(settings.parts, [*map(chapter_id, chapters)])
    for number, (name, part) in enumerate(zip(chapters, parts, strict=True), start=first):
        yield name, Position(number, str(number), "Chapter", words.label("Chapter"), part)
    appended = words("frame.appendices")
    for index, name in enumerate(settings.appendices):
        letter, number = ascii_uppercase[index % 26], first + len(chapters) + index
        yield name, Position(number, letter, "Appendix", words.label("Appendix"), appended)


def check_boxes(outline: Outline, problems: Diagnostics) -> None:
    """Report boxes whose name is malformed or already the name of a directive."""
    taken = {directive.name for directive in DIRECTIVES}
    for name in outline.settings.boxes:
        if name in taken or slug(name) != name:
            legal = "small letters, digits and hyphens, and no name that a directive has"
            problems.add(OUTLINE, outline.link_lines[name], f"box {name!r}; legal: {legal}")


def check_addresses(outline: Outline, problems: Diagnostics) -> None:
    """Two pages at one address: one would silently take the other's place."""
    taken = dict.fromkeys(OWN_FOLDERS, "a folder of the site's own")
    for name, line, _ in outline.chapters:
        address = chapter_id(name)
        if address in taken:
            message = f"chapter {name!r} has the address {address}/, as {taken[address]} has"
            problems.add(OUTLINE, line, f"{message}; legal: one of its own")
        taken.setdefault(address, f"chapter {name!r}")


LECTURE_PLAN = "content/lecture-plan.toml"
END = "questions"
"""Id of the section that closes a chapter."""


def read_lecture_plan(sources: Sources, targets: Targets) -> LecturePlan | None:
    """The plan; None where there is no such file. Mistakes are reported."""
    toml = sources.toml(LECTURE_PLAN)
    if toml is None:
        return None
    reader = Reader(LECTURE_PLAN, toml, sources.problems)
    read = reader.tables(Lesson, "section", ("intro",))
    if read is None:
        return None
    lessons: list[Lesson] = []
    for place, lesson in enumerate(read):
        sections = tuple(_sections(lesson, toml.line("section", place), targets, reader))
        chapters = dict.fromkeys(item.section.chapter for item in sections)
        closing = (end for chapter in chapters if (end := _closing(chapter, targets)))
        lessons.append(replace(lesson, sections=sections, closing=tuple(closing)))
    return LecturePlan(str(toml.table.get("intro", "")), tuple(lessons))


def _sections(lesson: Lesson, line: int, targets: Targets, reader: Reader) -> Iterator[Taught]:
    for name in lesson.taught:
        try:
            yield _taught(_section(name, targets), targets)
        except LookupError as error:
            reader.problems.add(LECTURE_PLAN, reader.toml.line_of_text(name, line), str(error))


def _section(name: str, targets: Targets) -> Target:
    found = targets.find(name, "")
    if found.kind != "Section" or "#" not in name:
        raise LookupError(f"{name!r} is {found.name}; legal: a section, 'chapter#section'")
    return found


def _taught(section: Target, targets: Targets) -> Taught:
    inside = targets.inside[section.chapter]
    own = [*takewhile(lambda each: each.kind != "Section", inside[inside.index(section) + 1 :])]
    return Taught(
        chapter=targets.chapters[section.chapter],
        section=section,
        figures=tuple(target for target in own if target.kind == "Figure"),
        questions=tuple(target for target in own if target.kind == "Question"),
    )


def _closing(chapter: str, targets: Targets) -> Taught | None:
    """The questions at the end of a chapter; None where it has none."""
    found = [t for t in targets.inside[chapter] if t.kind == "Section" and t.id == END]
    return _taught(found[0], targets) if found else None


SEARCH_WORDS = "content/search.toml"
WORDS = texts('["words of a reader", …]', least=1)


def read_search_words(
    sources: Sources, targets: Targets
) -> Iterator[tuple[Target, tuple[str, ...]]]:
    """Sections, and words by which readers look for them. Mistakes are reported."""
    toml = sources.toml(SEARCH_WORDS) or Toml()
    reader = Reader(SEARCH_WORDS, toml, sources.problems)
    declared = [Key(place, WORDS, "", (), "") for place in toml.table]
    taken: dict[str, str] = {}
    for place, asked in reader.values(declared, toml.table).items():
        for words in asked:
            if taken.setdefault(words.casefold(), place) != place:
                message = f"{words!r} leads to {taken[words.casefold()]}; legal: to one section"
                sources.problems.add(
                    SEARCH_WORDS, toml.line_of_text(words, toml.line(place)), message
                )
        try:
            yield _section(place, targets), asked
        except LookupError as error:
            reader.report((place,), str(error))
