"""News: mistakes in their file, each with its line."""

from collections.abc import Callable

import pytest

FILE = "content/news.toml"
GOOD = '[[entry]]\ndate = 2026-11-22\ntitle = "T"\nsays = "S."\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("entry = 3\n", "1: no entries; legal: each below '[[entry]]'"),
        (f"{GOOD}chapter = 'frist'\n", "5: unknown chapter 'frist'; did you mean 'first'?"),
        (
            f"{GOOD}link = 'x'\n",
            "5: unknown key of [entry] 'link'; legal: date, title, says, chapter",
        ),
        (GOOD.replace("2026-11-22", "'today'"), '2: entry.date is "today"; legal: 2026-11-22'),
        (GOOD.replace("S.", " "), '4: entry.says is " "; legal: "some text"'),
        (f"{GOOD}\n{GOOD}", "6: a second 'T' of 2026-11-22; legal: one"),
        (
            f"{GOOD}\n{GOOD.replace('22', '23')}",
            "6: 2026-11-23 stands below an older entry; legal: above it",
        ),
    ],
)
def test_a_mistake_is_told_with_its_line(
    mistakes: Callable[..., list[str]], text: str, message: str
) -> None:
    assert mistakes("Text.\n", {FILE: text}) == [f"{FILE}:{message}"]
