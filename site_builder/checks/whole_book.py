"""What can be checked only when all chapters are read: links between them, ids across them, and
what belongs together on a page."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePosixPath

from site_builder.checks.questions import check_figure_questions, check_questions
from site_builder.checks.terms import check_glossary, check_order, check_symbols
from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.document.blocks import contents
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Link
from site_builder.document.questions import Prediction, Quiz, Reveal
from site_builder.references.bibliography import FILE as BIBLIOGRAPHY


def check_book(book: Book, problems: Diagnostics) -> None:
    """Report links that lead nowhere, questions that share an id, answers to no prediction and
    figures that cannot be set as a question wants; warn of keys that give themselves away."""
    _check_ids("quiz", [item for chapter in book.chapters for item in chapter.quizzes], problems)
    guesses = [item for chapter in book.chapters for item in chapter.predictions]
    _check_ids("predict", guesses, problems)
    for chapter in book.chapters:
        if not chapter.body and not any(found.path == chapter.path for found in problems.found):
            problems.add(chapter.path, 1, "no text; legal: some below the front matter")
        _check_reveals(chapter, problems)
        check_figure_questions(chapter, problems)
    _check_needs(book, problems)
    check_questions(book, problems)
    _check_cited(book, problems)
    check_glossary(book, problems)
    check_order(book, problems)
    check_symbols(book, problems)
    _check_links(book.chapters, book, problems)


def check_translation(book: Book, problems: Diagnostics) -> None:
    """The same of the chapters that are translated, but for what `translations.agreement` compares
    with their originals."""
    translated = tuple(chapter for chapter in book.chapters if chapter.folder)
    for chapter in translated:
        _check_reveals(chapter, problems)
    check_questions(replace(book, chapters=translated), problems)
    _check_links(translated, book, problems)


def _check_links(chapters: Sequence[Chapter], book: Book, problems: Diagnostics) -> None:
    by_file = {PurePosixPath(chapter.path).name: chapter for chapter in book.chapters}
    for chapter in chapters:
        for link in chapter.links:
            if message := _fault_of(link, chapter, by_file):
                problems.add(chapter.path, link.line, message)


def _check_ids(kind: str, items: Sequence[Quiz | Prediction], problems: Diagnostics) -> None:
    first: dict[str, Quiz | Prediction] = {}
    for item in items:
        other = first.setdefault(item.id, item)
        if other.path != item.path:  # else reported when the page was read
            message = f"duplicate {kind} id {item.id!r}; first used at {other.path}:{other.line}"
            problems.add(item.path, item.line, message)


def _check_cited(book: Book, problems: Diagnostics) -> None:
    cited = {citation.key for chapter in book.chapters for citation in chapter.citations}
    for key, work in book.bibliography.works.items():
        if key not in cited:
            message = f"work {key!r} is cited nowhere; legal: '{{cite}}`{key}`' in a chapter"
            problems.add(BIBLIOGRAPHY, work.line, message)


def _check_reveals(chapter: Chapter, problems: Diagnostics) -> None:
    guesses = [prediction.id for prediction in chapter.predictions]
    for reveal in contents(chapter.body, Reveal):
        if reveal.prediction not in guesses:
            message = unknown("prediction of this page", reveal.prediction, guesses)
            problems.add(reveal.path, reveal.line, message)


def _check_needs(book: Book, problems: Diagnostics) -> None:
    """A chapter builds on earlier chapters only."""
    ids = [chapter.id for chapter in book.chapters]
    for place, chapter in enumerate(book.chapters):
        others = [name for name in ids if name != chapter.id]
        for need in chapter.before:
            if not need.chapter:
                continue
            if need.chapter not in others:
                problems.add(chapter.path, need.line, unknown("chapter", need.chapter, others))
            elif ids.index(need.chapter) > place:
                message = (
                    f"builds on chapter {need.chapter!r}, which stands after it; better: before"
                )
                problems.warn(chapter.path, need.line, message)


def _fault_of(link: Link, chapter: Chapter, by_file: dict[str, Chapter]) -> str:
    """What is wrong with ``link``; nothing where it leads somewhere."""
    file, _, anchor = link.target.partition("#")
    if not link.target or ":" in file or file.startswith("/"):
        return f"link {link.target!r}; legal: 'NN-slug.md', '#anchor' or 'https://…'"
    target = by_file.get(file) if file else chapter
    if target is None:
        return unknown("page", file, by_file)
    if anchor and anchor not in target.anchors:
        return unknown(f"anchor in {target.path}", anchor, sorted(target.anchors))
    return ""
