"""No question gives its answer away by how long the right option is."""

import re
from math import ceil
from statistics import mean

import pytest
from support.worked_numbers import CONTENT, source

from site_builder.checks.questions import FEW_LETTERS

CHAPTERS = tuple(sorted(file.stem for file in CONTENT.glob("*.md")))

QUIZ = re.compile(r"^:::\{quiz\} (\S+)\n(.*?)^:::$", re.MULTILINE | re.DOTALL)
OPTION = re.compile(r"^- \[( |x)\] (.*)$", re.MULTILINE)
MARKUP = re.compile(r"\\[a-z]+|[\\{}$^*]")
"""What a formula or emphasis is made with, and nobody reads."""

type Options = list[tuple[bool, str]]


def single_choice(chapter: str) -> dict[str, Options]:
    """Per question: whether an option is the key, and its text, in the order of the page."""
    return {
        name: [(mark == "x", MARKUP.sub("", text)) for mark, text in OPTION.findall(body)]
        for name, body in QUIZ.findall(source(chapter))
        if ":kind:" not in body
    }


QUESTIONS = [
    pytest.param(options, id=name)
    for chapter in CHAPTERS
    for name, options in single_choice(chapter).items()
]


def test_questions_are_found() -> None:
    assert len(QUESTIONS) >= 10


@pytest.mark.parametrize("options", QUESTIONS)
def test_the_key_is_about_as_long_as_the_others(options: Options) -> None:
    (key,) = (len(text) for right, text in options if right)
    others = [len(text) for right, text in options if not right]
    assert abs(key - mean(others)) <= max(0.25 * mean(others), FEW_LETTERS)


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_the_key_is_the_longest_no_more_often_than_chance_has_it(chapter: str) -> None:
    """Of four answers one, and rounded up."""
    questions = single_choice(chapter).values()
    longest = sum(max(options, key=lambda option: len(option[1]))[0] for options in questions)
    assert longest <= ceil(sum(1 / len(options) for options in questions))
