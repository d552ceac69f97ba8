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
from site_builder.document.blocks import (
    OTHERWISE,
    Block,
    Option,
    Prediction,
    Question,
    Quiz,
    Simulation,
)
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
            "figures": [_figure(figure) for figure in chapter.simulations],
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


def _figure(figure: Simulation) -> dict[str, object]:
    return {
        "id": figure.id,
        "simulation": figure.scene.id,
        **({"panels": list(figure.panels)} if figure.panels else {}),
        **({"with": figure.leader} if figure.leader else {}),
    }


def _simulation(scene: Scene[Any]) -> dict[str, object]:
    return {
        "id": scene.id,
        "title": scene.title,
        "tiers": list(scene.accuracy.names),
        "controls": [describe(each) for each in scene.controls if not isinstance(each, Points)],
    }


def _entry(question: Quiz | Prediction, chapter: Chapter) -> dict[str, object]:
    def option(option: Option) -> dict[str, object]:
        return {"text": option.text, "correct": option.correct}

    return {
        "id": question.id,
        "chapter": chapter.id,
        "kind": question.kind,
        "prompt": question.prompt_text,
        "options": _options(question, option),
        **kind_of(question).catalogue(question),
    }


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
def question_data(context: Context, question: Question) -> Markup:
    """JSON that is safe inside a script element."""

    def option(option: Option) -> dict[str, object]:
        explanation = context["renderer"](option.explanation)
        return {"correct": option.correct, "explanation_html": explanation}

    return json_for_html(_data(question, option))


def _data(question: Question, entry: Callable[[Option], dict[str, object]]) -> dict[str, object]:
    return {
        "id": question.id,
        "kind": question.kind,
        "edition": question.edition,
        "options": _options(question, entry),
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

    return json_for_html(
        [
            {"name": name, "place": f"{chapter.url}#quiz-{quiz.id}", **_data(quiz, option)}
            for chapter in book.chapters
            for name, quiz in numbered_quizzes(chapter.body)
        ]
    )
