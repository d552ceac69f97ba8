"""The index of the search, made under Node by the library that the page asks it with."""

import json
import os
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields
from pathlib import Path
from types import TracebackType
from typing import Self

from site_builder.editor.npm import NODE
from site_builder.kept.files import bytes_hash, file_hash
from site_builder.kept.keeper import kept_as, store_now
from site_builder.languages.words import Words
from site_builder.search.library import HERE, SearchLibrary
from site_builder.search.page_text import Section
from site_builder.search.records import PageRecords, Record, Records, read_page

ADDRESS = "search/index.json"
"""Where pages look for it. It is made of the pages, so they cannot carry a hash of it."""
NAMES = tuple(each.name for each in fields(Record))
LIBRARY = ("minisearch.js", "stemmer.js")
RANKING = "js/search/ranking.js"
"""What index and page share, below ``static/``."""
PROGRAM = HERE / "index.mjs"


@dataclass(frozen=True, slots=True)
class Means:
    """What an index is made with."""

    scripts: tuple[Path, ...]
    stop_words: str


def indexing(library: SearchLibrary, static: Path, words: Words) -> Means:
    """For pages in the language of ``words``."""
    return Means(
        (*(library.scripts[name] for name in LIBRARY), static / RANKING),
        words("script.search.stop_words"),
    )


class Indexer:
    """Node, which can begin with the first pages while the last are still made. Within ``with``;
    what is begun and not needed then is ended."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._told: list[str] = []
        self._owner = os.getpid()
        self._left: list[str] = []
        self._waiting: dict[str, Sequence[Section]] = {}
        self._records = Records({})

    def begin(
        self, means: Means, explained: Mapping[str, Sequence[str]], paths: Iterable[str]
    ) -> None:
        """Of pages at these ``paths``, of which `hear` will be told; ``explained`` as `Records` has
        it."""
        self._process, self._told = _started(means), []
        self._records, self._left = Records(explained), [*paths][::-1]

    def hear(self, path: str, page: bytes) -> None:
        """A page was made: index it, once all before it have come. In a process beside this one it
        is only read, which is kept."""
        sections = read_page(page)
        if os.getpid() != self._owner or path not in self._left:
            return
        self._waiting[path] = sections
        while self._left and self._left[-1] in self._waiting:
            path = self._left.pop()
            self._tell(_told(self._records.of_page(path, self._waiting.pop(path))))

    def index(self, told: Sequence[str], means: Means) -> bytes:
        """The index as JSON, of the records of each page as JSON. Raises `RuntimeError` with Node's
        words where it cannot be made."""
        if self._process is None or self._told != told[: len(self._told)]:
            self.end()
            self._process, self._told = _started(means), []
        for line in told[len(self._told) :]:
            self._tell(line)
        process, self._process = self._process, None
        with process:
            _say_that_was_all(process)
            store_now()
            made, said = process.communicate()
        if process.returncode:
            raise RuntimeError(f"the search index could not be made: {said}")
        return made.encode()

    def end(self) -> None:
        """Let go of what was begun."""
        if self._process:
            with suppress(OSError), self._process as process:
                process.kill()
            self._process = None

    def _tell(self, line: str) -> None:
        self._told.append(line)
        if self._process and self._process.stdin:
            with suppress(OSError):  # it is gone, and has said why
                self._process.stdin.write(f"{line}\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.end()


def index_of(records: PageRecords, means: Means, indexer: Indexer) -> bytes:
    """The index, kept. Raises as `Indexer.index` does."""
    told = [_told(page) for page in records]
    scripts = [file_hash(file) for file in (*means.scripts, PROGRAM)]
    given = (bytes_hash("\n".join(told).encode()), scripts, means.stop_words)
    return kept_as("index", given, lambda: indexer.index(told, means))[0]


def _told(records: Sequence[Record]) -> str:
    return json.dumps([{name: getattr(record, name) for name in NAMES} for record in records])


def _started(means: Means) -> subprocess.Popen[str]:
    scripts = map(str, (PROGRAM, *means.scripts))
    command = [str(NODE), "--no-warnings", *scripts, means.stop_words]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, encoding="utf-8")


def _say_that_was_all(process: subprocess.Popen[str]) -> None:
    stream, process.stdin = process.stdin, None  # `communicate` would want it open
    if stream:
        with suppress(OSError):
            stream.close()
