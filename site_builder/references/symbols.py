r"""``content/symbols.toml``: what each symbol of the book's formulae means, and its unit.

A table for each chapter, by its id, with lines ``'k_1' = ["meaning", "unit"]``; the unit is left
out of a pure number. The table ``book`` has what holds in every chapter that says nothing else.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from site_builder.files.text import Sources

FILE = "content/symbols.toml"
BOOK = "book"
FORM = '["meaning", "unit"]'


@dataclass(frozen=True, slots=True)
class Symbol:
    """One symbol as it is declared."""

    tex: str
    means: str
    """Markdown."""
    unit: str
    """Nothing of a pure number."""
    line: int


type Symbols = Mapping[str, tuple[Symbol, ...]]
"""Symbols by the chapter for which they are declared, or `BOOK`."""


def read_symbols(sources: Sources) -> Symbols:
    """The symbols in the file; none where there is no such file. Mistakes are reported."""
    read, problems = sources.toml(FILE), sources.problems
    if read is None:
        return {}
    found: dict[str, tuple[Symbol, ...]] = {}
    for chapter, table in read.table.items():
        if not isinstance(table, dict):
            message = f"{chapter!r} outside a table; legal: '[{BOOK}]' above it"
            problems.add(FILE, read.line(chapter), message)
            continue
        rows = [_symbol(tex, row, read.line(chapter, tex)) for tex, row in table.items()]
        for tex, row in zip(table, rows, strict=True):
            if row is None:
                problems.add(FILE, read.line(chapter, tex), f"{tex!r}; legal: {FORM}")
        found[chapter] = tuple(row for row in rows if row)
    return found


def _symbol(tex: str, row: object, line: int) -> Symbol | None:
    texts = [item for item in row if isinstance(item, str)] if isinstance(row, list) else []
    if not isinstance(row, list) or len(row) not in (1, 2) or len(texts) != len(row):
        return None
    return Symbol(tex, texts[0], texts[1] if len(texts) > 1 else "", line) if texts[0] else None
