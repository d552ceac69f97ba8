"""What a translated chapter shares with its original: figures, and answers to questions."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from site_builder.cache.hashing import hash_of
from site_builder.document.blocks import Block, Simulation
from site_builder.document.book import Chapter
from site_builder.document.questions import Prediction, Question, Quiz


@dataclass(frozen=True, slots=True)
class _Shared:
    """Of the original, by ids."""

    figures: Mapping[str, Simulation]
    quizzes: Mapping[str, Question]
    guesses: Mapping[str, Question]

    def block(self, block: Block) -> Block:
        return replace(
            block,
            content=self.content(block.content),
            inside=tuple(self.block(part) for part in block.inside),
        )

    def content(self, content: object) -> object:
        match content:
            case Simulation():
                first = self.figures.get(content.id, content)
                return replace(content, path=first.path, line=first.line)
            case Quiz():
                return _answered_as(content, self.quizzes.get(content.id, content))
            case Prediction():
                return _answered_as(content, self.guesses.get(content.id, content))
            case _:
                return content


def _answered_as[Q: Question](question: Q, original: Question) -> Q:
    """With the edition of the original, for all numbers that it may draw."""
    pairs = zip(question.others, original.others, strict=False)
    return replace(
        question,
        answered_as=original.edition,
        others=tuple(replace(other, answered_as=first.edition) for other, first in pairs),
    )


def with_shared(translated: Chapter, original: Chapter, folder: str) -> Chapter:
    """The chapter with the figures that are drawn for the original, and with the editions of its
    questions, under which answers are stored; its page in ``folder``."""
    shared = _Shared(
        {figure.id: figure for figure in original.simulations},
        {quiz.id: quiz for quiz in original.quizzes},
        {guess.id: guess for guess in original.predictions},
    )
    return replace(
        translated,
        body=tuple(map(shared.block, translated.body)),
        folder=folder,
        cache_key=hash_of(translated.cache_key, original.cache_key, folder),
    )
