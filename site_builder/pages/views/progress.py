"""The list of all questions from which the title page shows a reader's progress."""

from markupsafe import Markup

from site_builder.book import Book
from site_builder.pages.embedding import json_for_html


def progress_data(book: Book) -> Markup:
    """Questions and their editions by chapter, as JSON for a script element."""
    return json_for_html(
        {
            chapter.id: {quiz.id: quiz.edition for quiz in chapter.quizzes}
            for chapter in book.chapters
        }
    )
