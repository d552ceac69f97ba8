"""Python's own exceptions, as an author reads them: what is wrong, and on which line of a scene."""

from importlib import import_module
from pathlib import Path

import pytest
from support.small_package import PACKAGE, small_package

from site_builder.diagnostics.blame import at_settings
from site_builder.diagnostics.diagnostic import BuildError, Diagnostics, cause
from site_builder.sandbox.loading import imported
from site_builder.sandbox.pool import LimitError, Limits, limited

SLIPS = [
    ("return {'curve': 1}['curves']", "KeyError: 'curves'"),
    (
        "return math.sinn(1)",
        "AttributeError: module 'math' has no attribute 'sinn'. Did you mean: 'sin'?",
    ),
    ("return heigth", "NameError: name 'heigth' is not defined. Did you mean: 'height'?"),
    ("return 1 / 0", "ZeroDivisionError: division by zero"),
    ("raise ValueError('height -1; legal: above 0')", "ValueError: height -1; legal: above 0"),
    ("assert height < 0", "AssertionError"),
]


@pytest.mark.parametrize(("line", "says"), SLIPS)
def test_an_exception_is_told_in_words_with_its_place(line: str, says: str, tmp_path: Path) -> None:
    source = f"import math\nheight = 3\n\ndef draw():\n    {line}\n"
    with small_package(tmp_path, {"scene": source}):
        draw = import_module(f"{PACKAGE}.scene").draw
        with pytest.raises(Exception) as raised:  # noqa: PT011
            draw()
        assert cause(raised.value) == f"{says}, at simulations/small/scene.py:5"


def test_a_module_that_cannot_be_read_is_told_with_its_line(tmp_path: Path) -> None:
    with small_package(tmp_path, {"scene": "def draw(:\n    pass\n"}):
        with pytest.raises(SyntaxError) as raised:
            import_module(f"{PACKAGE}.scene")
        assert cause(raised.value) == "SyntaxError: invalid syntax, at simulations/small/scene.py:1"


def test_a_module_that_ends_its_process_is_told_with_its_file(tmp_path: Path) -> None:
    with small_package(tmp_path, {"scene": "import os\nos._exit(3)\n"}), limited(Limits()):
        with pytest.raises(LimitError) as raised:
            imported(f"{PACKAGE}.scene")
        assert cause(raised.value) == (
            "LimitError: its process was ended by its own code, as 3, while it was imported, "
            "at simulations/small/scene.py:1"
        )


def test_what_a_scene_raises_is_told_once_at_its_line_with_where_it_is_met(tmp_path: Path) -> None:
    problems = Diagnostics()
    with small_package(tmp_path, {"scene": "def draw():\n    return 1 / 0\n"}):
        draw = import_module(f"{PACKAGE}.scene").draw
        for line in (7, 9):
            with pytest.raises(ZeroDivisionError) as raised, at_settings({"k1": line / 10}):
                draw()
            problems.add("content/a.md", line, "simulation 'a' cannot be drawn", raised.value)
    (only,) = BuildError(problems.found).diagnostics
    assert str(only) == (
        "simulations/small/scene.py:2: ZeroDivisionError: division by zero "
        "(met at content/a.md:7, k1 = 0.7)"
    )


def test_what_the_engine_raises_is_told_at_the_line_of_the_scene(tmp_path: Path) -> None:
    source = "from simulations.engine.drawing import polyline\npolyline([(0, 0)] * 1_000_000)\n"
    with small_package(tmp_path, {"scene": source}):
        with pytest.raises(ValueError, match="1,000,000 points; legal") as raised:
            import_module(f"{PACKAGE}.scene")
        assert cause(raised.value).endswith(", at simulations/small/scene.py:2")
