"""The pins of the three groups: what one needs is pinned alike in all that contain it."""

import re
from pathlib import Path

LOCKS = Path(__file__).resolve().parents[2] / ".locks"


def pins(group: str) -> set[str]:
    text = (LOCKS / f"{group}.txt").read_text(encoding="utf-8")
    return set(re.findall(r"^[\w.-]+==[^\s;]+", text, re.MULTILINE))


def test_a_new_book_is_built_and_tested_with_the_pins_of_this_one() -> None:
    assert pins("book") < pins("author") < pins("test")
