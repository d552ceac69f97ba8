"""A little book, and the command line run on it."""

from collections.abc import Callable

import pytest
from support.little_book import OUTLINE, MakeBook
from support.little_book import bundled as bundled
from support.little_book import make_book as make_book


@pytest.fixture
def run(make_book: MakeBook, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Run the command on a little book without figures whose first chapter is ``body``."""
    from site_builder.__main__ import main

    def command(*words: str, body: str = "Text.\n") -> int:
        options = make_book(body, {"content/book.toml": OUTLINE})
        monkeypatch.setattr("site_builder.__main__.ROOT", options.root)
        return main(list(words))

    return command
