"""``content/news.toml``: what changed in the book, for those who follow its feed.

An ``[[entry]]`` for each change: ``date``, ``title``, ``says``, both plain text, and ``chapter``
where it is about one. Newest first.
"""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from site_builder.diagnostics.diagnostic import unknown
from site_builder.files.text import Sources
from site_builder.settings.declared import DAY, TEXT, Reader, key

FILE = "content/news.toml"
ENTRY = "entry"


@dataclass(frozen=True, slots=True)
class News:
    """One change."""

    date: str = key(DAY)
    """``2026-11-22``."""
    title: str = key(TEXT)
    says: str = key(TEXT)
    chapter: str = key(TEXT, default="")
    """Id of the chapter that it is about; nothing where it is about the book."""

    @property
    def id(self) -> str:
        """Unique in the feed, and the same as long as date and title are."""
        return f"{self.date}-{re.sub(r'[^a-z0-9]+', '-', self.title.lower()).strip('-')}"


def read_news(sources: Sources, chapters: Collection[str]) -> tuple[News, ...]:
    """All entries; none where there is no such file. Mistakes are reported."""
    toml = sources.toml(FILE)
    if toml is None:
        return ()
    reader = Reader(FILE, toml, sources.problems)
    news = reader.tables(News, ENTRY) or ()
    _check(news, chapters, reader)
    return news


def _check(news: Sequence[News], chapters: Collection[str], reader: Reader) -> None:
    """Report unknown chapters, entries out of order, and repeated ones."""
    for index, entry in enumerate(news):
        at, earlier = (ENTRY, index), news[:index]
        if entry.chapter and entry.chapter not in chapters:
            reader.report((*at, "chapter"), unknown("chapter", entry.chapter, chapters))
        if earlier and entry.date > earlier[-1].date:
            reader.report(at, f"{entry.date} stands below an older entry; legal: above it")
        if entry.id in [other.id for other in earlier]:
            reader.report(at, f"a second {entry.title!r} of {entry.date}; legal: one")
