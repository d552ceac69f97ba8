"""Mistakes of authors as data: each is reported at its place, and none ends in a traceback.

In ``fixtures/author_mistakes``, one or more lines ``=== LINE: GIST`` stand above what is written
in the first chapter below its front matter, and ``=== FILE:LINE: GIST`` above a whole file;
``+++ FILE`` begins another file of the same book, ``+++ text`` the text of the first chapter.
Beside the whole chapters in ``fixtures/mistakes`` lies all that is reported of each.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from support.little_book import FRONT, OUTLINE, diagnostics
from support.recorded import assert_recorded

from site_builder.build import Options
from site_builder.diagnostics import Diagnostic, unknown

FIXTURES = Path(__file__).parents[1] / "fixtures"
HEAD = re.compile(r"=== (?:(\S+):)?(\d+): (.*)")
CHAPTER = "content/00-first.md"


@dataclass(frozen=True, slots=True)
class Report:
    path: str
    line: int
    gist: str
    """How the message begins."""

    def matches(self, found: Diagnostic) -> bool:
        place = (found.path, found.line)
        return place == (self.path, self.line) and found.message.startswith(self.gist)


@dataclass(frozen=True, slots=True)
class Case:
    files: dict[str, str]
    reports: tuple[Report, ...]


def report(head: str) -> Report:
    """Lines are counted from the top of the file, those of the front matter among them."""
    found = HEAD.fullmatch(head)
    assert found, head
    path, line, gist = found.groups()
    return Report(path or CHAPTER, int(line) + (0 if path else FRONT.count("\n")), gist)


def read_case(heads: str, body: str) -> Case:
    reports = tuple(map(report, heads.splitlines()))
    written = "text" if re.match(r"=== \d", heads) else reports[0].path
    first, *others = re.split(r"^\+\+\+ (.+)\n", body, flags=re.MULTILINE)
    files = {written: first, **dict(zip(others[::2], others[1::2], strict=True))}
    if "text" in files:
        files[CHAPTER] = FRONT + files.pop("text")
    packages = {name.replace("scene.py", "__init__.py"): "" for name in files}
    return Case({"content/book.toml": OUTLINE, **packages, **files}, reports)


def read_cases(file: Path) -> Iterator[Case]:
    _, *parts = re.split(r"((?:^=== .*\n)+)", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return map(read_case, parts[::2], parts[1::2])


CASES = [
    pytest.param(case, id=f"{file.stem}-{number}")
    for file in sorted(FIXTURES.glob("author_mistakes/*.txt"))
    for number, case in enumerate(read_cases(file), start=1)
]


@pytest.mark.parametrize("case", CASES)
def test_each_mistake_is_reported_at_its_place_and_no_other(
    make_book: Callable[..., Options], case: Case
) -> None:
    found = diagnostics(make_book(files=case.files))
    missing = [report for report in case.reports if not any(map(report.matches, found))]
    assert not missing, [str(one) for one in found]
    assert len(found) == len(case.reports), [str(one) for one in found]


@pytest.mark.parametrize("file", sorted(FIXTURES.glob("mistakes/*.md")), ids=lambda file: file.stem)
def test_reports_of_a_whole_chapter_are_as_recorded(
    make_book: Callable[..., Options], file: Path
) -> None:
    found = diagnostics(make_book(files={CHAPTER: file.read_text(encoding="utf-8")}))
    assert_recorded("".join(f"{one}\n" for one in found), file.with_suffix(".txt"))


def test_of_many_legal_names_the_first_are_listed_and_the_rest_counted() -> None:
    names = [f"n{number}" for number in range(30)]
    expected = f"unknown name 'zzz'; legal: {', '.join(names[:20])} and 10 more"
    assert unknown("name", "zzz", names) == expected
