"""``serve``, as an author has it: a small book is edited while a page of it is open."""

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
from support.places import ROOT, WAVES

pytestmark = pytest.mark.browser
LONGEST_S = 120
MARKED = "window.sameLoad === true"


@dataclass(frozen=True, slots=True)
class Author:
    """A served copy of the book on waves, and a page of it; the browser runs no Python."""

    book: Path
    address: str
    page: Page
    first_title: str
    """Of the page as it was before the first build."""

    def open(self, chapter: str) -> None:
        """A page that would not be the same after it was loaded anew."""
        self.page.goto(f"{self.address}{chapter}/", wait_until="load")
        self.page.wait_for_timeout(100)
        self.page.evaluate("window.sameLoad = true")

    def edit(self, path: str, old: str, new: str) -> None:
        file = self.book / path
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def is_same_load(self) -> bool:
        return bool(self.page.evaluate(MARKED))


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


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
    engine: Engine, tmp_path_factory: pytest.TempPathFactory, brisk_chromium: Browser
) -> Iterator[Author]:
    folder = tmp_path_factory.mktemp("edited")
    book, port = folder / "book", free_port()
    shutil.copytree(WAVES, book)
    (book / "static" / "css").mkdir(parents=True)
    shutil.copy(ROOT / "static" / "css" / "prose.css", book / "static" / "css")
    command = [engine.python, "-m", "site_builder", "serve", "--port", str(port)]
    with subprocess.Popen(
        [*command, "--out", str(folder / "site")], cwd=book, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ) as serving, brisk_chromium.new_context(service_workers="block") as context:  # fmt: skip
        try:
            wait_for_server(port)
            context.add_init_script(SILENT_WORKER)
            page = context.new_page()
            page.set_default_timeout(30_000)
            address = f"http://localhost:{port}/"
            page.goto(f"{address}strings/", wait_until="domcontentloaded")
            title = page.title()
            expect(page.locator("h1")).to_contain_text("A String", timeout=LONGEST_S * 1000)
            yield Author(book, address, page, title)
        finally:
            serving.terminate()


def test_a_page_opened_during_the_first_build_shows_the_book_after_it(author: Author) -> None:
    assert author.first_title == "Being built"
    expect(author.page).to_have_title(re.compile("A String Held at Both Ends"))


def test_an_edited_sentence_is_put_into_the_page_as_it_is(author: Author) -> None:
    author.open("strings")
    page = author.page
    option = page.locator("#quiz-on-a-longer-string input[value='1']")
    option.check()
    tension = page.locator("#figure-standing-waves input[name=tension]")
    tension.fill("80")
    page.evaluate("scrollTo(0, 900)")
    author.edit("content/00-strings.md", "Pluck a guitar string", "Strum a guitar string")
    expect(page.locator("main")).to_contain_text("Strum a guitar string")
    assert author.is_same_load()
    assert page.evaluate("scrollY") == 900
    expect(option).to_be_checked()
    expect(tension).to_have_value("80")


def test_a_style_rule_changes_the_page_as_it_is(author: Author) -> None:
    author.open("strings")
    with (author.book / "static" / "css" / "prose.css").open("a", encoding="utf-8") as sheet:
        sheet.write("\nmain { letter-spacing: 3px; }\n")
    expect(author.page.locator("main")).to_have_css("letter-spacing", "3px")
    assert author.is_same_load()


def test_a_page_that_is_loaded_anew_has_the_answers_that_were_not_sent(author: Author) -> None:
    author.open("spectra")
    page = author.page
    page.locator("#predict-half-a-cycle-more input[name=guess]").fill("-33")
    page.locator("#quiz-what-a-window-does input[value='2']").check()
    things = page.locator("#quiz-in-the-order-of-the-work .order-item")
    things.first.locator("[data-move=down]").click()
    texts = things.locator(".option-text").all_inner_texts()
    values = [thing.locator("input").input_value() for thing in things.all()]
    author.edit("content/01-spectra.md", "## Which sines", "## A new heading\n\n## Which sines")
    expect(page.locator("main h2").first).to_contain_text("A new heading")
    page.wait_for_load_state("load")
    expect(things.locator(".option-text")).to_have_text(texts)
    assert not author.is_same_load()
    assert [thing.locator("input").input_value() for thing in things.all()] == values
    expect(page.locator("#predict-half-a-cycle-more input[name=guess]")).to_have_value("-33")
    expect(page.locator("#quiz-what-a-window-does input[value='2']")).to_be_checked()


def test_a_mistake_lies_over_the_page_until_it_is_mended(author: Author) -> None:
    author.open("beats")
    told = author.page.locator("#build-mistakes")
    author.edit("content/02-beats.md", "Throw a stone", "Throw a stone, see {ref}`nowhere`,")
    expect(told).to_contain_text(re.compile(r"content/02-beats\.md:\d+: .*nowhere"))
    author.edit("content/02-beats.md", "{ref}`nowhere`", "there")
    expect(author.page.locator("main")).to_contain_text("Throw a stone, see there")
    expect(told).to_have_count(0)
    assert author.is_same_load()


def test_a_changed_scene_loads_its_page_with_the_settings_of_the_figure(author: Author) -> None:
    author.open("beats")
    page = author.page
    medium = page.locator("#figure-wave-packet [name=medium]").first
    page.locator("a.set", has_text="deep water").first.click()
    scene = "simulations/scenes/wave_packet/scene.py"
    author.edit(scene, "Beat over crest", "Beat by crest")
    expect(page.locator("main")).to_contain_text("Beat by crest", timeout=LONGEST_S * 1000)
    assert not author.is_same_load()
    expect(medium).to_have_value("water")
