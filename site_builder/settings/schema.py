"""The JSON schema of ``book.toml``, by which editors complete, explain and check it."""

from typing import Any

from site_builder.settings.declared import Key, keys_of
from site_builder.settings.kinds import Table
from site_builder.settings.model import Settings

DRAFT = "http://json-schema.org/draft-07/schema#"
"""The one that editors of TOML understand."""


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
    said = {"description": item.doc}
    if isinstance(item.kind, Table):
        return {**said, **_table(item.kind.of)}
    default = {} if item.required or item.without else {"default": _plain(item.default)}
    return {**said, **item.kind.schema(), **default}


def _plain(value: object) -> object:
    return list(value) if isinstance(value, tuple) else value
