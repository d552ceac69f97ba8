"""Markdown and what becomes of it: each case in a file of this folder is a test.

A case begins with ``======== what it shows``. Its text is the first chapter of a little book.
``++++++++ FILE`` begins another file of that book, and ``++++++++ end of FILE`` more lines of its
outline. A chapter without front matter of its own has that of the book, unless it is the ``whole``
of a file. A line ``^^^ MESSAGE`` stands below the line of which that
is reported, and is the beginning of the message, behind ``warning:`` where it fails nothing; any
other report fails the test.

Behind ``--------`` follows what comes out: the outline of the chapter, and after ``-------- PART``
that of another page, or the chapter on ``paper``, as a ``notebook`` or in the ``search``.

A mismatch writes the case as it is now beside its file, as ``…-changed.md``.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest
from support.little_book import FRONT, OUTLINE, diagnostics, part_of

from site_builder.build import Options

HERE = Path(__file__).parent
CHAPTER = "content/00-first.md"
OTHER = "---\ntitle: Second\nsummary: The second chapter.\n---\n"
LISTED = re.compile(r"content/\d\d-\S+\.md")
MARK = re.compile(r"^(={8} .+|\+{8} .+|-{8}(?: .+)?)\n", re.MULTILINE)
REPORT = "^^^ "


@dataclass(frozen=True, slots=True)
class Case:
    """One book, what is reported of it, and what comes out."""

    source: str
    """The case as it is written."""
    files: Mapping[str, str]
    """Files of the book by path, reports among their lines."""
    parts: Mapping[str, str]
    """Outlines by the part that is named."""


def read_cases(file: Path) -> Iterator[tuple[str, Case]]:
    """Titles and cases."""
    _, *parts = re.split(r"^={8} (.+)\n", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    for title, source in zip(parts[::2], parts[1::2], strict=True):
        text, *marked = MARK.split(source)
        pairs = list(zip(marked[::2], marked[1::2], strict=True))
        files = {head[9:]: body for head, body in pairs if head.startswith("+")}
        outlines = {head[9:]: body for head, body in pairs if head.startswith("-")}
        yield title, Case(source, {CHAPTER: text, **files} if text else files, outlines)


def is_report(line: str) -> bool:
    return line.startswith(REPORT)


def written(name: str, text: str) -> tuple[str, int]:
    """A file as the book has it, and how many lines stand before what the case says of it."""
    own = "".join(line for line in text.splitlines(keepends=True) if not is_report(line))
    before = OUTLINE if name.startswith("end of ") else ""
    if LISTED.fullmatch(name) and not own.startswith("---\n"):
        before = FRONT if name == CHAPTER else OTHER
    return before + own, before.count("\n")


def path_of(name: str) -> str:
    return name.removeprefix("end of ").removeprefix("whole ")


def with_reports(text: str, before: int, found: Mapping[int, list[str]]) -> str:
    """The text with what is reported of each line below it, abridged where the case abridges it."""
    lines = text.splitlines(keepends=True)
    expected = [line.removeprefix(REPORT).rstrip("\n") for line in lines if is_report(line)]

    def shown(message: str) -> str:
        head = message if "; did you mean" in message else message.partition("; ")[0]
        return max(filter(message.startswith, expected), key=len, default=head)

    own = ["" for _ in range(before)] + [line for line in lines if not is_report(line)]
    for number in sorted(found):
        messages = sorted(f"{REPORT}{shown(message)}\n" for message in found[number])
        own[min(number, len(own)) - 1] += "".join(messages)
    return "".join(own)


def as_it_is_now(case: Case, make_book: Callable[..., Options]) -> str:
    """The case, with what is reported and what comes out in place of what was expected."""
    texts = {name: written(name, text) for name, text in case.files.items()}
    files = {path_of(name): text for name, (text, _) in texts.items()}
    packages = {name.replace("scene.py", "__init__.py"): "" for name in files}
    options = make_book(files={"content/book.toml": OUTLINE, **packages, **files})
    reports: dict[str, dict[int, list[str]]] = {}
    for one in diagnostics(options):
        message = one.message if one.fails else f"warning: {one.message}"
        reports.setdefault(one.path, {}).setdefault(one.line, []).append(message)
    now: list[str] = []
    for name, text in case.files.items():
        found = reports.pop(path_of(name), {})
        head = f"++++++++ {name}\n" if now or name != CHAPTER else ""
        now.append(head + with_reports(text, texts[name][1], found))
    assert not reports, "reported of files that the case does not show"
    for part in case.parts:
        now.append(f"--------{f' {part}' if part else ''}\n{part_of(options, part)}")
    return "".join(now)


@pytest.mark.parametrize(
    ("file", "title", "case"),
    [
        pytest.param(file, title, case, id=f"{file.stem}: {title}")
        for file in sorted(HERE.glob("*.md"))
        if not file.stem.endswith("-changed")
        for title, case in read_cases(file)
    ],
)
def test_a_case_comes_out_as_it_is_written(
    file: Path, title: str, case: Case, make_book: Callable[..., Options]
) -> None:
    now = as_it_is_now(case, make_book)
    changed = file.with_name(f"{file.stem} {title}-changed.md")
    changed.unlink(missing_ok=True)
    if now != case.source:
        changed.write_text(f"======== {title}\n{now}", encoding="utf-8")
    assert now == case.source
