"""Python's own exceptions, as an author reads them: what is wrong, and on which line of a scene."""

from importlib import import_module
from pathlib import Path

import pytest
from support.small_package import PACKAGE, small_package

from site_builder.diagnostics import cause

SLIPS = [
    ("return {'curve': 1}['curves']", "KeyError: there is no 'curves'"),
    ("return {}[3]", "KeyError: there is no 3"),
    ("raise KeyError('no light, no picture')", "KeyError: no light, no picture"),
    ("return 'text'.uper()", "AttributeError: str has no 'uper'; did you mean 'upper'?"),
    ("return math.sinn(1)", "AttributeError: math has no 'sinn'; did you mean 'sin'?"),
    ("return heigth", "NameError: nothing is called 'heigth'; did you mean 'height'?"),
    ("return zzz", "NameError: nothing is called 'zzz'"),
    (
        "late = 1; del late; return late",
        "UnboundLocalError: 'late' is used before it is given a value",
    ),
    ("import heigths", "ModuleNotFoundError: there is no module 'heigths'"),
    ("from math import sinn", "ImportError: math has no 'sinn'; did you mean 'sin'?"),
    ("open('/no/such.csv')", "FileNotFoundError: there is no file '/no/such.csv'"),
    ("return draw()", "RecursionError: a function calls itself without end"),
    ("assert height < 0", "AssertionError: what is asserted does not hold"),
    ("return 1 / 0", "ZeroDivisionError: division by zero"),
    ("raise ValueError('height -1; legal: above 0')", "ValueError: height -1; legal: above 0"),
]


@pytest.mark.parametrize(("line", "says"), SLIPS)
def test_an_exception_is_told_in_words_with_its_place(line: str, says: str, tmp_path: Path) -> None:
    source = f"import math\nheight = 3\n\ndef draw():\n    {line}\n"
    with small_package(tmp_path, {"scene": source}):
        draw = import_module(f"{PACKAGE}.scene").draw
        with pytest.raises(Exception) as raised:  # noqa: PT011
            draw()
        assert cause(raised.value) == f"{says}, at small/scene.py:5"


def test_a_module_that_cannot_be_read_is_told_with_its_line(tmp_path: Path) -> None:
    with small_package(tmp_path, {"scene": "def draw(:\n    pass\n"}):
        with pytest.raises(SyntaxError) as raised:
            import_module(f"{PACKAGE}.scene")
        assert cause(raised.value) == "SyntaxError: invalid syntax, at small/scene.py:1"
