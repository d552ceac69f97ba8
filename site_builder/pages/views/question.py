"""A question as its templates need it, and as the script of its page does."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

from jinja2 import pass_context
from jinja2.runtime import Context
from markupsafe import Markup

from site_builder.document.blocks import Block
from site_builder.document.book import Book
from site_builder.document.questions import OTHERWISE, Option, Question, Quiz
from site_builder.languages.words import Words
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.policy import json_for_html
from site_builder.render.words import plain_words


@pass_context
def kind_view(context: Context, question: Question) -> object:
    """What the template of its kind shows besides the question."""
    chapter = context["chapter"]
    return kind_of(question).view(question, chapter.simulations if chapter else ())


@pass_context
def question_data(
    context: Context, question: Question, fieldset: Callable[[Question], Markup] | None = None
) -> Markup:
    """JSON that is safe inside a script element. ``fieldset`` makes the HTML of what is asked, with
    each of the numbers that a question may draw."""
    said = _said(context, question)
    if fieldset and question.others:
        said["variants"] = [
            {**_said(context, each), "fieldset_html": fieldset(each)} for each in question.variants
        ]
    return json_for_html(said)


def _said(context: Context, question: Question) -> dict[str, object]:
    options = [
        {"correct": option.correct, "explanation_html": context["renderer"](option.explanation)}
        | ({} if option.value is None else {"value": option.value})
        for option in question.options
    ]
    return {
        "id": question.id,
        "kind": question.kind,
        "edition": question.edition,
        "options": options,
        **kind_of(question).page_data(question),
    }


def numbered_quizzes(blocks: Iterable[Block]) -> Iterator[tuple[str, Quiz]]:
    """Each question and the name that its page gives it, ``Question 4.2``."""
    for block in blocks:
        if isinstance(block.content, Quiz):
            yield (block.target.name if block.target else block.content.id), block.content
        yield from numbered_quizzes(block.inside)


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
