"""No number of a chapter is left to its author's care.

What a figure shows, or what was measured, is asked for by a role of the text. What the text works
out, so that the reader can check it by hand, is computed again here and looked for where it
stands; it may be quoted again in the same chapter. What remains must have been chosen, not
computed, and is listed.
"""

from importlib import import_module
from types import ModuleType

import pytest
from support.worked_numbers import CONTENT, Calculation, source, telling_numbers, without

CHAPTERS = [import_module(f"numbers_{file.stem[:2]}") for file in sorted(CONTENT.glob("*.md"))]
CALCULATIONS = [(module.CHAPTER, worked) for module in CHAPTERS for worked in module.WORKED]


@pytest.mark.parametrize(
    ("chapter", "worked"), CALCULATIONS, ids=[f"{c[:2]}-{w.__name__}" for c, w in CALCULATIONS]
)
def test_what_a_chapter_works_out_is_what_the_models_say(chapter: str, worked: Calculation) -> None:
    text = source(chapter)
    for phrase in worked():
        assert phrase in text, f"content/{chapter}.md does not say: {phrase}"


@pytest.mark.parametrize("module", CHAPTERS, ids=lambda module: module.CHAPTER)
def test_every_other_number_of_a_chapter_is_one_that_was_chosen(module: ModuleType) -> None:
    phrases = [phrase for worked in module.WORKED for phrase in worked()]
    left = {*telling_numbers(without(phrases, source(module.CHAPTER)))}
    repeated = {*telling_numbers("\n".join(phrases))}
    given = {*module.GIVEN.split()}
    unknown, idle = sorted(left - repeated - given), sorted(given - left)
    assert not unknown, f"neither computed nor listed as chosen: {' '.join(unknown)}"
    assert not idle, f"listed as chosen, but not in the text: {' '.join(idle)}"


def test_numbers_are_told_from_options_roles_and_links() -> None:
    text = (
        ":::{simulation} demo-100\n:k1: 0.25\nIt is 0.5 or {readout}`demo k1 k1=0.75`, as in "
        "[1.5](02.5-x.md), and 12 or 1234.\n:::\n"
        "```python\nx = 3.25\n```\n:::{example} Title 2.5\n:default: Takes 4.5.\n"
    )
    assert telling_numbers(text) == ["0.5", "1.5", "1234", "2.5", "4.5"]


def test_a_phrase_hides_only_its_own_numbers() -> None:
    assert telling_numbers(without(["is 0.5"], "This is 0.5, that 0.25.")) == ["0.25"]
