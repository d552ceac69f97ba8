"""The index is made under Node by the library that the page searches with."""

import json
from pathlib import Path

import pytest

from site_builder.languages.words import ENGLISH
from site_builder.search.index import Means, index_of, indexing
from site_builder.search.library import fetch_library
from site_builder.search.records import Record


def record(number: int) -> Record:
    return Record(number, f"page/#{number}", "Page", "Title", (), (), "Some text.", "", "")


RECORDS = ((record(0), record(1)), (record(2),))


@pytest.fixture(scope="module")
def means() -> Means:
    return indexing(fetch_library("en"), ENGLISH)


def test_every_section_is_in_the_index(means: Means) -> None:
    made = index_of(RECORDS, means)
    assert json.loads(made)["documentCount"] == 3


def test_what_keeps_node_from_it_is_reported_in_its_words(means: Means, tmp_path: Path) -> None:
    missing = Means((tmp_path / "missing.js", *means.scripts[1:]), ("", ""))
    with pytest.raises(RuntimeError, match="missing"):
        index_of(RECORDS, missing)
