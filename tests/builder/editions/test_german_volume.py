"""A book in German is typeset with the words of its interface in German."""

from collections.abc import Callable

import pytest
from support.interface_words import phrases

from site_builder.build import Options
from site_builder.editions.compose import Composed, compose
from site_builder.editions.tree import elements, words
from site_builder.editions.volume import volume
from site_builder.languages.words import ENGLISH, load_words

OUTLINE = """\
title = "Kleines Buch"
subtitle = "Ein Buch für Tests."
prerequisites = "Keine."
language = "de"
chapters = ["00-first", "01-second"]
"""


@pytest.fixture
def composed(make_book: Callable[..., Options], body: str) -> Composed:
    return compose(make_book(body, {"content/book.toml": OUTLINE}))


def test_no_word_of_the_interface_is_english(composed: Composed) -> None:
    whole = volume(composed)
    text = words(whole)
    german = "\n".join(phrase for _, phrase in phrases(load_words("de")))
    left = [phrase for _, phrase in phrases(ENGLISH) if phrase in text and phrase not in german]
    assert left == []
    assert whole.get("lang") == "de"
    assert [words(heading) for heading in elements(whole, "h1")][-1] == "Antworten"
