"""The JSON schema of ``book.toml`` says what the reading does."""

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from site_builder.settings.described import book_schema
from site_builder.settings.kinds import (
    COLOUR,
    PREFIX,
    SITE,
    TEXT,
    Kind,
    one_of,
    texts,
    whole_number,
)

ROOT = Path(__file__).parents[3]


def admits(schema: Mapping[str, Any], value: object) -> bool:
    """Whether a value is legal by the part of JSON schema that is used here."""
    if "enum" in schema:
        return value in schema["enum"]
    match schema["type"]:
        case "string":
            form = re.search(schema.get("pattern", ""), value) if isinstance(value, str) else None
            return form is not None and len(str(value)) >= schema["minLength"]
        case "integer":
            whole = isinstance(value, int) and not isinstance(value, bool)
            return whole and value >= schema["minimum"]
        case "array":
            items = isinstance(value, list) and all(admits_text(item) for item in value)
            return items and isinstance(value, list) and len(value) >= schema["minItems"]
        case _:
            known = isinstance(value, dict) and set(value) <= set(schema["properties"])
            return (
                known
                and isinstance(value, dict)
                and set(schema.get("required", ())) <= set(value)
                and all(admits(schema["properties"][key], item) for key, item in value.items())
            )


def admits_text(value: object) -> bool:
    return isinstance(value, str)


@pytest.mark.parametrize("folder", ["", "tests/fixtures/german-book"])
def test_the_books_here_fit_the_schema(folder: str) -> None:
    text = (ROOT / folder / "content" / "book.toml").read_text(encoding="utf-8")
    assert admits(book_schema(), tomllib.loads(text))


def test_an_unknown_key_does_not_fit() -> None:
    assert not admits(book_schema(), {"title": "T", "nope": 1})


@pytest.mark.parametrize(
    "kind", [TEXT, COLOUR, SITE, PREFIX, whole_number(0), one_of(("a", "b")), texts("", 1)]
)
@pytest.mark.parametrize(
    "value",
    [
        *("", "a", "#12ab34", "#12ab3", "https://a.b/", "https://a.b", "a-b", "a b"),
        *(0, -1, True, 1.5, [], ["a"], [1], None),
    ],
)
def test_schema_and_reading_agree(kind: Kind, value: object) -> None:
    try:
        kind.read(value)
        legal = True
    except ValueError:
        legal = False
    assert admits(kind.schema, value) == legal
