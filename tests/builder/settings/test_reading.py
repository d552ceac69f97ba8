"""``book.toml``: what it says, and what is said of its mistakes."""

from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.settings.model import Settings
from site_builder.settings.reading import read_settings, storage_prefix

LEAST = 'title = "Small Book"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first"]\n'
type Read = Callable[[str], tuple[Settings, list[str]]]


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Settings of a file that begins with the least that one must say, and its mistakes."""

    def reading(more: str) -> tuple[Settings, list[str]]:
        (tmp_path / "content").mkdir(exist_ok=True)
        (tmp_path / "content" / "book.toml").write_text(LEAST + more, encoding="utf-8")
        problems = Diagnostics()
        settings, _ = read_settings(tmp_path, problems)
        return settings, [str(problem) for problem in problems.found]

    return reading


def test_what_is_left_out_has_its_default(read: Read) -> None:
    settings, mistakes = read("")
    assert mistakes == []
    assert (settings.language, settings.first_number, settings.licence.code) == ("en", 0, "MIT")


def test_what_is_said_holds(read: Read) -> None:
    settings, mistakes = read(
        'language = "de"\nfirst_number = 1\n[licence]\ntext = "CC0"\n[labels]\nfigure = "Picture"\n'
    )
    assert mistakes == []
    assert (settings.language, settings.first_number) == ("de", 1)
    assert (settings.licence.text, settings.labels.figure) == ("CC0", "Picture")


def test_an_author_may_have_an_orcid(read: Read) -> None:
    settings, mistakes = read(
        '[imprint]\nauthors = ["Ada Lovelace", "J. Doe 0000-0002-1825-0097"]\n'
        'date = 2026-11-26\nisbn = "978-3-16-148410-0"\ndoi = "10.1000/182"\n'
    )
    assert mistakes == []
    assert settings.imprint.people == (("Ada Lovelace", ""), ("J. Doe", "0000-0002-1825-0097"))
    assert settings.imprint.date == "2026-11-26"


def test_what_a_browser_keeps_is_named_after_the_book_or_as_its_author_says(read: Read) -> None:
    assert storage_prefix(read("")[0]) == "small-book"
    assert storage_prefix(read('storage = "mine"\n')[0]) == "mine"
