"""The pins of the two groups: what one needs is pinned alike in all that contain it."""

import re
from pathlib import Path

LOCKS = Path(__file__).resolve().parents[2] / ".locks"


def pins(group: str) -> set[str]:
    text = (LOCKS / f"{group}.txt").read_text(encoding="utf-8")
    return set(re.findall(r"^[\w.-]+==[^\s;]+", text, re.MULTILINE))


def test_the_book_is_built_by_the_pins_that_it_is_tested_with() -> None:
    assert pins("book") < pins("test")
