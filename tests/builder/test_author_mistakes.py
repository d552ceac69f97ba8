"""Slips of authors, a few lines each: none is silent, none ends in a
traceback, each is told at its place.

In ``fixtures/author_mistakes``, ``=== LINE: GIST`` stands above what is written in the first
chapter below its front matter, and ``=== FILE:LINE: GIST`` above a whole file.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

from site_builder.build import Options, check_site
from site_builder.diagnostics import BuildError, Diagnostic

FIXTURES = Path(__file__).parents[1] / "fixtures" / "author_mistakes"
HEAD = re.compile(r"^=== (?:(\S+):)?(\d+): (.*)\n", re.MULTILINE)
CHAPTER = "content/00-first.md"
FRONT = "---\ntitle: First\nsummary: The first chapter.\n---\n"


@dataclass(frozen=True, slots=True)
class Slip:
    """One mistake."""

    files: dict[str, str]
    path: str
    line: int
    gist: str
    """How the message begins."""


def read_slips(file: Path) -> list[Slip]:
    _, *parts = HEAD.split(file.read_text(encoding="utf-8"))
    found = []
    for path, line, gist, body in zip(*(parts[n::4] for n in range(4)), strict=True):
        files = {path: body} if path else {CHAPTER: FRONT + body}
        if path and path.endswith("/scene.py"):
            files[path.replace("scene.py", "__init__.py")] = ""
        below = 0 if path else FRONT.count("\n")
        found.append(Slip(files, path or CHAPTER, int(line) + below, gist))
    return found


SLIPS = [
    pytest.param(slip, id=f"{file.stem}-{number}")
    for file in sorted(FIXTURES.glob("*.txt"))
    for number, slip in enumerate(read_slips(file), start=1)
]


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_told_at_its_place(make_book: Callable[..., Options], slip: Slip) -> None:
    outline = 'title = "T"\nsubtitle = "S"\nprerequisites = "P"\n'
    outline += 'chapters = ["00-first", "01-second"]\n'
    options = make_book(files={"content/book.toml": outline, **slip.files})
    found: list[Diagnostic] = []
    try:
        check_site(replace(options, warn=found.append))
    except BuildError as error:
        found += error.diagnostics
    assert any(
        (one.path, one.line) == (slip.path, slip.line) and one.message.startswith(slip.gist)
        for one in found
    ), [str(one) for one in found]


@pytest.mark.parametrize("broken", ["x = (\n", "x = '\udce9'\n"])
def test_a_module_that_is_no_python_is_told_where_it_is_quoted(
    make_book: Callable[..., Options], broken: str
) -> None:
    options = make_book(":::{source} simulations.models.thing:double\n:::\n")
    file = options.root / "simulations/models/thing.py"
    file.write_bytes(broken.encode("utf-8", errors="surrogateescape"))
    with pytest.raises(BuildError, match=r"content/00-first\.md:5: "):
        check_site(options)


def test_a_condition_that_cannot_be_worked_out_is_told_once(
    make_book: Callable[..., Options],
) -> None:
    body = (
        ":::{predict} p\nWhich?\n- [?] `1 / 0 > 1` one\n  : a\n"
        "- [?] `1 / 0 < 1` other\n  : b\n:::\n\n:::{answer} p\nText.\n:::\n"
    )
    with pytest.raises(BuildError) as raised:
        check_site(make_book(body))
    assert [found.line for found in raised.value.diagnostics] == [7, 9]
