"""``book.json``: chapters, simulations and questions as plain data, for programs that read."""

import json
from dataclasses import asdict
from typing import Any

from simulations.engine.controls import Points, describe
from simulations.engine.scene import Scene
from site_builder.document.book import Book, Chapter
from site_builder.document.questions import Option, Prediction, Quiz
from site_builder.markdown.questions.kinds import kind_of
from site_builder.runtime.pinned import Versions


def catalogue(book: Book, versions: Versions) -> bytes:
    """The file's bytes."""
    chapters = book.chapters
    data = {
        "title": book.title,
        "runtime": asdict(versions),
        "chapters": [_chapter(chapter) for chapter in chapters],
        "simulations": [_simulation(scene) for scene in book.scenes],
        "quizzes": [_question(each, chapter) for chapter in chapters for each in chapter.quizzes],
        "predictions": [
            _question(each, chapter) for chapter in chapters for each in chapter.predictions
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
        "controls": [describe(each) for each in scene.controls if not isinstance(each, Points)],
    }


def _question(question: Quiz | Prediction, chapter: Chapter) -> dict[str, object]:
    entry: dict[str, object] = {
        "id": question.id,
        "chapter": chapter.id,
        "kind": question.kind,
        **_asked(question),
    }
    if not question.others:
        return entry
    variants = [{"drawn": each.drawn, **_asked(each)} for each in question.variants]
    return {**entry, "variants": variants}


def _asked(question: Quiz | Prediction) -> dict[str, object]:
    return {
        "prompt": question.prompt_text,
        "options": [_option(option) for option in question.options],
        **kind_of(question).catalogue(question),
    }


def _option(option: Option) -> dict[str, object]:
    entry: dict[str, object] = {"text": option.text, "correct": option.correct}
    return entry if option.value is None else {**entry, "value": option.value}
