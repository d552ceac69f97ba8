"""Directives, roles and kinds of questions: each is declared once, has an example in the guide, and
is shipped where it is used; and the guide builds."""

import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from support.engine import Engine
from support.html_outline import read_html
from support.little_book import MakeBook

from site_builder.build import render_site
from site_builder.editions.notebooks.directive_cells import PARTS
from site_builder.files.engine import ENGINE, STATIC
from site_builder.guide.generator import NoExampleError, directive_page, guide_files, read_classes
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.directives.questions import QUIZ
from site_builder.markdown.parser import OPENING
from site_builder.markdown.questions.kind import HERE, QuestionKind
from site_builder.markdown.questions.kinds import KINDS
from site_builder.markdown.role import USE
from site_builder.markdown.roles import ROLES
from site_builder.output.writer import content_bytes
from site_builder.pages.environment import TEMPLATES

SOURCES = {".py", ".html", ".ts", ".css", ".mjs"}


def test_every_directive_has_a_template_and_cells_in_notebooks() -> None:
    templates = {"prose", "deeper"} | {directive.template for directive in DIRECTIVES}
    assert {file.stem for file in (TEMPLATES / "blocks").iterdir()} == templates
    assert set(PARTS) == templates


def test_names_are_unique_and_can_be_written() -> None:
    directives = Counter(directive.name for directive in DIRECTIVES)
    roles = Counter(role.name for role in ROLES)
    kinds = Counter(name for kind in KINDS for name in {*kind.quiz, *kind.predict})
    assert max(*directives.values(), *roles.values(), *kinds.values()) == 1
    assert all(OPENING.fullmatch(f":::{{{name}}} words") for name in directives)
    assert all(USE.fullmatch(f"{{{name}}}`words`") for name in roles)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.folder)
def test_only_the_list_of_kinds_imports_a_kind_or_its_script(kind: QuestionKind) -> None:
    named = f"questions.{kind.folder}.kind", f"questions/{kind.folder}/kind"
    found = {
        file.relative_to(ENGINE).as_posix()
        for folder in ("site_builder", "static")
        for file in (ENGINE / folder).rglob("*")
        if file.suffix in SOURCES and (HERE / kind.folder) not in file.parents
        if any(name in file.read_text(encoding="utf-8") for name in named)
    }
    found = {path for path in found if not path.startswith("site_builder/checks/")}
    assert found == {"site_builder/markdown/questions/kinds.py"}


OWN_STATIC = ("css/book.css", "js/main.ts", "js/search/ranking.ts", "js/search/words.ts")
PLAIN = {
    "content/book.toml": 'title = "Plain"\nsubtitle = "Text."\nprerequisites = "None."\n'
    'chapters = ["00-first"]\n',
    "content/01-second.md": None,
    **{f"static/{name}": None for name in (*OWN_STATIC, "images/favicon.svg")},
}
"""A book without static files of its own."""
QUESTION = ":::{quiz} sum\nOne and one?\n- [x] Two\n  : Yes.\n- [ ] One\n  : No.\n:::\n"


def test_question_ships_its_own_kind_and_no_other(
    make_book: MakeBook, bundled: pytest.MonkeyPatch
) -> None:
    options = make_book(QUESTION, PLAIN)
    bundled.undo()
    files = {name: content_bytes(content) for name, content in render_site(options).items()}
    scripts = b"".join(text for name, text in files.items() if name.endswith(".js"))
    assert b"label.option" in scripts
    assert b".grip" not in scripts
    (sheet,) = (text for name, text in files.items() if name.endswith("/css/book.css"))
    for kind, shipped in (("choice", True), ("order", False)):
        assert ((HERE / kind / "kind.css").read_bytes() in sheet) is shipped


@pytest.fixture(scope="module")
def guide(engine: Engine, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built guide, without Python for the browser."""
    folder = tmp_path_factory.mktemp("guide")
    done = engine.run(folder, "-m", "site_builder", "guide", "--build-only", "--no-runtime")
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "build" / "guide" / "site"


def test_every_directive_and_role_has_a_section_in_the_guide(guide: Path) -> None:
    for page, names in (("directives", DIRECTIVES), ("roles", ROLES)):
        html = (guide / page / "index.html").read_bytes()
        headings = [heading.text.strip() for heading in read_html(html).all("h2")]
        declared = [item.name for item in names]
        assert [heading for heading in headings if heading in declared] == declared


def test_every_kind_of_question_has_an_example() -> None:
    texts = (text for name, text in guide_files().items() if name.endswith(".md"))
    pages = b"".join(map(content_bytes, texts)).decode()
    used = {*re.findall(r"^:kind: ([\w-]+)", pages, re.MULTILINE), "single", "choice"}
    assert {name for kind in KINDS for name in (kind.quiz or kind.predict)} <= used


def test_directive_without_an_example_is_reported_with_its_file() -> None:
    with pytest.raises(NoExampleError, match=r"guide/examples/riddle\.md"):
        directive_page([replace(QUIZ, name="riddle")])


def test_guide_lists_every_class_of_drawings_and_every_colour_role() -> None:
    sheets = ("overlay", "illustrations")
    css = "".join((STATIC / "css" / f"{name}.css").read_text("utf-8") for name in sheets)
    rules = re.findall(r"^\.overlay (?!>)(.+?)(?: \{|,)$", css, re.MULTILINE)
    styled = {name for rule in rules for name in re.findall(r"\.([a-z-]+)", rule)}
    assert {"dashed", "ground", "on-swatch", "small", "sub"} <= styled
    page = guide_files()["content/05-drawings.md"].decode()
    roles, _, texts = read_classes(STATIC / "css" / "overlay.css")
    assert {"small", "strong"} <= set(texts)
    assert {name for name in {*styled, *roles} if f"`{name}`" not in page} == set()
    assert set(roles) <= {role.name for role in ROLES}
