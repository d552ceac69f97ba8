"""Markdown as no author would write it: pieces of the book's own chapters, cut, repeated, joined
and sprinkled with marks. Whatever it is, reading it ends, and ends in diagnostics.

``make test`` tries a hundred, always the same; ``make test-deep`` thousands of new ones.
"""

import re
import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.little_book import load_demo

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.book import Chapter
from site_builder.markdown.chapter import find_targets, parse_chapter, read_chapter, survey
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser

ROOT = Path(__file__).resolve().parents[2]
LONGEST_S = 5.0
"""Of the processor's time, for one chapter."""
MARKS = (
    *"*_`$[](){}<>|#-:~^\\!&'\"\n\t ",
    "$$", "**", "```", ":::", "::::", "\n\n", "---\n", "- [x] ", "  : ", "{ref}`", "`", "[^1]",
    "[^1]: ", ":::{note}\n", ":::{quiz} q\n", ":::{simulation} demo\n", ":::{figure} a.svg\n",
    ":k1: 0.1\n", "<!--", "-->", "<b>", "&amp;", "&#0;", "\u0000", "\u00a0", "\u202e", "\ufeff",
    "| a | b |\n|---|---|\n", "> ", "1. ", "\\frac{", "\\begin{matrix}", "}", "{set}`x <k1=1>`",
    "{cite}`a; b`", "{readout}`demo k1`", "{measured}`srgb table browser`", "{term}`x <y>`", "🙂",
)  # fmt: skip


def fragments() -> list[str]:
    """Paragraphs and directives of the chapters, and lines of them."""
    found: set[str] = set()
    for file in sorted((ROOT / "content").glob("*.md")):
        text = file.read_text(encoding="utf-8")
        found |= set(re.split(r"\n{2,}", text))
        found |= {line for line in text.split("\n") if not line[:1].isalpha()}
    return sorted(found)


FRAGMENTS = fragments()


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """A few fragments, each cut or doubled somewhere or with a mark let in."""
    parts = draw(st.lists(st.sampled_from(FRAGMENTS), min_size=1, max_size=4))
    told = []
    for part in parts:
        for _ in range(draw(st.integers(0, 3))):
            place = draw(st.integers(0, len(part)))
            end = draw(st.integers(place, min(len(part), place + 40)))
            match draw(st.sampled_from(("cut", "double", "mark", "many", "indent"))):
                case "cut":
                    part = part[:place] + part[end:]
                case "double":
                    part = part[:end] + part[place:end] * draw(st.integers(1, 3)) + part[end:]
                case "mark":
                    part = part[:place] + draw(st.sampled_from(MARKS)) + part[place:]
                case "many":
                    mark = draw(st.sampled_from(MARKS))
                    part = part[:place] + mark * draw(st.integers(2, 60)) + part[place:]
                case "indent":
                    part = "\n".join(
                        " " * draw(st.integers(1, 6)) + row for row in part.split("\n")
                    )
        told.append(part)
    return draw(st.sampled_from(("\n\n", "\n", ""))).join(told)


def read(text: str) -> tuple[Chapter, Diagnostics]:
    """As the build reads a chapter."""
    problems = Diagnostics()
    shared = Shared(ROOT, load_demo, make_parser())
    reading = ParseContext("content/00-first.md", shared, problems, chapter="first")
    draft = parse_chapter(text, reading)
    return read_chapter(draft, find_targets([survey(draft)], problems)), problems


def holds(text: str) -> None:
    before = time.process_time()
    _, problems = read(text)
    assert time.process_time() - before < LONGEST_S
    lines = text.count("\n") + 1
    for found in (*problems.found, *problems.doubts):
        assert 1 <= found.line <= lines + 1
        assert found.message
        str(found).encode()


QUIET = settings(
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


@settings(QUIET, max_examples=100)
@given(mutated())
def test_no_chapter_however_maimed_stops_the_reading(text: str) -> None:
    holds(text)


@pytest.mark.deep
@settings(QUIET, max_examples=3000, derandomize=False)
@given(mutated())
def test_none_of_thousands_of_maimed_chapters_stops_the_reading(text: str) -> None:
    holds(text)


@pytest.mark.parametrize(
    "text",
    [
        "*" * 5_000,
        "[" * 5_000,
        "> " * 2_000 + "a",
        "- " * 1_000 + "a",
        "`" * 5_000 + " ` " * 2_000,
        "$" * 5_001,
        "{ref}`" * 2_000,
        "[a](" * 2_000,
        "![" * 2_000,
        "<" * 5_000,
        "&" * 5_000,
        "| a " * 1_000 + "\n" + "|---" * 1_000 + "\n" + "| b " * 1_000,
        ":::{note}\n" * 300 + "a\n" + ":::\n" * 300,
        "$" + "{" * 400 + "x" + "}" * 400 + "$",
        "$" + "\\frac{1}{" * 200 + "x" + "}" * 200 + "$",
        "[^a]" * 1_000 + "\n\n[^a]: x",
        "a" * 200_000,
        "a_" * 5_000,
        "---\n" * 2_000,
        "~~" * 3_000 + "==" * 3_000 + "^a" * 3_000,
        "[@" * 3_000,
        "{#a " * 3_000,
        "a\\\n" * 3_000,
        "\\(" * 3_000,
    ],
    ids=lambda text: text[:12],
)
def test_what_grows_without_end_is_read_in_time(text: str) -> None:
    holds(f"---\ntitle: T\nsummary: s\n---\n\n{text}\n")
