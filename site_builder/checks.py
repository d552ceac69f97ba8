"""What can be checked only when all chapters are read: links between them, ids across them."""

from pathlib import PurePosixPath

from site_builder.book import Book, Chapter, Link, Quiz
from site_builder.diagnostics import Diagnostics, unknown
from site_builder.question_checks import check_questions


def check_book(book: Book, problems: Diagnostics) -> None:
    """Report links that lead nowhere and quizzes that share an id; warn of keys that show."""
    _check_quiz_ids(book, problems)
    check_questions(book, problems)
    by_file = {PurePosixPath(chapter.path).name: chapter for chapter in book.chapters}
    for chapter in book.chapters:
        for link in chapter.links:
            if message := _fault_of(link, chapter, by_file):
                problems.add(chapter.path, link.line, message)


def _check_quiz_ids(book: Book, problems: Diagnostics) -> None:
    first: dict[str, Quiz] = {}
    for chapter in book.chapters:
        for quiz in chapter.quizzes:
            other = first.setdefault(quiz.id, quiz)
            if other.path != quiz.path:  # within a page its reading tells
                place = f"{other.path}:{other.line}"
                message = f"duplicate quiz id {quiz.id!r}; first used at {place}"
                problems.add(quiz.path, quiz.line, message)


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
