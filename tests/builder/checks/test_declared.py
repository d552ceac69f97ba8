"""What lies where scenes, ladders and their like are looked for, but cannot be found there."""

from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder.checks.declared import check_declarations
from site_builder.diagnostics import Diagnostics

ROOT = Path(__file__).resolve().parents[3]
INIT = "__init__.py"
type Check = Callable[[dict[str, str]], list[str]]


@pytest.fixture
def check(tmp_path: Path) -> Check:
    """The mistakes of a book whose ``simulations`` are these files."""

    def found(files: dict[str, str]) -> list[str]:
        for path, text in files.items():
            file = tmp_path / "simulations" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        problems = Diagnostics()
        check_declarations(tmp_path, problems)
        return [str(problem) for problem in problems.found]

    return found


def scene(**files: str) -> dict[str, str]:
    written = {f"scenes/big_wave/{name}.py": text for name, text in files.items()}
    return {f"scenes/big_wave/{INIT}": "", **written}


def test_this_book_declares_all_that_it_has() -> None:
    problems = Diagnostics()
    check_declarations(ROOT, problems)
    assert problems.found == []


@pytest.mark.parametrize(
    "files",
    [
        scene(scene="SCENE = Scene('big-wave', 'A wave')", drawing="def draw(): ..."),
        scene(scene="SCENE: Scene = Scene(title='A wave', id='big-wave')"),
        scene(scene="SCENE = make_scene()"),
        {"ladders/fast_sum.py": "LADDER = Ladder(id='fast-sum')"},
        {f"ladders/sums/{INIT}": "", "ladders/sums/ladder.py": "LADDER = Ladder(id='sums')"},
        {"scenes/_shared/ball.py": "X = 1", "illustrations/_space.py": "X = 1"},
        {"scenes/gone/__pycache__/scene.pyc": "", "scenes/notes.txt": ""},
        scene(scene="SCENE = Scene('big-wave'"),
        {},
    ],
    ids=[
        "scene", "id by name", "id made elsewhere", "ladder", "ladder in a package", "shared",
        "no Python", "no syntax: told where a page asks for it", "nothing",
    ],
)  # fmt: skip
def test_what_can_be_found_is_no_mistake(check: Check, files: dict[str, str]) -> None:
    assert check(files) == []


@pytest.mark.parametrize(
    ("files", "place", "says"),
    [
        (scene(stages="X = 1"), "scenes/big_wave:1", "no SCENE in scene.py; legal: one"),
        (scene(scene="X = 1"), "scenes/big_wave/scene.py:1", "no SCENE; legal: one"),
        (
            scene(scene="SCENE = Scene('big-wave')\nSCENE = Scene('big-wave')"),
            "scenes/big_wave/scene.py:2",
            "a SCENE too many; legal: one, in scene.py",
        ),
        (
            scene(scene="SCENE = Scene('big-wave')", other="\nSCENE = Scene('other')"),
            "scenes/big_wave/other.py:2",
            "a SCENE too many",
        ),
        (
            scene(scene="SCENE = Scene(\n    'wave', 'A wave')"),
            "scenes/big_wave/scene.py:2",
            "id 'wave' in scene.py; legal: 'big-wave'",
        ),
        (
            {"scenes/wave.py": "SCENE = Scene('wave')"},
            "scenes/wave.py:1",
            "a module among packages; legal: wave/scene.py",
        ),
        (
            {"scenes/wave/scene.py": "SCENE = Scene('wave')"},
            "scenes/wave:1",
            "legal: an empty __init__.py",
        ),
        (
            {
                "ladders/sums.py": "LADDER = Ladder('sums')",
                f"ladders/sums/{INIT}": "",
                "ladders/sums/ladder.py": "LADDER = Ladder('sums')",
            },
            "ladders/sums.py:1",
            "sums has that name; legal: another",
        ),
        ({"illustrations/sky.py": "X = 1"}, "illustrations/sky.py:1", "no draw; legal: one"),
        (
            {f"hard_cases/sums/{INIT}": "TABLE = 1"},
            "hard_cases/sums:1",
            "a package among modules; legal: sums.py",
        ),
    ],
)
def test_what_cannot_be_found_is_told_with_its_place(
    check: Check, files: dict[str, str], place: str, says: str
) -> None:
    (told,) = check(files)
    assert told.startswith(f"simulations/{place}: ")
    assert says in told
