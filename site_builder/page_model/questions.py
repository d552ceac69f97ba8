"""Questions and predictions: what is asked, what is right, and what waits for a guess."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field

from site_builder.page_model.passage import Passage


@dataclass(frozen=True, slots=True)
class Option:
    """One answer of a question, offered or recognised."""

    words: Passage
    text: str
    correct: bool
    explanation: Passage
    value: float | None = None
    """Where a number is asked for: the one that this answer is."""


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked, and the answers that are offered or recognised."""

    id: str
    """Unique in the book among its like: the reader's answer is remembered under it."""
    kind: str
    prompt: Passage
    prompt_text: str
    options: tuple[Option, ...]
    path: str
    line: int
    unit: str = ""
    """Of a number."""
    tolerance: float = 0.0
    """How far from the right number is right."""


def _edition(question: Question, judged_by: object) -> str:
    """A mark of what is asked and what is right: an answer to another edition is forgotten."""
    answers = [(option.text, option.correct) for option in question.options]
    asked = (question.kind, question.prompt_text, answers, judged_by)
    return hashlib.sha256(repr(asked).encode()).hexdigest()[:8]


@dataclass(frozen=True, slots=True)
class Quiz(Question):
    """A question with explained answers: ``single``, ``multiple``, ``number``, ``order`` with its
    options in the right one, or ``figure``, whose options are conditions on its state."""

    figure: str = ""
    """Element id of the figure that is to be set."""
    solution: Mapping[str, str] = field(default_factory=dict)
    """Settings of that figure that are right."""

    @property
    def edition(self) -> str:
        return _edition(self, self.tolerance)


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve to be sketched, and the axes that it is sketched on."""

    x: "Axis"
    y: "Axis"
    samples: tuple[tuple[float, float], ...]
    """Along the axis, from its start to its end."""


@dataclass(frozen=True, slots=True)
class Axis:
    """From where to where, and what of."""

    start: float
    end: float
    label: str


@dataclass(frozen=True, slots=True)
class Prediction(Question):
    """A question before its answer is looked up, ``number``, ``choice`` or ``sketch``; guess and
    answer then stand side by side."""

    curve: Curve | None = None

    @property
    def edition(self) -> str:
        return _edition(self, (self.curve.x, self.curve.y) if self.curve else None)


@dataclass(frozen=True, slots=True)
class Reveal:
    """What waits for a prediction; what it says is in the blocks inside."""

    prediction: str
    id: str
    """Element id."""
    asked: str
    """What the prediction is called: ``Prediction 4.2``."""
    path: str
    line: int
