"""What a chapter works out in its text is what the models say.

What a figure shows, or what was measured, is asked for by a role of the text. What the text works
out, so that the reader can check it by hand, is computed again here and looked for where it
stands.
"""

from importlib import import_module
from inspect import isgeneratorfunction
from pathlib import Path

import pytest
from support.worked_numbers import Calculation, source

HERE = Path(__file__).parent
CHAPTERS = [import_module(file.stem) for file in sorted(HERE.glob("numbers_*.py"))]
CALCULATIONS = [
    (module.CHAPTER, found)
    for module in CHAPTERS
    for found in vars(module).values()
    if isgeneratorfunction(found) and found.__module__ == module.__name__
]


@pytest.mark.parametrize(
    ("chapter", "worked"), CALCULATIONS, ids=[f"{c[:2]}-{w.__name__}" for c, w in CALCULATIONS]
)
def test_what_a_chapter_works_out_is_what_the_models_say(chapter: str, worked: Calculation) -> None:
    text = source(chapter)
    for phrase in worked():
        assert phrase in text, f"content/{chapter}.md does not say: {phrase}"
