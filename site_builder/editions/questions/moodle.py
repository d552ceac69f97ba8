"""Moodle XML: one file, with a category for each chapter, and in it one for each question that
draws numbers, from which a quiz of Moodle can take a random question.

The shape is that of Moodle's own export, https://docs.moodle.org/en/Moodle_XML_format; the kind
``ordering`` is part of Moodle since version 4.4.
"""

from itertools import groupby

from site_builder.document.book import Book
from site_builder.editions.questions.asked import Asked, asked_in, written
from site_builder.editions.questions.words import moodle_text
from site_builder.pages.environment import render_template


def make_moodle(book: Book) -> bytes:
    categories = [
        (category, [_question(book, asked) for asked in group])
        for category, group in groupby(asked_in(book), lambda asked: _category(book, asked))
    ]
    return render_template("editions/moodle.xml", book, categories=categories).encode()


def _category(book: Book, asked: Asked) -> str:
    """A path, in which a slash of a name is written twice."""
    path = [book.title, f"{asked.chapter.name}. {asked.chapter.title}"]
    if asked.drawn_from:
        path.append(asked.drawn_from)
    return "/".join(["$course$", "top", *(name.replace("/", "//") for name in path)])


def _question(book: Book, asked: Asked) -> str:
    return written(book, asked, "moodle", moodle_text(asked.page, book.settings.macros))
