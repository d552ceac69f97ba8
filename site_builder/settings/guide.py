"""The author's table of the keys of ``book.toml``, a page of the guide."""

from collections.abc import Iterator
from typing import Any

from site_builder.settings.declared import Key, keys_of
from site_builder.settings.kinds import Table
from site_builder.settings.model import Settings


def settings_table() -> str:
    """A Markdown table with a line for each key, those of tables after their table's name."""
    rows = [f"| {name} | {doc} | {default} |" for name, doc, default in _rows(Settings, "")]
    return "\n".join(["| Key | Sets | Default |", "|---|---|---|", *rows])


def _rows(of: type[Any], prefix: str) -> Iterator[tuple[str, str, str]]:
    for item in keys_of(of):
        name = f"{prefix}{item.name}"
        if isinstance(item.kind, Table):
            yield from _rows(item.kind.of, f"{name}.")
        else:
            yield f"`{name}`", f"{item.doc}: {_legal(item)}", _default(item)


def _legal(item: Key) -> str:
    return f"`{item.kind.expected}`" if item.kind.expected[0] in '"[' else item.kind.expected


def _default(item: Key) -> str:
    if item.required:
        return "required"
    if item.without or item.default == ():
        return item.without or "none"
    return f"`{item.default}`"
