"""``content/news.toml``: what changed in the book, for those who follow its feed.

An ``[[entry]]`` for each change: ``date``, ``title``, ``says``, both plain text, and ``chapter``
where it is about one. Newest first.
"""

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from datetime import date, datetime
from pathlib import Path

from site_builder.diagnostics import Diagnostics, unknown
from site_builder.source_text import read_toml

FILE = "content/news.toml"
ENTRY = "entry"
TEXTS = ("title", "says")
KEYS = ("date", *TEXTS, "chapter")


@dataclass(frozen=True, slots=True)
class News:
    """One change."""

    date: str
    """``2026-11-22``."""
    title: str
    says: str
    chapter: str
    """Id of the chapter that it is about; nothing where it is about the book."""

    @property
    def id(self) -> str:
        """Unique in the feed, and the same as long as date and title are."""
        return f"{self.date}-{re.sub(r'[^a-z0-9]+', '-', self.title.lower()).strip('-')}"


def read_news(root: Path, chapters: Collection[str], problems: Diagnostics) -> tuple[News, ...]:
    """All entries; nothing where there is no such file. Mistakes go to ``problems``."""
    read = read_toml(root, FILE, problems) if (root / FILE).is_file() else None
    if read is None:
        return ()
    for key in read.table:
        if key != ENTRY:
            problems.add(FILE, read.line(key), unknown("key", key, (ENTRY,)))
    entries = read.table.get(ENTRY)
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        problems.add(FILE, read.line(ENTRY), f"no entries; legal: each below '[[{ENTRY}]]'")
        return ()
    lines = [read.line(ENTRY, index) for index in range(len(entries))]
    news = tuple(
        _entry(entry, line, chapters, problems) for entry, line in zip(entries, lines, strict=True)
    )
    _check_order(news, lines, problems)
    return news


def _entry(
    entry: Mapping[str, object], line: int, chapters: Collection[str], problems: Diagnostics
) -> News:
    for key in entry:
        if key not in KEYS:
            problems.add(FILE, line, unknown("key", key, KEYS))
    day = entry.get("date")
    if not isinstance(day, date) or isinstance(day, datetime):
        problems.add(FILE, line, "no 'date'; legal: date = 2026-11-22")
        day = date.min
    texts = {}
    for key in TEXTS:
        value = entry.get(key)
        if not (isinstance(value, str) and value.strip()):
            problems.add(FILE, line, f'no {key!r}; legal: {key} = "some text"')
        texts[key] = str(value).strip()
    chapter = str(entry.get("chapter", ""))
    if chapter and chapter not in chapters:
        problems.add(FILE, line, unknown("chapter", chapter, chapters))
    return News(day.isoformat(), texts["title"], texts["says"], chapter)


def _check_order(news: tuple[News, ...], lines: list[int], problems: Diagnostics) -> None:
    seen: set[str] = set()
    for index, (entry, line) in enumerate(zip(news, lines, strict=True)):
        if index and entry.date > news[index - 1].date:
            problems.add(FILE, line, f"{entry.date} stands below an older entry; legal: above it")
        if entry.id in seen:
            problems.add(FILE, line, f"a second {entry.title!r} of {entry.date}; legal: one")
        seen.add(entry.id)
