"""The first pass of a chapter: it takes no longer than the book allows, and needs nothing that is
folded."""

from collections.abc import Iterator

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.blocks import Deeper, Quiz, Simulation, contents
from site_builder.document.book import Book, Chapter
from site_builder.markdown.questions.code.kind import CodeTask
from site_builder.markdown.questions.figure.kind import FigureTask
from site_builder.render.minutes import reading_minutes

DEFINING = ("Equation", "Table", "Example", "Figure")
"""Kinds of targets that a reader needs where they are named; a section is merely pointed to."""


def check_first_passes(book: Book, problems: Diagnostics) -> None:
    """Report first passes that are too long, and what they use although only a deeper section
    has it: equations, tables, examples, figures and terms. Symbols are left out: most that first
    stand in a deeper section are explained again where they are used."""
    most = book.settings.first_pass
    for chapter in book.chapters:
        minutes = reading_minutes(chapter.first_pass)
        if minutes > most > 0:
            expected = f"at most {most}, with '{{.deeper}}' behind the headings of other sections"
            problems.add(chapter.path, 1, f"a first pass of {minutes} minutes; legal: {expected}")
        folded = {heading.id for heading in chapter.headings if heading.deeper}
        for line, name in (*_references(chapter, folded), *_questions(chapter)):
            message = f"the first pass needs {name}, which stands in a deeper section"
            problems.add(chapter.path, line, f"{message}; legal: a {{ref}} to that section")
        for line, term, place in _terms(book, chapter, folded):
            message = f"the first pass needs {term!r}, which {place} alone explains"
            expected = f"{{term}}`{term}`, which shows the definition"
            problems.add(chapter.path, line, f"{message}; legal: {expected}")


def _references(chapter: Chapter, folded: set[str]) -> Iterator[tuple[int, str]]:
    for use in chapter.references:
        if use.target.deeper and use.target.kind in DEFINING and use.section not in folded:
            yield use.line, use.target.name


def _questions(chapter: Chapter) -> Iterator[tuple[int, str]]:
    """Questions on a figure that is folded."""
    deeper = [block.inside for block in chapter.body if isinstance(block.content, Deeper)]
    figures = {figure.id for inside in deeper for figure in contents(inside, Simulation)}
    for quiz in contents(chapter.first_pass, Quiz):
        task = quiz.details
        if isinstance(task, FigureTask | CodeTask) and task.figure in figures:
            yield quiz.line, repr(task.figure)


def _terms(book: Book, chapter: Chapter, folded: set[str]) -> Iterator[tuple[int, str, str]]:
    """First uses of terms, with what explains them; not those that the author marked."""
    explained = {item.term.name: item.explained for item in book.glossary}
    seen: set[str] = set()
    for use in chapter.term_uses:
        place = explained.get(use.term)
        if place and place.deeper and use.section not in folded and use.term not in seen:
            seen.add(use.term)
            if not use.by_author:
                yield use.line, use.term, place.name
