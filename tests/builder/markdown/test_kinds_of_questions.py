"""A kind of question is one folder and one line of the list."""

import re

import pytest

from site_builder.files.engine import ENGINE
from site_builder.markdown.questions.kind import HERE, QuestionKind
from site_builder.markdown.questions.kinds import KINDS, names_of_kinds

FILES = {"__init__.py", "kind.py", "kind.html", "kind.ts", "kind.css", "kind.md"}
SOURCES = {".py", ".html", ".ts", ".css", ".mjs"}


def test_every_folder_is_a_kind_and_every_kind_a_folder() -> None:
    folders = {file.parent.name for file in HERE.glob("*/kind.py")}
    assert folders == {kind.folder for kind in KINDS}


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.folder)
def test_a_kind_has_all_its_files(kind: QuestionKind) -> None:
    exported = {"moodle.xml", "qti.xml"} if kind.quiz else set()
    assert {file.name for file in (HERE / kind.folder).glob("*.*")} >= FILES | exported


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.folder)
def test_its_examples_are_questions_of_it(kind: QuestionKind) -> None:
    directive = "quiz" if kind.quiz else "predict"
    example = kind.file("md").read_text(encoding="utf-8")
    default = names_of_kinds(directive)[0]
    starts = example.count(f":::{{{directive}}}")
    written = re.findall(r"^:kind: ([\w-]+)", example, re.MULTILINE)
    unwritten = [default] * (starts - len(written))
    assert {*written, *unwritten} == set(kind.names(directive))


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
    own_checks = {"site_builder/checks/figure_questions.py"}
    assert found - own_checks == {"site_builder/markdown/questions/kinds.py"}


def test_no_two_kinds_have_one_name() -> None:
    names = [name for kind in KINDS for name in {*kind.quiz, *kind.predict}]
    assert len(names) == len(set(names))
