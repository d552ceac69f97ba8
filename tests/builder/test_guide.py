"""The guide for authors: all that is declared is in it, with an example, and it builds."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect
from support.engine import Engine
from support.html_outline import read_html
from support.static_server import serving

from site_builder.files.engine import STATIC
from site_builder.guide.classes import read_classes
from site_builder.guide.command import guide_files
from site_builder.guide.pages import NoExampleError, directive_page
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.directives.questions import QUIZ
from site_builder.markdown.questions.kinds import KINDS
from site_builder.markdown.roles import ROLES


@pytest.fixture(scope="module")
def guide(engine: Engine, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built guide, without Python for the browser."""
    folder = tmp_path_factory.mktemp("guide")
    done = engine.run(folder, "-m", "site_builder", "guide", "--build-only", "--no-runtime")
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "build" / "guide" / "site"


def test_every_directive_and_role_has_its_section(guide: Path) -> None:
    for page, names in (("directives", DIRECTIVES), ("roles", ROLES)):
        html = (guide / page / "index.html").read_bytes()
        headings = [heading.text.strip() for heading in read_html(html).all("h2")]
        declared = [item.name for item in names]
        assert [heading for heading in headings if heading in declared] == declared


def test_a_directive_without_an_example_is_reported_with_the_file_to_write() -> None:
    with pytest.raises(NoExampleError, match=r"guide/examples/riddle\.md"):
        directive_page([replace(QUIZ, name="riddle")])


def test_every_class_of_drawings_is_on_their_page_and_every_colour_role_is_a_role() -> None:
    sheets = ("overlay", "illustrations")
    css = "".join((STATIC / "css" / f"{name}.css").read_text("utf-8") for name in sheets)
    rules = re.findall(r"^\.overlay (?!>)(.+?)(?: \{|,)$", css, re.MULTILINE)
    styled = {name for rule in rules for name in re.findall(r"\.([a-z-]+)", rule)}
    assert {"world", "dashed", "ground", "on-swatch", "sub"} <= styled
    page = guide_files()["content/05-drawings.md"].decode()
    assert {name for name in styled if f"`{name}`" not in page} == set()
    classes = read_classes(STATIC / "css" / "overlay.css")
    assert set(classes.roles) <= {role.name for role in ROLES}


@pytest.mark.browser
def test_every_question_of_it_replies_to_a_press_of_its_button(
    guide: Path, chromium: Browser
) -> None:
    """Whatever kinds there are; of their own tests others are in ``tests/e2e``."""
    with serving(guide) as server, chromium.new_context() as context:
        page = context.new_page()
        page.goto(f"{server.url}directives/", wait_until="domcontentloaded")
        page.wait_for_function("document.querySelector('form.quiz label.option')")
        forms = page.locator("main form:is([data-quiz], [data-predict])").all()
        assert {form.get_attribute("data-kind") for form in forms} == {
            name for kind in KINDS for name in (kind.quiz or kind.predict)
        }
        for form in forms:
            form.evaluate("form => form.requestSubmit()")
            expect(form.locator(".feedback")).not_to_be_empty()
