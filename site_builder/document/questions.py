"""Questions and predictions: what is asked, what is right, and what is hidden until a guess."""

import hashlib
from dataclasses import dataclass
from typing import Any, Self

from site_builder.document.passage import Passage

OTHERWISE = "otherwise"
"""The text of the answer that stands for whatever no other recognises."""


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
    """Unique in the book among its like: the reader's answer is stored under it."""
    kind: str
    """The author's name for it."""
    prompt: Passage
    prompt_text: str
    options: tuple[Option, ...]
    path: str
    line: int
    details: Any = None
    """Data of its kind alone."""
    decides: object = None
    """What else than the options decides what is right."""
    drawn: str = ""
    """The numbers that it draws, if it does: ``f = 24; N = 5.6``."""
    others: tuple[Self, ...] = ()
    """The same question with the other numbers that it may draw."""
    answered_as: str = ""
    """In a translation, the edition of its original: the two share their answers."""

    @property
    def variants(self) -> tuple[Self, ...]:
        """The question with all the numbers that it may draw."""
        return (self, *self.others)

    @property
    def edition(self) -> str:
        """A hash of what is asked and what is right: an answer to another edition is forgotten."""
        if self.answered_as:
            return self.answered_as
        answers = [(option.text, option.correct) for option in self.options]
        asked = (self.kind, self.prompt_text, answers, self._decides)
        return hashlib.sha256(repr(asked).encode()).hexdigest()[:8]

    @property
    def _decides(self) -> object:
        return self.decides


@dataclass(frozen=True, slots=True)
class Quiz(Question):
    """A question with explained answers."""

    @property
    def _decides(self) -> object:
        return self.decides or 0.0


@dataclass(frozen=True, slots=True)
class Prediction(Question):
    """A question before its answer is looked up; guess and answer then stand side by side."""


@dataclass(frozen=True, slots=True)
class Reveal:
    """What is hidden until a prediction is made; its content is in the blocks inside."""

    prediction: str
    id: str
    """Element id."""
    path: str
    line: int
