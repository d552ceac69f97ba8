r"""``content/symbols.toml``: what each symbol of the book's formulae means, and its unit.

A table for each chapter, by its id, with lines ``'k_1' = ["meaning", "unit"]``; the unit is left
out of a pure number. The table ``book`` has what holds in every chapter that says nothing else.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from site_builder.diagnostics import Diagnostics

FILE = "content/symbols.toml"
BOOK = "book"
FORM = '["meaning", "unit"]'


@dataclass(frozen=True, slots=True)
class Symbol:
    """One symbol as it is declared."""

    tex: str
    means: str
    """As Markdown."""
    unit: str
    """Nothing of a pure number."""
    line: int


type Symbols = Mapping[str, tuple[Symbol, ...]]
"""By the chapter for which they are declared, or `BOOK`."""


def read_symbols(root: Path, problems: Diagnostics) -> Symbols:
    """What the file holds; nothing where there is none. Mistakes go to ``problems``."""
    file = root / FILE
    if not file.is_file():
        return {}
    text = file.read_text(encoding="utf-8")
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"line (\d+)", str(error))
        problems.add(FILE, int(place[1]) if place else 1, f"malformed TOML: {error}")
        return {}
    lines = dict(_lines(text))
    found: dict[str, tuple[Symbol, ...]] = {}
    for chapter, table in tables.items():
        if not isinstance(table, dict):
            problems.add(FILE, 1, f"{chapter!r} outside a table; legal: '[{BOOK}]' above it")
            continue
        rows = [_symbol(tex, row, lines.get((chapter, tex), 1)) for tex, row in table.items()]
        for tex, row in zip(table, rows, strict=True):
            if row is None:
                problems.add(FILE, lines.get((chapter, tex), 1), f"{tex!r}; legal: {FORM}")
        found[chapter] = tuple(row for row in rows if row)
    return found


def _symbol(tex: str, row: object, line: int) -> Symbol | None:
    texts = [item for item in row if isinstance(item, str)] if isinstance(row, list) else []
    if not isinstance(row, list) or len(row) not in (1, 2) or len(texts) != len(row):
        return None
    return Symbol(tex, texts[0], texts[1] if len(texts) > 1 else "", line) if texts[0] else None


def _lines(text: str) -> Iterator[tuple[tuple[str, str], int]]:
    """Where each key of each table stands."""
    chapter = ""
    for number, line in enumerate(text.splitlines(), start=1):
        if head := re.fullmatch(r"\s*\[([\w-]+)\]\s*", line):
            chapter = head[1]
        elif key := re.match(r"\s*['\"]?(.+?)['\"]?\s*=", line):
            yield (chapter, key[1]), number
