"""``book.json``: chapters, simulations and quizzes as plain data, for readers that are programs."""

import json
from dataclasses import asdict
from typing import Any

from simulations.engine.controls import describe
from simulations.engine.scene import Scene
from site_builder.book import Book, Chapter, Quiz
from site_builder.runtime.pinned import Versions


def catalogue(book: Book, versions: Versions) -> bytes:
    """The file's bytes."""
    data = {
        "title": book.title,
        "runtime": asdict(versions),
        "chapters": [_chapter(chapter) for chapter in book.chapters],
        "simulations": [_simulation(scene) for scene in book.scenes],
        "quizzes": [_quiz(quiz, chapter) for chapter in book.chapters for quiz in chapter.quizzes],
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
    return {
        "id": quiz.id,
        "chapter": chapter.id,
        "kind": quiz.kind,
        "prompt": quiz.prompt_text,
        "options": [{"text": option.text, "correct": option.correct} for option in quiz.options],
    }
