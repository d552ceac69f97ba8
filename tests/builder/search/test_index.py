"""The index is made under Node by the library that the page searches with."""

import json
from pathlib import Path

import pytest

from site_builder.book_root import ENGINE
from site_builder.languages.words import ENGLISH
from site_builder.search.index import Means, index_of, indexing
from site_builder.search.library import fetch_library
from site_builder.search.records import make_records


def page(word: str) -> bytes:
    body = f'<h1>{word}</h1><p>Of {word}.</p><h2 id="s">S</h2><p><em>{word}</em> again.</p>'
    return f"<main><article data-searched>{body}</article></main>".encode()


PAGES = {f"{word}/index.html": page(word) for word in ("lens", "light", "pose")}


@pytest.fixture(scope="module")
def means() -> Means:
    return indexing(fetch_library(), ENGINE / "static", ENGLISH)


def test_every_section_is_in_the_index(means: Means) -> None:
    made = index_of(make_records(PAGES, {"light/#s": ["lamp"]}), means)
    assert json.loads(made)["documentCount"] == 6


def test_what_keeps_node_from_it_is_reported_in_its_words(means: Means, tmp_path: Path) -> None:
    missing = Means((tmp_path / "missing.js", *means.scripts[1:]), "")
    with pytest.raises(RuntimeError, match="missing"):
        index_of(make_records(PAGES, {}), missing)
