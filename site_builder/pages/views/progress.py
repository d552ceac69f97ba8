"""What the title page must know of all questions, to tell how far a reader has come."""

from markupsafe import Markup

from site_builder.book import Book
from site_builder.pages.embedding import json_for_html


def progress_data(book: Book) -> Markup:
    """By chapter, each question and its edition: JSON that is safe inside a script element."""
    return json_for_html(
        {
            chapter.id: {quiz.id: quiz.edition for quiz in chapter.quizzes}
            for chapter in book.chapters
        }
    )
