"""Warnings of questions that give their keys away: by length, or by where the keys stand.

A key that is longer than every other answer, because only the truth was hedged and explained, is
the best known of the cues by which people answer who know nothing; a favourite place is the next
(Haladyna, Downing and Rodriguez, *A review of multiple-choice item-writing guidelines*, 2002).
Questions with several keys have neither cue, and are left alone.
"""

import html
import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from site_builder.book import Book, Chapter, Option, Quiz
from site_builder.diagnostics import Diagnostics

STANDS_OUT = 1.4
"""How many times as long as the longest wrong answer a key may be, or the shortest wrong answer as
the key: lines of one paragraph differ as much, so up to there nobody sees it at a glance."""
FEW_LETTERS = 12
"""Two words: among short answers a smaller difference has no meaning, whatever its ratio."""
SEEN = 1.1
"""How many times as long as the next an answer must be to be seen as the longest."""
FEWEST_ALIKE = 3
"""Keys in one place of a chapter that make a habit; two are a coincidence."""
CHANCE = 0.01
"""Probability below which what the keys of the whole book have in common is no coincidence."""
TAG = re.compile(r"<[^>]*>")


def check_questions(book: Book, problems: Diagnostics) -> None:
    """Warn of each key that stands out, of each chapter with a favourite place, and of habits
    that show only in the whole book."""
    for chapter in book.chapters:
        quizzes = single_choice(chapter)
        for quiz in quizzes:
            if message := fault_of_length(quiz):
                problems.warn(quiz.path, quiz.line, message)
        if message := fault_of_places(quizzes):
            problems.warn(chapter.path, quizzes[0].line, message)
    everything = [quiz for chapter in book.chapters for quiz in single_choice(chapter)]
    for message in habits(everything):
        problems.warn("content/book.toml", 1, message)


def single_choice(chapter: Chapter) -> list[Quiz]:
    """The questions with exactly one key, and something else to choose."""
    return [
        quiz
        for quiz in chapter.quizzes
        if quiz.kind == "single" and len(quiz.options) > 1
        if sum(option.correct for option in quiz.options) == 1
    ]


def letters(option: Option) -> int:
    """Length of an answer as it is read: a formula counts what it shows, not its source."""
    return len(html.unescape(TAG.sub("", option.html)).strip())


def fault_of_length(quiz: Quiz) -> str:
    """What the key's length gives away, or nothing."""
    key, *wrong = _lengths(quiz)
    for what, other, short, long in (
        ("longest", max(wrong), max(wrong), key),
        ("shortest", min(wrong), key, min(wrong)),
    ):
        if long > STANDS_OUT * short and long - short >= FEW_LETTERS:
            return (
                f"the key of quiz {quiz.id!r} stands out: its length is {key}, that of the {what} "
                f"wrong answer {other}; better: within a factor of {STANDS_OUT:g}"
            )
    return ""


def fault_of_places(quizzes: Sequence[Quiz]) -> str:
    """What the keys' places in one chapter give away, or nothing.

    Where more than half stand in one place, whoever always ticks it gets more than half right,
    at least twice as many as by guessing among four.
    """
    places = [_place(quiz) for quiz in quizzes]
    favourite, count = next(iter(Counter(places).most_common(1)), (0, 0))
    if count < FEWEST_ALIKE or 2 * count <= len(places):
        return ""
    listed = ", ".join(map(str, places))
    return (
        f"{count} of {len(places)} keys of this chapter are answer {favourite} (in order: "
        f"{listed}); better: spread over all places"
    )


def habits(quizzes: Sequence[Quiz]) -> Iterator[str]:
    """What the keys of many questions have in common more often than by chance."""
    for what, holds, share in HABITS:
        count = sum(map(holds, quizzes))
        chances = [share(len(quiz.options)) for quiz in quizzes]
        if chance_of(count, chances) < CHANCE:
            yield (
                f"the key is {what} in {count} of the {len(quizzes)} questions of the book; "
                f"better: about {sum(chances):.0f}, as by chance"
            )


def chance_of(hits: int, chances: Sequence[float]) -> float:
    """Probability of at least ``hits`` of independent events that have these probabilities."""
    exactly = [1.0]
    for chance in chances:
        missed = [(1.0 - chance) * before for before in (*exactly, 0.0)]
        happened = [chance * before for before in (0.0, *exactly)]
        exactly = [a + b for a, b in zip(missed, happened, strict=True)]
    return sum(exactly[hits:])


def _lengths(quiz: Quiz) -> list[int]:
    """Of the key, then of the wrong answers."""
    return [letters(option) for option in sorted(quiz.options, key=lambda o: not o.correct)]


def _is_longest(quiz: Quiz) -> bool:
    key, *wrong = _lengths(quiz)
    return key > SEEN * max(wrong)


def _place(quiz: Quiz) -> int:
    """Of the key, counted from 1."""
    return 1 + next(index for index, option in enumerate(quiz.options) if option.correct)


def _is_inside(quiz: Quiz) -> bool:
    return 1 < _place(quiz) < len(quiz.options)


type Habit = tuple[str, Callable[[Quiz], bool], Callable[[int], float]]

HABITS: tuple[Habit, ...] = (
    ("the longest answer", _is_longest, lambda answers: 1.0 / answers),
    ("the first answer", lambda quiz: _place(quiz) == 1, lambda answers: 1.0 / answers),
    ("the last answer", lambda quiz: _place(quiz) == len(quiz.options), lambda n: 1.0 / n),
    ("neither the first nor the last answer", _is_inside, lambda n: max(n - 2, 0) / n),
)
"""What the keys may have in common, and how probable it is by chance among so many answers."""
