"""The questions as the page of a class judges and names them: no explanations, answers as text."""

from typing import Any

from markupsafe import Markup

from site_builder.document.book import Book
from site_builder.document.questions import OTHERWISE, Option, Quiz
from site_builder.languages.words import Words
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.embedding import json_for_html
from site_builder.pages.views.question import numbered_quizzes
from site_builder.render.words import plain_words


def class_data(book: Book) -> Markup:
    """JSON that is safe inside a script element: all questions, in the order of the book."""
    return json_for_html(
        [
            _question(name, f"{chapter.url}#quiz-{quiz.id}", quiz, book.words)
            for chapter in book.chapters
            for name, quiz in numbered_quizzes(chapter.body)
        ]
    )


def _question(name: str, place: str, quiz: Quiz, words: Words) -> dict[str, Any]:
    """Its variants are those of a question that draws numbers, else the question alone."""
    variants = [_variant(each, words) for each in quiz.variants]
    return {"id": quiz.id, "name": name, "place": place, "variants": variants}


def _variant(quiz: Quiz, words: Words) -> dict[str, Any]:
    return {
        "id": quiz.id,
        "drawn": quiz.drawn,
        "kind": quiz.kind,
        "edition": quiz.edition,
        "options": [
            {"correct": option.correct, "explanation_html": "", "text": _text(option, words)}
            | ({} if option.value is None else {"value": option.value})
            for option in quiz.options
        ],
        **kind_of(quiz).page_data(quiz),
    }


def _text(option: Option, words: Words) -> str:
    if option.text == OTHERWISE:
        return words("question.otherwise")
    return plain_words(option.words) or option.text
