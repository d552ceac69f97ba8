"""``{include} file.md``: the lines of another file of ``content/`` in the place of the directive.

It is done to the text, before anything is parsed, so that headings, numbers and references of the
included file are the chapter's own. Each line remembers where it stands, for the reports.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from site_builder.diagnostics import Diagnostics
from site_builder.markdown.files.content_files import fault_of_file
from site_builder.source_text import read_text

INCLUDE = re.compile(r"(:{3,})\{include\}[ \t]*(.*)")
CODE_FENCE = re.compile(r" {0,3}(`{3,}|~{3,})")
ALONE = "nothing but ':::' below it"


@dataclass(frozen=True, slots=True)
class Line:
    """One line of a chapter."""

    text: str
    path: str
    """The file that it stands in, relative to the root of the project."""
    number: int


def may_include(text: str) -> bool:
    """Whether a chapter is more than its own file; most are not, and are parsed as they stand."""
    return "{include}" in text


def splice(text: str, path: str, root: Path, problems: Diagnostics) -> list[Line]:
    """The lines of a chapter with those of the files that it includes, and of theirs in turn."""
    return list(_lines(text, (path,), root, problems))


def _lines(text: str, files: Sequence[str], root: Path, problems: Diagnostics) -> Iterator[Line]:
    """``files`` leads from the chapter to the file that ``text`` is of."""
    path, fence, closing = files[-1], "", 0
    lines = text.split("\n")
    for number, line in enumerate(lines, start=1):
        if number == closing:
            yield Line("", path, number)
            continue
        marker = CODE_FENCE.match(line)
        if marker and not fence:
            fence = marker[1]
        elif marker and marker[1].startswith(fence) and not line.strip().strip(fence[0]):
            fence = ""
        include = None if fence else INCLUDE.fullmatch(line.rstrip())
        if include is None:
            yield Line(line, path, number)
            continue
        closing = _closing(lines, number, include[1])
        if not closing:
            problems.add(path, number, f"{{include}} with a body or never closed; legal: {ALONE}")
            closing = number
        # Its own lines stay, empty, so that what it brings is set off from the text around it.
        yield Line("", path, number)
        yield from _included(include[2].strip(), number, files, root, problems)


def _closing(lines: Sequence[str], number: int, fence: str) -> int:
    """The number of the line that closes the directive on line ``number``; 0 where none does."""
    for later, line in enumerate(lines[number:], start=number + 1):
        if line.strip():
            return later if line.strip() == fence else 0
    return 0


def _included(
    name: str, number: int, files: Sequence[str], root: Path, problems: Diagnostics
) -> Iterator[Line]:
    fault = fault_of_file(name, root / "content", "Markdown file", (".md",))
    path = f"content/{name}"
    if not name:
        fault = "{include} names no file; legal: ':::{include} parts/file.md'"
    elif not fault and path in files:
        way = " → ".join(file.removeprefix("content/") for file in (*files, path))
        fault = (
            f"{{include}} goes round in a circle: {way}; legal: a file that does not include this"
        )
    if fault:
        problems.add(files[-1], number, fault)
        return
    text = read_text(root, path, problems)
    if text.startswith("---\n"):
        problems.add(path, 1, "front matter in an included file; legal: the chapter's alone")
    yield from _lines(text.removesuffix("\n"), (*files, path), root, problems)
