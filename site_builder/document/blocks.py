"""The parts of a page. What other parts of the builder use is here: simulations, quoted modules,
questions and predictions. The content of every other directive is a class in the file of that."""

import hashlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from simulations.engine.scene import Scene
from site_builder.document.places import Heading, Passage, Target


@dataclass(frozen=True, slots=True)
class Block:
    """A part of a page: a run of plain Markdown, or one directive."""

    template: str
    """Its file below ``templates/blocks/``, without ``.html``."""
    content: object
    """What the template shows; most directives have a class of their own for it."""
    inside: "tuple[Block, ...]" = ()
    """The blocks in it, as a callout has them."""
    target: "Target | None" = None
    """Its number and where a link to it leads; None where it is not numbered."""


def walk(blocks: Iterable[Block]) -> Iterator[Block]:
    """All of them, each before those inside it."""
    for block in blocks:
        yield block
        yield from walk(block.inside)


def contents[T](blocks: Iterable[Block], kind: type[T]) -> Iterator[T]:
    """What the blocks of one kind show, those inside other blocks included."""
    return (block.content for block in walk(blocks) if isinstance(block.content, kind))


NO_WORDS = Passage()


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs, lists, headings, formulae: anything that plain Markdown makes."""

    words: Passage


@dataclass(frozen=True, slots=True)
class Deeper:
    """A section beyond the first pass, folded until it is asked for; the rest of it is in the
    blocks inside."""

    heading: Heading


@dataclass(frozen=True, slots=True, kw_only=True)
class Simulation:
    """A figure that comes alive in the page."""

    scene: Scene[Any]
    id: str
    """Element id: ``figure-`` and the scene's id, numbered where a page shows a scene twice."""
    values: Mapping[str, object]
    """Starting values that differ from the scene's defaults, already checked."""
    tier: str
    """Starting accuracy; the scene's default where the author named none."""
    caption: Passage
    """What to try."""
    path: str
    line: int
    about: Passage = NO_WORDS
    """What it shows, in a fold."""
    in_sight: tuple[str, ...] = ()
    """Names of the controls and readouts that are not folded; none where the first are shown."""
    yours: bool = False
    """Whether the reader's photographs go into the figure, an instrument."""
    panels: tuple[str, ...] = ()
    """Names of the panels that it shows, in this order; none where it shows all."""
    leader: str = ""
    """Element id of the figure whose settings it shares, as a part of that one; nothing where the
    settings are its own."""
    small: bool = False
    """Whether it is as wide as the text, without controls."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """The real source of a function of the book's own code."""

    module: str
    name: str
    path: str
    """File of the module, relative to the root of the project."""
    first_line: int
    code: str
    docstring: tuple[int, int]
    """Its lines in the code, from the first to before the last; equal where there is none."""
    caption: Passage


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


@dataclass(frozen=True, slots=True, kw_only=True)
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

    @property
    def edition(self) -> str:
        """A hash of what is asked and what is right: an answer to another edition is forgotten."""
        answers = [(option.text, option.correct) for option in self.options]
        asked = (self.kind, self.prompt_text, answers, self.decides)
        return hashlib.sha256(repr(asked).encode()).hexdigest()[:8]


@dataclass(frozen=True, slots=True)
class Quiz(Question):
    """A question with explained answers."""


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
