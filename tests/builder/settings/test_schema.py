"""The JSON schema of ``book.toml`` says what the reading does."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from site_builder.settings.described import book_schema
from site_builder.settings.kinds import fits

ROOT = Path(__file__).parents[3]


def admits(schema: Mapping[str, Any], values: object) -> bool:
    """Whether a table has legal keys and values."""
    if "properties" not in schema:
        return fits(values, schema)
    return (
        isinstance(values, dict)
        and set(schema.get("required", ())) <= set(values) <= set(schema["properties"])
        and all(admits(schema["properties"][key], value) for key, value in values.items())
    )


@pytest.mark.parametrize("folder", ["", "tests/fixtures/german-book"])
def test_the_books_here_fit_the_schema(folder: str) -> None:
    text = (ROOT / folder / "content" / "book.toml").read_text(encoding="utf-8")
    assert admits(book_schema(), tomllib.loads(text))


def test_an_unknown_key_does_not_fit() -> None:
    assert not admits(book_schema(), {"title": "T", "nope": 1})
