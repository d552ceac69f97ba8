"""``serve`` for an author: a small book is edited while one of its pages is open."""

import re
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect
from support.engine import Engine
from support.page_scripts import SILENT_WORKER
from support.places import GERMAN_BOOK, ROOT
from support.reader import set_limits
from support.static_server import free_port

pytestmark = pytest.mark.browser
LONGEST_S = 120
MARKED = "window.sameLoad === true"


@dataclass(frozen=True, slots=True)
class Author:
    """A served copy of the German book and one of its pages; the browser runs no Python."""

    book: Path
    address: str
    page: Page
    first_title: str
    """Title of the page before the first build."""

    def open(self, chapter: str) -> None:
        """Open a page that listens for changes, and mark it to detect a reload."""
        set_limits(self.page.context)
        with self.page.expect_response("**/.reload/events"):
            self.page.goto(f"{self.address}{chapter}/", wait_until="load")
        self.page.evaluate("window.sameLoad = true")

    def edit(self, path: str, old: str, new: str) -> None:
        file = self.book / path
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def is_same_load(self) -> bool:
        return bool(self.page.evaluate(MARKED))


def wait_for_server(port: int) -> None:
    end = time.monotonic() + LONGEST_S
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
        except OSError:
            assert time.monotonic() < end, "nobody serves"
            time.sleep(0.02)
        else:
            return


@pytest.fixture(scope="module")
def author(
    engine: Engine, tmp_path_factory: pytest.TempPathFactory, baseline_chromium: Browser
) -> Iterator[Author]:
    folder = tmp_path_factory.mktemp("edited")
    book, port = folder / "book", free_port()
    shutil.copytree(GERMAN_BOOK, book)
    (book / "static" / "css").mkdir(parents=True)
    shutil.copy(ROOT / "static" / "css" / "prose.css", book / "static" / "css")
    command = [engine.python, "-m", "site_builder", "serve", "--port", str(port)]
    with subprocess.Popen(
        [*command, "--out", str(folder / "site")], cwd=book, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ) as serving, baseline_chromium.new_context(service_workers="block") as context:  # fmt: skip
        try:
            wait_for_server(port)
            context.add_init_script(SILENT_WORKER)
            page = context.new_page()
            set_limits(context)
            address = f"http://localhost:{port}/"
            page.goto(f"{address}das-pendel/", wait_until="domcontentloaded")
            title = page.title()
            expect(page.locator("h1")).to_contain_text("Das Pendel", timeout=LONGEST_S * 1000)
            yield Author(book, address, page, title)
        finally:
            serving.terminate()


def test_page_opened_during_the_first_build_shows_the_book_after_it(author: Author) -> None:
    assert author.first_title == "Being built"
    expect(author.page).to_have_title(re.compile("Das Pendel"))


def test_edited_sentence_is_updated_without_a_reload(author: Author) -> None:
    author.open("das-pendel")
    page = author.page
    option = page.locator("#quiz-was-zaehlt input[value='1']")
    option.check()
    length = page.locator("#figure-fadenpendel input[name=length]")
    length.fill("2.5")
    page.evaluate("scrollTo(0, 900)")
    author.edit("content/01-das-pendel.md", "Die Masse kommt", "Das Gewicht kommt")
    expect(page.locator("main")).to_contain_text("Das Gewicht kommt")
    assert author.is_same_load()
    assert page.evaluate("scrollY") == 900
    expect(option).to_be_checked()
    expect(length).to_have_value("2.5")


def test_new_style_rule_is_applied_without_a_reload(author: Author) -> None:
    author.open("das-pendel")
    with (author.book / "static" / "css" / "prose.css").open("a", encoding="utf-8") as sheet:
        sheet.write("\nmain { letter-spacing: 3px; }\n")
    expect(author.page.locator("main")).to_have_css("letter-spacing", "3px")
    assert author.is_same_load()


def test_reloaded_page_keeps_answers_that_were_not_submitted(author: Author) -> None:
    author.open("das-pendel")
    page = author.page
    guess = page.locator("#predict-wie-lange input[name=guess]")
    guess.fill("3")
    page.locator("#quiz-was-noch input[value='2']").check()
    things = page.locator("#quiz-der-reihe-nach .order-item")
    things.first.locator("[data-move=down]").click()
    texts = things.locator(".option-text").all_inner_texts()
    values = [thing.locator("input").input_value() for thing in things.all()]
    author.edit("content/01-das-pendel.md", "## Fragen", "## Ein Abschnitt\n\n## Fragen")
    expect(page.locator("main h2").nth(1)).to_contain_text("Ein Abschnitt")
    page.wait_for_load_state("load")
    expect(things.locator(".option-text")).to_have_text(texts)
    assert not author.is_same_load()
    assert [thing.locator("input").input_value() for thing in things.all()] == values
    expect(guess).to_have_value("3")
    expect(page.locator("#quiz-was-noch input[value='2']")).to_be_checked()


def test_mistake_is_shown_over_the_page_until_it_is_corrected(author: Author) -> None:
    author.open("zahlen")
    mistakes = author.page.locator("#build-mistakes")
    author.edit("content/03-zahlen.md", "Auf der Erde", "Auf der Erde, siehe {ref}`nowhere`,")
    expect(mistakes).to_contain_text(re.compile(r"content/03-zahlen\.md:\d+: .*nowhere"))
    author.edit("content/03-zahlen.md", "{ref}`nowhere`", "unten")
    expect(author.page.locator("main")).to_contain_text("Auf der Erde, siehe unten")
    expect(mistakes).to_have_count(0)
    assert author.is_same_load()


def test_changed_scene_reloads_its_page_and_keeps_the_settings(author: Author) -> None:
    author.open("das-pendel")
    page = author.page
    place = page.locator("#figure-fadenpendel [name=ort]").first
    page.locator("a.set", has_text="Auf dem Mond").first.click()
    scene = "simulations/scenes/fadenpendel/scene.py"
    author.edit(scene, "Die Wand dahinter", "Die Tafel dahinter")
    expect(page.locator("main")).to_contain_text("Die Tafel dahinter", timeout=LONGEST_S * 1000)
    assert not author.is_same_load()
    expect(place).to_have_value("mond")
