"""Readers get the scripts and style sheets that their book shows something for, and no others."""

from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder import browser_parts
from site_builder.build import Options, render_site
from site_builder.files import folder_files
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.directives.quiz import KINDS as QUESTION_KINDS
from site_builder.output.assets import content_bytes
from site_builder.output.style_sheets import IMPORT
from site_builder.pages.features import KINDS, PARTS, SHEETS

type MakeBook = Callable[..., Options]

STATIC = Path(__file__).parents[3] / "static"
OWN_STATIC = ("css/book.css", "js/main.js", "js/search/ranking.js", "images/favicon.svg")
PLAIN = {
    "content/book.toml": 'title = "Plain"\nsubtitle = "Text."\nprerequisites = "None."\n'
    'chapters = ["00-first"]\n',
    "content/01-second.md": None,
    **{f"static/{name}": None for name in OWN_STATIC},
}
QUESTION = ":::{quiz} sum\nOne and one?\n- [x] Two\n  : Yes.\n- [ ] One\n  : No.\n:::\n"


@pytest.fixture(autouse=True)
def one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scripts are not joined, so that it can be seen which there are."""
    monkeypatch.setattr(browser_parts, "join_scripts", lambda files, _entry: files)


def shipped(options: Options) -> dict[str, str]:
    """Scripts and the style sheet, by their path among the assets."""
    files = render_site(options)
    return {
        name.split("/", 2)[2]: content_bytes(content).decode()
        for name, content in files.items()
        if name.startswith("assets/") and name.endswith((".js", ".css"))
    }


def test_a_book_of_plain_text_ships_what_turns_its_pages(make_book: MakeBook) -> None:
    files = shipped(make_book("Text.\n", PLAIN))
    rooms = {name.split("/")[1] for name in files if name.count("/") > 1}
    assert rooms == {"page", "offline", "search"}
    assert not {"js/page/tabs.js", "js/page/terms.js", "css/workshop.css"} & set(files)
    css = files["css/book.css"]
    assert [rule for rule in (".verdict", ".ladder-key", ".handle ") if f"\n{rule}" in css] == []


def test_a_question_brings_its_own_kind_and_no_other(make_book: MakeBook) -> None:
    files = shipped(make_book(QUESTION, PLAIN))
    kinds = {"choice", "number", "order", "figure"}
    assert {kind for kind in kinds if f"js/question/{kind}.js" in files} == {"choice"}
    assert not any(name.startswith(("js/figure/", "js/runtime/")) for name in files)
    assert "\n.verdict" in files["css/book.css"]


def test_what_a_script_imports_is_shipped_with_it(make_book: MakeBook) -> None:
    whole = make_book(QUESTION + "\n:::{simulation} demo\n:::\n", PLAIN)
    files = shipped(whole)
    scripts = {name for name in folder_files(STATIC) if name.startswith("js/")}
    for room in ("figure", "runtime", "editor"):
        assert {name for name in scripts if name.startswith(f"js/{room}/")} <= set(files)


def test_the_table_names_what_there_is() -> None:
    blocks = {directive.template for directive in DIRECTIVES} | {"prose"}
    told = {"terms", "asked", "progress", "lecture-plan", "glossary", "index-of-terms"}
    uses = {use for uses in SHEETS.values() for use in uses} | set(PARTS)
    assert uses <= blocks | told
    assert set(KINDS) == set(QUESTION_KINDS)
    sheets = IMPORT.findall((STATIC / "css" / "book.css").read_text(encoding="utf-8"))
    assert set(SHEETS) <= set(sheets)
