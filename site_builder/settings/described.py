"""The table of the keys of ``book.toml`` in the guide."""

from collections.abc import Iterator
from typing import Any

from site_builder.settings.declared import Key, keys_of
from site_builder.settings.model import Settings


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
