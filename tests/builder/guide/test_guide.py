"""The guide for authors: all that is declared is in it, with an example, and it builds."""

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from support.html_outline import read_html

from site_builder.book_root import ENGINE, VARIABLE
from site_builder.guide.book import write_guide
from site_builder.guide.classes import read_classes
from site_builder.guide.pages import (
    EXAMPLES,
    NOT_HERE,
    NoExampleError,
    directive_page,
    read_examples,
    role_page,
)
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.directives.quiz import KINDS, QUIZ
from site_builder.markdown.roles import ROLES
from site_builder.markdown.roles.ref import REF


@pytest.fixture(scope="module")
def guide(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built guide, without Python for the browser."""
    folder = tmp_path_factory.mktemp("guide")
    write_guide(folder / "book")
    command = [sys.executable, "-m", "site_builder", "build", "--no-runtime"]
    environment = {**os.environ, VARIABLE: str(folder / "book")}
    done = subprocess.run(
        [*command, "--out", str(folder / "site")],
        cwd=ENGINE, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "site"


def test_every_directive_and_role_has_its_section(guide: Path) -> None:
    for page, names in (("directives", DIRECTIVES), ("roles", ROLES)):
        html = (guide / page / "index.html").read_bytes()
        headings = [heading.text.strip() for heading in read_html(html).all("h2")]
        declared = [item.name for item in names]
        assert [heading for heading in headings if heading in declared] == declared


def test_every_declared_thing_is_used_in_the_built_text(guide: Path) -> None:
    assert (guide / "directives" / "index.html").is_file()
    page = directive_page()
    listings = re.sub(r"^(````|```).*?^\1$", "", page, flags=re.MULTILINE | re.DOTALL)
    used = set(re.findall(r"^:+\{([\w-]+)\}", listings, re.MULTILINE))
    assert used == {item.name for item in DIRECTIVES} - set(NOT_HERE)


def test_there_is_a_question_of_each_kind() -> None:
    kinds = re.findall(r"^:kind: (\w+)", read_examples(EXAMPLES)["quiz"], re.MULTILINE)
    assert {"single", *kinds} == set(KINDS)


def test_an_example_is_of_something_that_there_is() -> None:
    declared = {item.name for item in DIRECTIVES} | {f"role-{role.name}" for role in ROLES}
    assert set(read_examples(EXAMPLES)) <= declared


def test_a_new_directive_without_an_example_is_told_where_to_write_one() -> None:
    with pytest.raises(NoExampleError, match=r"guide/examples/riddle\.md"):
        directive_page([replace(QUIZ, name="riddle")])


def test_a_new_role_without_an_example_is_told_where_to_write_one() -> None:
    with pytest.raises(NoExampleError, match=r"guide/examples/role-see\.md"):
        role_page([replace(REF, name="see")])


def test_the_classes_of_drawings_are_those_of_the_style_sheet() -> None:
    classes = read_classes(ENGINE / "static" / "css" / "overlay.css")
    assert {"world", "camera", "ray", "image", "light", "error", "muted"} == set(classes.roles)
    assert {"thin", "bold", "dashed", "faint", "fill", "solid"} <= set(classes.manners)
    assert {"small", "strong", "italic", "halo"} <= set(classes.texts)


def test_a_guide_written_again_leaves_what_is_the_same(tmp_path: Path) -> None:
    write_guide(tmp_path)
    (tmp_path / "content" / "old.md").write_text("Left over.", encoding="utf-8")
    before = {file: file.stat().st_mtime_ns for file in tmp_path.rglob("*.toml")}
    write_guide(tmp_path)
    assert {file: file.stat().st_mtime_ns for file in tmp_path.rglob("*.toml")} == before
    assert not (tmp_path / "content" / "old.md").exists()
