"""The keys of ``book.toml`` for authors: a table in the guide, and a JSON schema for editors."""

from collections.abc import Iterator
from typing import Any

from site_builder.settings.declared import Key, keys_of
from site_builder.settings.model import Settings

DRAFT = "http://json-schema.org/draft-07/schema#"
"""The one that editors of TOML understand."""


def settings_table() -> str:
    """A Markdown table with a line for each key, those of tables after their table's name."""
    rows = [f"| {name} | {doc} | {default} |" for name, doc, default in _rows(Settings, "")]
    return "\n".join(["| Key | Sets | Default |", "|---|---|---|", *rows])


def _rows(of: type[Any], prefix: str) -> Iterator[tuple[str, str, str]]:
    for item in keys_of(of):
        name = f"{prefix}{item.name}"
        if item.kind.table:
            yield from _rows(item.kind.table, f"{name}.")
        else:
            expected = item.kind.expected
            legal = f"`{expected}`" if expected[0] in '"[' else expected
            yield f"`{name}`", f"{item.doc}: {legal}", _default(item)


def _default(item: Key) -> str:
    if item.required:
        return "required"
    if item.without or item.default == ():
        return item.without or "none"
    return f"`{item.default}`"


def book_schema() -> dict[str, object]:
    """Of the whole file."""
    return {"$schema": DRAFT, "title": "content/book.toml", **_table(Settings)}


def _table(of: type[Any]) -> dict[str, object]:
    keys = list(keys_of(of))
    required = [item.name for item in keys if item.required]
    return {
        "type": "object",
        "additionalProperties": False,
        "properties": {item.name: _key(item) for item in keys},
        **({"required": required} if required else {}),
    }


def _key(item: Key) -> dict[str, object]:
    described = {"description": item.doc}
    if item.kind.table:
        return {**described, **_table(item.kind.table)}
    plain = list(item.default) if isinstance(item.default, tuple) else item.default
    default = {} if item.required or item.without else {"default": plain}
    return {**described, **item.kind.schema, **default}
