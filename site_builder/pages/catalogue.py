"""``book.json``: chapters, simulations and questions as plain data, for programs that read."""

import json
from dataclasses import asdict
from typing import Any

from simulations.engine.controls import describe
from simulations.engine.scene import Scene
from site_builder.book import Book, Chapter
from site_builder.page_model.questions import Option, Prediction, Quiz
from site_builder.runtime.pinned import Versions


def catalogue(book: Book, versions: Versions) -> bytes:
    """The file's bytes."""
    data = {
        "title": book.title,
        "runtime": asdict(versions),
        "chapters": [_chapter(chapter) for chapter in book.chapters],
        "simulations": [_simulation(scene) for scene in book.scenes],
        "quizzes": [_quiz(quiz, chapter) for chapter in book.chapters for quiz in chapter.quizzes],
        "predictions": [
            _prediction(prediction, chapter)
            for chapter in book.chapters
            for prediction in chapter.predictions
        ],
    }
    return (json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False) + "\n").encode()


def _chapter(chapter: Chapter) -> dict[str, object]:
    return {
        "number": chapter.number,
        "id": chapter.id,
        "title": chapter.title,
        "url": chapter.url,
        "simulations": list(dict.fromkeys(figure.scene.id for figure in chapter.simulations)),
        "quizzes": [quiz.id for quiz in chapter.quizzes],
    }


def _simulation(scene: Scene[Any]) -> dict[str, object]:
    return {
        "id": scene.id,
        "title": scene.title,
        "tiers": list(scene.tiers),
        "controls": [describe(control) for control in scene.controls],
    }


def _quiz(quiz: Quiz, chapter: Chapter) -> dict[str, object]:
    entry: dict[str, object] = {
        "id": quiz.id,
        "chapter": chapter.id,
        "kind": quiz.kind,
        "prompt": quiz.prompt_text,
        "options": [_option(option) for option in quiz.options],
    }
    if quiz.kind == "number":
        entry |= {"unit": quiz.unit, "tolerance": quiz.tolerance}
    if quiz.kind == "figure":
        entry |= {"figure": quiz.figure, "solution": dict(quiz.solution)}
    return entry


def _option(option: Option) -> dict[str, object]:
    entry: dict[str, object] = {"text": option.text, "correct": option.correct}
    return entry if option.value is None else {**entry, "value": option.value}


def _prediction(prediction: Prediction, chapter: Chapter) -> dict[str, object]:
    return {
        "id": prediction.id,
        "chapter": chapter.id,
        "kind": prediction.kind,
        "prompt": prediction.prompt_text,
        "options": [_option(option) for option in prediction.options],
    }
