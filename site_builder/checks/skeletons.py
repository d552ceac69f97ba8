"""Warnings of sentences that ``new`` wrote for an author to replace."""

from collections.abc import Iterator
from pathlib import Path

from site_builder.document.book import OUTLINE, Book
from site_builder.files.text import Sources

PLACEHOLDERS = (
    "What this book is about, in a sentence.",
    "What its reader should know.",
    "In one sentence, what this chapter tells.",
    "say one thing that one could not say before",
    "Begin with something that one can see or hear.",
    "Say what happens, then why.",
    "What comes out, if 21 is doubled?",
    ": what is drawn here, in a sentence.",
    ": which law this is, in a sentence.",
    ": what is computed here in several ways.",
)
"""Sentences of the templates in ``scaffold/``."""
ROOMS = ("scenes", "ladders", "models")
"""Folders of ``simulations`` in which ``new`` writes."""


def check_skeletons(sources: Sources, book: Book) -> None:
    """Warn of each such sentence."""
    for path in _written(sources.root, book):
        data = (sources.root / path).read_bytes()
        for sentence in PLACEHOLDERS:
            if (place := data.find(sentence.encode())) >= 0:
                said = f"{sentence.lstrip(': ')!r} is still as `new` wrote it; better: your own"
                sources.problems.warn(path, data.count(b"\n", 0, place) + 1, said)


def _written(root: Path, book: Book) -> Iterator[str]:
    """Paths of files that ``new`` may have written."""
    paths = (OUTLINE, *(chapter.path for chapter in book.chapters))
    yield from (path for path in paths if (root / path).is_file())
    for room in ROOMS:
        for file in sorted((root / "simulations" / room).rglob("*.py")):
            yield file.relative_to(root).as_posix()
