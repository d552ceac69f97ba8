"""Odd texts: text that looks like markup is shown as text, and damaged chapters are read in time,
with diagnostics.

``make test`` reads the same hundred damaged chapters each time, ``make test-deep`` thousands of new
ones.
"""

import re
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser
from support.little_book import OUTLINE, MakeBook, diagnostics, load_demo, rendered
from support.places import ROOT
from support.static_server import serving

from site_builder.build import Options
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.markdown.chapter import chapter_targets, find_targets, parse_chapter, read_chapter
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.parser import make_parser

SCRIPT = "<script>alert(1)</script>"
QUOTE = '"><img src=x onerror=alert(1)>'


MARKUP_AS_TEXT = (
    "&lt;script&gt;alert(1)&lt;/script&gt;",
    "`<script>alert(1)</script>`",
    "```text\n</code></pre><script>alert(1)</script>\n```",
    "$\\text{a word} \\lt x$",
    "[x](https://a.example/'onmouseover='alert(1)')",
    '[x](https://a.example/ "title\\" onmouseover=\\"alert(1)")',
    '<https://a.example/"onmouseover="alert(1)>',
    "{index}`&lt;img src=x onerror=alert(1)&gt;`",
    "{ray}`<script>alert(1)</script>`",
    ':::{figure} images/plan.svg\n:alt: "><script>alert(1)</script>\nWords.\n:::',
    ":::{quiz} calm\nWhich `</script><script>alert(1)</script>`?\n"
    "- [x] `</script><script>alert(1)</script>`\n  : `<!--<script>`\n- [ ] c\n  : d\n:::",
    ":::{simulation} demo\nA caption with `<script>alert(1)</script>`.\n:::",
)
"""Passages whose text looks like markup."""
FIELDS = {
    "content/book.toml": f'title = "T {SCRIPT}"\nsubtitle = "S {SCRIPT}"\nhero = "demo"\n'
    f'prerequisites = "P {SCRIPT}"\nhero_caption = "A caption."\n'
    'chapters = ["00-first", "01-second"]\n',
    "content/references.bib": f"@book{{key, author = {{{SCRIPT} and {QUOTE}}}, title = {{{QUOTE}}},"
    f"\n  year = {{2000}}, publisher = {{{SCRIPT}}}}}\n",
    "content/glossary.toml": f'["{SCRIPT}"]\nsays = "A word."\nexplained = "first"\n'
    f"words = ['Glossed']\nalso = ['{QUOTE}']\n",
}
"""Titles and other texts without markup, which are shown unchanged."""


@pytest.fixture
def full_of_markup(make_book: MakeBook) -> Options:
    """A valid book whose texts all look like markup."""
    body = "{cite}`key` and Glossed.\n\n" + "\n\n".join(MARKUP_AS_TEXT)
    return make_book(body + "\n", FIELDS)


@pytest.mark.browser
def test_text_that_looks_like_a_script_does_not_run(
    full_of_markup: Options, chromium: Browser, tmp_path: Path
) -> None:
    site = rendered(full_of_markup)
    for name, content in site.items():
        (tmp_path / "site" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "site" / name).write_bytes(content)
    alarms: list[str] = []
    # Without the content policy, which would stop any script.
    with serving(tmp_path / "site") as server, chromium.new_context(bypass_csp=True) as context:
        context.add_init_script("globalThis.alert = (text) => { globalThis.ran = text; };")
        page = context.new_page()
        page.on("dialog", lambda dialog: alarms.append(dialog.message))
        for name in (name for name in site if name.endswith(".html")):
            page.goto(server.url + name)
            page.mouse.move(200, 200)
            assert page.evaluate("globalThis.ran") is None, name
    assert alarms == []


def test_html_is_refused_unless_the_author_trusts_it(make_book: MakeBook) -> None:
    for trust, is_trusted in (("", False), ("raw_html = false", False), ("raw_html = true", True)):
        outline = f"{OUTLINE}[trust]\n{trust}\n"
        options = make_book("A <b>bold</b> word.\n", {"content/book.toml": outline})
        assert (diagnostics(options) == []) is is_trusted
    assert b"A <b>bold</b> word." in rendered(options)["first/index.html"]


LONGEST_S = 5.0
"""Limit of processor time for one chapter."""
MARKS = (
    *"*_`$[](){}<>|#-:~^\\!&'\"\n\t ",
    "$$", "**", "```", ":::", "::::", "\n\n", "---\n", "- [x] ", "  : ", "{ref}`", "`", "[^1]",
    "[^1]: ", ":::{note}\n", ":::{quiz} q\n", ":::{simulation} demo\n", ":::{figure} a.svg\n",
    ":k1: 0.1\n", "<!--", "-->", "<b>", "&amp;", "&#0;", "\u0000", "\u00a0", "\u202e", "\ufeff",
    "| a | b |\n|---|---|\n", "> ", "1. ", "\\frac{", "\\begin{matrix}", "}", "{set}`x <k1=1>`",
    "{cite}`a; b`", "{readout}`demo k1`", "{measured}`srgb table browser`", "{term}`x <y>`", "🙂",
)  # fmt: skip


def fragments() -> Iterator[str]:
    """Paragraphs and directives of the book's chapters, and lines of them."""
    for file in (ROOT / "content").glob("*.md"):
        text = file.read_text(encoding="utf-8")
        yield from re.split(r"\n{2,}", text)
        yield from (line for line in text.split("\n") if not line[:1].isalpha())


FRAGMENTS = sorted(set(fragments()))


@st.composite
def damaged_chapters(draw: st.DrawFn) -> str:
    """A few fragments with parts cut, repeated or indented, and marks inserted."""
    parts = draw(st.lists(st.sampled_from(FRAGMENTS), min_size=1, max_size=4))
    damaged = []
    for part in parts:
        for _ in range(draw(st.integers(0, 3))):
            place = draw(st.integers(0, len(part)))
            end = draw(st.integers(place, min(len(part), place + 40)))
            match draw(st.sampled_from(("cut", "double", "mark", "indent"))):
                case "cut":
                    part = part[:place] + part[end:]
                case "double":
                    part = part[:end] + part[place:end] * draw(st.integers(1, 3)) + part[end:]
                case "mark":
                    mark = draw(st.sampled_from(MARKS)) * draw(st.sampled_from((1, 1, 2, 60)))
                    part = part[:place] + mark + part[place:]
                case "indent":
                    spaces = " " * draw(st.integers(1, 6))
                    part = "\n".join(spaces + row for row in part.split("\n"))
        damaged.append(part)
    return draw(st.sampled_from(("\n\n", "\n", ""))).join(damaged)


def assert_read_in_time(text: str) -> None:
    """Read a chapter like the build does; each diagnostic has one of its lines."""
    before = time.process_time()
    problems = Diagnostics()
    shared = Shared(root=ROOT, load_scene=load_demo, parser=make_parser())
    reading = ParseContext(
        path="content/00-first.md", shared=shared, problems=problems, chapter="first"
    )
    parsed = parse_chapter(text, reading)
    read_chapter(parsed, find_targets([chapter_targets(parsed)], problems))
    assert time.process_time() - before < LONGEST_S
    lines = text.count("\n") + 1
    for found in (*problems.found, *problems.doubts):
        assert 1 <= found.line <= lines + 1
        assert found.message
        str(found).encode()


QUIET = settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large]
)


@settings(QUIET, max_examples=100)
@given(damaged_chapters())
def test_damaged_chapters_are_read_in_time(text: str) -> None:
    assert_read_in_time(text)


@pytest.mark.deep
@settings(QUIET, max_examples=3000, derandomize=False)
@given(damaged_chapters())
def test_thousands_of_damaged_chapters_are_read_in_time(text: str) -> None:
    assert_read_in_time(text)


@pytest.mark.parametrize(
    "text",
    [
        *("*" * 5_000, "[" * 5_000, "<" * 5_000, "&" * 5_000, "a_" * 5_000, "a" * 200_000),
        *("> " * 2_000 + "a", "- " * 1_000 + "a", "---\n" * 2_000, "a\\\n" * 3_000),
        *("`" * 5_000 + " ` " * 2_000, "$" * 5_001, "{ref}`" * 2_000, "[a](" * 2_000),
        *(
            "![" * 2_000,
            "[@" * 3_000,
            "{#a " * 3_000,
            "\\(" * 3_000,
            "\\[" * 3_000,
            "~~" * 3_000 + "==" * 3_000,
        ),
        "| a " * 1_000 + "\n" + "|---" * 1_000 + "\n" + "| b " * 1_000,
        ":::{note}\n" * 300 + "a\n" + ":::\n" * 300,
        "$" + "{" * 400 + "x" + "}" * 400 + "$",
        "$" + "\\frac{1}{" * 200 + "x" + "}" * 200 + "$",
        "[^a]" * 1_000 + "\n\n[^a]: x",
    ],
    ids=lambda text: text[:12],
)
def test_long_repetitions_are_read_in_time(text: str) -> None:
    assert_read_in_time(f"---\ntitle: T\nsummary: s\n---\n\n{text}\n")
