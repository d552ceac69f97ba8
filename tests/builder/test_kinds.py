"""Directives, roles, kinds of questions and of controls: each is one file or folder and one line of
its list."""

from collections import Counter

import pytest
from support.little_book import MakeBook

from site_builder.build import render_site
from site_builder.editions.notebooks.blocks import PARTS
from site_builder.files.engine import ENGINE
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.parser import OPENING
from site_builder.markdown.questions.kind import HERE, QuestionKind
from site_builder.markdown.questions.kinds import KINDS
from site_builder.markdown.role import USE
from site_builder.markdown.roles import ROLES
from site_builder.output.assets import content_bytes
from site_builder.pages.environment import TEMPLATES

SOURCES = {".py", ".html", ".ts", ".css", ".mjs"}


def test_every_directive_has_a_template_and_cells_in_notebooks() -> None:
    templates = {"prose"} | {directive.template for directive in DIRECTIVES}
    assert {file.stem for file in (TEMPLATES / "blocks").iterdir()} == templates
    assert set(PARTS) == templates


def test_names_are_given_once_and_can_be_written() -> None:
    directives = Counter(directive.name for directive in DIRECTIVES)
    roles = Counter(role.name for role in ROLES)
    kinds = Counter(name for kind in KINDS for name in {*kind.quiz, *kind.predict})
    assert max(*directives.values(), *roles.values(), *kinds.values()) == 1
    assert all(OPENING.fullmatch(f":::{{{name}}} words") for name in directives)
    assert all(USE.fullmatch(f"{{{name}}}`words`") for name in roles)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.folder)
def test_nothing_but_the_list_imports_a_kind_or_its_script(kind: QuestionKind) -> None:
    named = f"questions.{kind.folder}.kind", f"questions/{kind.folder}/kind"
    found = {
        file.relative_to(ENGINE).as_posix()
        for folder in ("site_builder", "static")
        for file in (ENGINE / folder).rglob("*")
        if file.suffix in SOURCES and (HERE / kind.folder) not in file.parents
        if any(name in file.read_text(encoding="utf-8") for name in named)
    }
    own_checks = {"site_builder/checks/questions.py"}
    assert found - own_checks == {"site_builder/markdown/questions/kinds.py"}


OWN_STATIC = ("css/book.css", "js/main.ts", "js/search/ranking.ts", "js/search/words.ts")
PLAIN = {
    "content/book.toml": 'title = "Plain"\nsubtitle = "Text."\nprerequisites = "None."\n'
    'chapters = ["00-first"]\n',
    "content/01-second.md": None,
    **{f"static/{name}": None for name in (*OWN_STATIC, "images/favicon.svg")},
}
"""A book without static files of its own."""
QUESTION = ":::{quiz} sum\nOne and one?\n- [x] Two\n  : Yes.\n- [ ] One\n  : No.\n:::\n"


def test_a_question_brings_its_own_kind_and_no_other(
    make_book: MakeBook, bundled: pytest.MonkeyPatch
) -> None:
    options = make_book(QUESTION, PLAIN)
    bundled.undo()
    files = {name: content_bytes(content) for name, content in render_site(options).items()}
    scripts = b"".join(text for name, text in files.items() if name.endswith(".js"))
    assert b"label.option" in scripts
    assert b".grip" not in scripts
    (sheet,) = (text for name, text in files.items() if name.endswith("/css/book.css"))
    assert b"\n.verdict" in sheet
