"""Questions as templates and the scripts of pages need them; and ``book.json``, which has chapters,
simulations and questions as plain data, for programs that read."""

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict
from typing import Any

from jinja2 import pass_context
from jinja2.runtime import Context
from markupsafe import Markup

from simulations.engine.controls import Points, describe
from simulations.engine.scene import Scene
from site_builder.document.blocks import OTHERWISE, Block, Option, Prediction, Question, Quiz
from site_builder.document.book import Book, Chapter
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.policy import json_for_html
from site_builder.render.words import plain_words
from site_builder.runtime.store import Versions


def catalogue(book: Book, versions: Versions) -> bytes:
    """``book.json``."""
    chapters = [
        {
            "number": chapter.number,
            "id": chapter.id,
            "title": chapter.title,
            "url": chapter.url,
            "simulations": list(dict.fromkeys(figure.scene.id for figure in chapter.simulations)),
            "quizzes": [quiz.id for quiz in chapter.quizzes],
        }
        for chapter in book.chapters
    ]
    data = {
        "title": book.title,
        "runtime": asdict(versions),
        "chapters": chapters,
        "simulations": [_simulation(scene) for scene in book.scenes],
        "quizzes": [_entry(each, of) for of in book.chapters for each in of.quizzes],
        "predictions": [_entry(each, of) for of in book.chapters for each in of.predictions],
    }
    return (json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False) + "\n").encode()


def _simulation(scene: Scene[Any]) -> dict[str, object]:
    return {
        "id": scene.id,
        "title": scene.title,
        "tiers": list(scene.accuracy.names),
        "controls": [describe(each) for each in scene.controls if not isinstance(each, Points)],
    }


def _entry(question: Quiz | Prediction, chapter: Chapter) -> dict[str, object]:
    entry = {"id": question.id, "chapter": chapter.id, "kind": question.kind, **_asked(question)}
    if not question.others:
        return entry
    variants = [{"drawn": each.drawn, **_asked(each)} for each in question.variants]
    return {**entry, "variants": variants}


def _asked(question: Quiz | Prediction) -> dict[str, object]:
    def option(option: Option) -> dict[str, object]:
        return {"text": option.text, "correct": option.correct}

    options = _options(question, option)
    catalogued = kind_of(question).catalogue(question)
    return {"prompt": question.prompt_text, "options": options, **catalogued}


def _options(
    question: Question, entry: Callable[[Option], dict[str, object]]
) -> list[dict[str, object]]:
    """An entry for each, with the number that the answer is where one is asked for."""
    return [
        entry(option) | ({} if option.value is None else {"value": option.value})
        for option in question.options
    ]


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
    def option(option: Option) -> dict[str, object]:
        explanation = context["renderer"](option.explanation)
        return {"correct": option.correct, "explanation_html": explanation}

    return {
        "id": question.id,
        "kind": question.kind,
        "edition": question.edition,
        "options": _options(question, option),
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

    def option(option: Option) -> dict[str, object]:
        otherwise = book.words("question.otherwise") if option.text == OTHERWISE else ""
        text = otherwise or plain_words(option.words) or option.text
        return {"correct": option.correct, "explanation_html": "", "text": text}

    def variant(quiz: Quiz) -> dict[str, object]:
        return {
            "id": quiz.id,
            "drawn": quiz.drawn,
            "kind": quiz.kind,
            "edition": quiz.edition,
            "options": _options(quiz, option),
            **kind_of(quiz).page_data(quiz),
        }

    return json_for_html(
        [
            {
                "id": quiz.id,
                "name": name,
                "place": f"{chapter.url}#quiz-{quiz.id}",
                "variants": [*map(variant, quiz.variants)],
            }
            for chapter in book.chapters
            for name, quiz in numbered_quizzes(chapter.body)
        ]
    )
