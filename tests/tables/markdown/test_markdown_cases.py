"""Markdown and its output: each case in a file of this folder is a test.

A case begins with ``======== TITLE``. Its text is the first chapter of a little book.
``++++++++ FILE`` begins another file of that book, and ``++++++++ end of FILE`` lines that are
appended to its outline. A chapter without front matter gets a default one, unless the file name
has ``whole`` before it. A line ``^^^ MESSAGE`` below a line is the beginning of a message about
that line, with ``warning:`` before it if the build does not fail. A row ``TEXT ^^^ MESSAGE`` is a
paragraph with the message about it. Any other message fails the test.

The output follows after ``--------``: the outline of the chapter; and after ``-------- PART`` the
outline of another page, or the chapter in print (``paper``), as a ``notebook`` or in the
``search``.

``-------- changes of FILE`` begins a list of mistakes, ``OLD => NEW ^^^ MESSAGE``. Each replaces
the first OLD of the file by NEW; ¶ is a line break, and … in NEW is OLD. The messages are those
added by the mistake: about the line where OLD begins, as ``+2 MESSAGE`` about another line, or as
``PATH:2 MESSAGE`` about another file.

After a mismatch the present result is beside its file, as ``…-changed.md``.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from support.little_book import FRONT, OUTLINE, diagnostics, part_of

from site_builder.build import Options
from site_builder.diagnostics.diagnostic import Diagnostic

HERE = Path(__file__).parent
CHAPTER = "content/00-first.md"
OTHER = "---\ntitle: Second\nsummary: The second chapter.\n---\n"
LISTED = re.compile(r"content/\d\d-\S+\.md")
MARK = re.compile(r"^(={8} .+|\+{8} .+|-{8}(?: .+)?)\n", re.MULTILINE)
CHANGES = "changes of "
REPORT = "^^^ "


@dataclass(frozen=True, slots=True)
class Case:
    """One book, its messages and its output."""

    source: str
    """The text of the case."""
    files: Mapping[str, str]
    """Files of the book by path, with messages among their lines."""
    parts: Mapping[str, str]
    """Outlines by part."""


@dataclass(slots=True)
class Line:
    """A line of a file, and the messages about it."""

    text: str
    messages: list[str] = field(default_factory=list)
    is_row: bool = False


def read_cases(file: Path) -> Iterator[tuple[str, Case]]:
    """The cases of a file with their titles."""
    _, *parts = re.split(r"^={8} (.+)\n", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    for title, source in zip(parts[::2], parts[1::2], strict=True):
        text, *marked = MARK.split(source)
        pairs = list(zip(marked[::2], marked[1::2], strict=True))
        files = {head[9:]: body for head, body in pairs if head.startswith("+")}
        outlines = {head[9:]: body for head, body in pairs if head.startswith("-")}
        yield title, Case(source, {CHAPTER: text, **files} if text else files, outlines)


def read_lines(text: str) -> list[Line]:
    """The lines of a file; the first one has the messages about the file as a whole."""
    lines = [Line("")]
    for line in text.splitlines():
        if line.startswith(REPORT):
            lines[-1].messages.append(line.removeprefix(REPORT))
        else:
            own, *messages = line.split(f" {REPORT}")
            lines.append(Line(own, messages, bool(messages)))
    return lines


def file_of(name: str, text: str) -> tuple[str, int]:
    """The content of a file of the book, and the number of lines added before the case's."""
    own = "".join(f"{line.text}\n" + "\n" * line.is_row for line in read_lines(text)[1:])
    before = OUTLINE if name.startswith("end of ") else ""
    if LISTED.fullmatch(name) and not own.startswith("---\n"):
        before = FRONT if name == CHAPTER else OTHER
    return before + own, before.count("\n")


def path_of(name: str) -> str:
    return name.removeprefix("end of ").removeprefix("whole ")


def cut_to(message: str, expected: list[str]) -> str:
    """The message, cut where an expected one ends, or else at its first semicolon."""
    head = message if "; did you mean" in message else message.partition("; ")[0]
    return max(filter(message.startswith, expected), key=len, default=head)


def text_of(one: Diagnostic) -> str:
    return one.message if one.fails else f"warning: {one.message}"


def with_reports(text: str, before: int, found: list[Diagnostic]) -> str:
    """The text with the messages below each line."""
    lines = read_lines(text)
    places = [line for line in lines for _ in range(1 + line.is_row)]
    now: dict[int, list[str]] = {}
    for one in found:
        line = places[min(max(one.line - before, 0), len(places) - 1)]
        now.setdefault(id(line), []).append(cut_to(text_of(one), line.messages))
    marked = ""
    for place, line in enumerate(lines):
        messages = sorted(now.get(id(line), ()))
        if line.is_row:
            marked += " ^^^ ".join([line.text, *messages]) + "\n"
        else:
            marked += f"{line.text}\n" * (place > 0) + "".join(f"^^^ {each}\n" for each in messages)
    return marked


def with_changes(
    rows: str, path: str, files: Mapping[str, str], make_book: Callable[..., Options]
) -> str:
    """The changes of a file, each with the messages that it adds."""
    options = make_book(files=files)
    sound = Counter((one.path, one.message) for one in diagnostics(options))
    text, now = (options.root / path).read_text(encoding="utf-8"), ""
    for row in rows.splitlines():
        change, *expected = row.split(f" {REPORT}")
        old, new = (part.replace("¶", "\n") for part in change.split(" => "))
        before, found, behind = text.partition(old)
        assert found, f"not in {path}: {old}"
        first = before.count("\n") + 1
        known, messages = sound.copy(), []
        changed = before + new.replace("…", old) + behind
        for one in diagnostics(make_book(files={**files, path: changed})):
            if known[one.path, one.message]:
                known[one.path, one.message] -= 1
                continue
            place = f"{one.line - first:+d} " if one.line != first else ""
            place = place if one.path == path else f"{one.path}:{one.line} "
            ends = [each.removeprefix(place) for each in expected]
            messages.append(place + cut_to(text_of(one), ends))
        now += " ^^^ ".join([change, *sorted(messages)]) + "\n"
    return now


def with_present_output(case: Case, make_book: Callable[..., Options]) -> str:
    """The case with the present messages and output in place of the expected ones."""
    texts = {name: file_of(name, text) for name, text in case.files.items()}
    packages = {path_of(name).replace("scene.py", "__init__.py"): "" for name in texts}
    files = {"content/book.toml": OUTLINE, **packages}
    files |= {path_of(name): text for name, (text, _) in texts.items()}
    options = make_book(files=files)
    found = diagnostics(options)
    now: list[str] = []
    for name, text in case.files.items():
        own = [one for one in found if one.path == path_of(name)]
        found = [one for one in found if one.path != path_of(name)]
        head = f"++++++++ {name}\n" if now or name != CHAPTER else ""
        now.append(head + with_reports(text, texts[name][1], own))
    assert found == [], "messages about files that are not in the case"
    for part, text in case.parts.items():
        if part.startswith(CHANGES):
            path = part.removeprefix(CHANGES)
            shown = with_changes(text, path, files, make_book)
        else:
            shown = part_of(options, part)
        now.append(f"--------{f' {part}' if part else ''}\n{shown}")
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
def test_case_has_the_expected_messages_and_output(
    file: Path, title: str, case: Case, make_book: Callable[..., Options]
) -> None:
    now = with_present_output(case, make_book)
    changed = file.with_name(f"{file.stem} {title}-changed.md")
    changed.unlink(missing_ok=True)
    if now != case.source:
        changed.write_text(f"======== {title}\n{now}", encoding="utf-8")
    assert now == case.source
