"""Warnings of questions that give their keys away by length.

A key that is longer than every other answer, because only the truth was hedged and explained, is
the best known of the cues by which people answer who know nothing (Haladyna, Downing and Rodriguez,
*A review of multiple-choice item-writing guidelines*, 2002). The next, a favourite place, is none
here: each reader gets an order of their own. Questions with several keys are left alone.
"""

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.book import Book, Chapter
from site_builder.document.questions import Option, Quiz
from site_builder.render.words import plain_words

STANDS_OUT = 1.4
"""How many times as long as the longest wrong answer a key may be, or the shortest wrong answer as
the key: lines of one paragraph differ as much, so up to there it is not seen at a glance."""
FEW_LETTERS = 12
"""Two words: among short answers a smaller difference has no meaning, whatever its ratio."""


def check_questions(book: Book, problems: Diagnostics) -> None:
    """Warn of each key that stands out."""
    for chapter in book.chapters:
        for quiz in single_choice(chapter):
            faults = filter(None, map(fault_of_length, quiz.variants))
            if message := next(faults, ""):
                problems.warn(quiz.path, quiz.line, message)


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
    return len(plain_words(option.words).strip())


def fault_of_length(quiz: Quiz) -> str:
    """What the key's length gives away, or nothing."""
    key, *wrong = [letters(option) for option in sorted(quiz.options, key=lambda o: not o.correct)]
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
