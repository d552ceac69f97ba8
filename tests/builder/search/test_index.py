"""The index is the same whether its pages come at once or one after the other."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from site_builder.book_root import ENGINE
from site_builder.languages.words import ENGLISH
from site_builder.search.index import Indexer, Means, index_of, indexing
from site_builder.search.library import fetch_library
from site_builder.search.records import make_records


def page(word: str) -> bytes:
    body = f'<h1>{word}</h1><p>Of {word}.</p><h2 id="s">S</h2><p><em>{word}</em> again.</p>'
    return f"<main><article data-searched>{body}</article></main>".encode()


PAGES = {f"{word}/index.html": page(word) for word in ("lens", "light", "pose")}
EXPLAINED = {"light/#s": ["lamp"]}


@pytest.fixture(scope="module")
def means() -> Means:
    return indexing(fetch_library(), ENGINE / "static", ENGLISH)


@pytest.fixture
def indexer() -> Iterator[Indexer]:
    with Indexer() as found:
        yield found


def made_at_once(means: Means) -> bytes:
    return index_of(make_records(PAGES, EXPLAINED), means, Indexer())


def test_pages_that_come_while_others_are_made_give_the_same_index(
    indexer: Indexer, means: Means
) -> None:
    indexer.begin(means, EXPLAINED, PAGES)
    for path, content in reversed(PAGES.items()):
        indexer.hear(path, content)
    made = index_of(make_records(PAGES, EXPLAINED), means, indexer)
    assert made == made_at_once(means)
    assert json.loads(made)["documentCount"] == 6


def test_pages_that_never_came_are_in_it(indexer: Indexer, means: Means) -> None:
    indexer.begin(means, EXPLAINED, PAGES)
    first = next(iter(PAGES))
    indexer.hear(first, PAGES[first])
    assert index_of(make_records(PAGES, EXPLAINED), means, indexer) == made_at_once(means)


def test_of_a_page_that_came_otherwise_it_has_the_last(indexer: Indexer, means: Means) -> None:
    indexer.begin(means, EXPLAINED, PAGES)
    for path in PAGES:
        indexer.hear(path, page("other"))
    assert index_of(make_records(PAGES, EXPLAINED), means, indexer) == made_at_once(means)


def test_what_keeps_node_from_it_is_told_in_its_words(
    indexer: Indexer, means: Means, tmp_path: Path
) -> None:
    missing = Means((tmp_path / "missing.js", *means.scripts[1:]), "")
    indexer.begin(missing, {}, PAGES)
    for path, content in PAGES.items():
        indexer.hear(path, content)
    with pytest.raises(RuntimeError, match="missing"):
        index_of(make_records(PAGES, {}), missing, indexer)


def test_node_is_ended_where_nobody_asks_for_the_index(means: Means) -> None:
    with Indexer() as indexer:
        indexer.begin(means, EXPLAINED, PAGES)
        process = indexer._process
    assert process is not None
    assert process.returncode is not None
