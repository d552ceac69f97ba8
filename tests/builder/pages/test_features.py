"""Readers get the scripts and style sheets that their book shows something for, and no others."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from site_builder.build import Options, render_site
from site_builder.markdown.directives import DIRECTIVES
from site_builder.output.assets import content_bytes
from site_builder.output.style_sheets import IMPORT
from site_builder.pages.features import PARTS, SHEETS

type MakeBook = Callable[..., Options]

STATIC = Path(__file__).parents[3] / "static"
OWN_STATIC = (
    "css/book.css",
    "js/main.ts",
    "js/search/ranking.ts",
    "js/search/words.ts",
    "images/favicon.svg",
)
PLAIN = {
    "content/book.toml": 'title = "Plain"\nsubtitle = "Text."\nprerequisites = "None."\n'
    'chapters = ["00-first"]\n',
    "content/01-second.md": None,
    **{f"static/{name}": None for name in OWN_STATIC},
}
QUESTION = ":::{quiz} sum\nOne and one?\n- [x] Two\n  : Yes.\n- [ ] One\n  : No.\n:::\n"


@pytest.fixture(autouse=True)
def bundled() -> None:
    """In place of the fixture of other tests: scripts are bundled as for readers."""


def shipped(options: Options) -> dict[str, str]:
    """Scripts and the style sheet, by their path among the assets."""
    files = render_site(options)
    return {
        name.split("/", 2)[2]: content_bytes(content).decode()
        for name, content in files.items()
        if name.startswith("assets/") and name.endswith((".js", ".css"))
    }


def holds(files: Mapping[str, str], text: str) -> bool:
    return any(text in script for name, script in files.items() if name.endswith(".js"))


def test_a_book_of_plain_text_ships_what_turns_its_pages(make_book: MakeBook) -> None:
    files = shipped(make_book("Text.\n", PLAIN))
    assert holds(files, "installNavigation")
    assert not any(holds(files, name) for name in ("LiveFigure", "form.quiz"))
    css = files["css/book.css"]
    assert [rule for rule in (".verdict", ".ladder-key", ".handle ") if f"\n{rule}" in css] == []


def test_a_question_brings_its_own_kind_and_no_other(make_book: MakeBook) -> None:
    files = shipped(make_book(QUESTION, PLAIN))
    assert holds(files, "label.option")
    assert not any(holds(files, name) for name in (".grip", "LiveFigure"))
    assert "\n.verdict" in files["css/book.css"]


def test_what_a_script_starts_or_loads_is_shipped_with_it(make_book: MakeBook) -> None:
    files = shipped(make_book(QUESTION + "\n:::{simulation} demo\n:::\n", PLAIN))
    assert holds(files, "LiveFigure")
    assert {"js/runtime/worker.js", "css/workshop.css"} <= set(files)


def test_the_table_names_what_there_is() -> None:
    blocks = {directive.template for directive in DIRECTIVES} | {"prose"}
    told = {"terms", "asked", "progress", "lecture-plan", "glossary", "index-of-terms"}
    uses = {use for uses in SHEETS.values() for use in uses} | set(PARTS)
    assert uses <= blocks | told
    sheets = IMPORT.findall((STATIC / "css" / "book.css").read_text(encoding="utf-8"))
    assert set(SHEETS) <= set(sheets)
