"""The parts of a book: each begins with a chapter, and ends where the next begins."""

from collections.abc import Mapping, Sequence

from site_builder.diagnostics.diagnostic import Diagnostics, unknown
from site_builder.files.text import Toml
from site_builder.settings.model import FILE_NAME


def part_titles(parts: Mapping[str, str], chapters: Sequence[str]) -> list[str]:
    """For each of the ``chapters``, by id, the title of the part that it is in; nothing before the
    first part. ``parts``: title to the id of the first chapter."""
    begun = {first: title for title, first in parts.items()}
    titles, title = [], ""
    for chapter in chapters:
        title = begun.get(chapter, title)
        titles.append(title)
    return titles


def check_parts(
    parts: Mapping[str, str],
    chapters: Sequence[str],
    toml: Toml,
    problems: Diagnostics,
    path: str = FILE_NAME,
) -> None:
    """Report parts that begin with no chapter, and those that are not in the order of chapters."""
    last, before = -1, ""
    for title, first in parts.items():
        line = toml.line("parts", title)
        if first not in chapters:
            problems.add(path, line, unknown("chapter", first, chapters))
            continue
        if (place := chapters.index(first)) <= last:
            message = f"part {title!r} begins with {first!r}, where {before!r} has begun"
            problems.add(path, line, f"{message}; legal: a chapter after {chapters[last]!r}")
        last, before = max(last, place), title
