"""A German book on another subject, built by the installed engine from its own parts only, with a
German interface and its own figures, questions and search."""

import re
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from playwright.sync_api import Browser, expect
from support.engine import Engine
from support.interface_words import engine_sentences, phrases, visible_text
from support.places import GERMAN_BOOK, SCENES, hard_cases, illustrations
from support.reader import Reader, visit
from support.static_server import serving

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.languages.words import ENGLISH, load_words

WORDS = load_words("de")
XML = "{http://www.w3.org/XML/1998/namespace}"
STYLES = re.compile(r"<style>.*?</style>", re.DOTALL)
"""The engine's; their colours have names that a book's figures may have, too."""
GERMAN = "\n".join(phrase for _, phrase in phrases(WORDS))


def pages(site: Path) -> list[Path]:
    return [file for file in site.rglob("*.html") if "assets" not in file.parts]


def test_german_book_has_its_chapters_figures_and_all_question_kinds(german_book: Any) -> None:
    chapters = [(chapter["number"], chapter["id"]) for chapter in german_book["chapters"]]
    assert chapters == [(1, "das-pendel"), (2, "die-saite"), (3, "zahlen")]
    assert sorted(scene["id"] for scene in german_book["simulations"]) == sorted(SCENES)
    kinds = {quiz["kind"] for quiz in german_book["quizzes"]}
    assert kinds == {"single", "multiple", "number", "order", "figure"}
    kinds = {prediction["kind"] for prediction in german_book["predictions"]}
    assert kinds == {"choice", "number", "sketch"}


def test_german_book_ships_no_parts_of_this_book(site: Path) -> None:
    tables = [table.id for table in hard_cases()]
    ours = [*SCENE_MODULES, *LADDER_MODULES, *illustrations(), *tables]
    ids = re.compile(rf"""["'#/](?:figure-|ladder-|extremes-)?({"|".join(ours)})["'/]""")
    leaked = [
        f"{file.relative_to(site)}: {found[1]}"
        for file in site.rglob("*")
        if file.suffix in (".html", ".json") and not {*file.parts} & {"licences", "runtime.json"}
        for found in ids.finditer(STYLES.sub("", file.read_text(encoding="utf-8")))
    ]
    assert leaked == []


def test_german_book_has_the_pages_and_licences_that_it_needs(site: Path) -> None:
    assert (site / "glossary" / "index.html").is_file()
    assert not (site / "lecture-plan").exists()
    quoted = site / "source" / "simulations" / "scenes" / "fadenpendel" / "scene" / "index.html"
    assert "arithmetic-geometric mean" in quoted.read_text(encoding="utf-8")
    page = (site / "licences" / "index.html").read_text(encoding="utf-8")
    assert "textbook-builder" in page
    assert "The Image Formation authors" in page


def test_german_book_has_no_english_interface_texts(site: Path) -> None:
    files = [file for file in site.rglob("*") if file.suffix in (".html", ".js", ".css")]
    left = [
        f"{file.relative_to(site)}: {phrase!r} ({key})"
        for file in files
        for text in (visible_text(file),)
        for key, phrase in phrases(ENGLISH)
        if phrase in text and phrase not in GERMAN
    ]
    assert left == []
    texts = {file: re.sub(r"<[^>]*>", "\n", visible_text(file)) for file in pages(site)}
    left = [
        f"{file.relative_to(site)}: {sentence!r}"
        for file, text in texts.items()
        for sentence in engine_sentences()
        if sentence in text
    ]
    assert left == []
    tags = {
        tag
        for file in pages(site)
        for tag in re.findall(r'<html lang="([^"]*)"', visible_text(file))
    }
    assert tags == {"de"}


def test_quotes_numbers_labels_and_licence_are_german(site: Path) -> None:
    text = visible_text(site / "das-pendel" / "index.html")
    for phrase in (
        *("Ein „Pendel“ ist", "zeigt die Abbildung 2,48\u00a0s.", "Galilei und Elsevier 1638"),
        *("1. Auflage", ">Abbildung 1.1</a>", ">Rechenbeispiel 1.1</a>", "unter CC BY-SA 4.0"),
    ):
        assert phrase in text, phrase


def test_e_book_of_the_german_book_is_in_german(engine: Engine, tmp_path: Path) -> None:
    file = tmp_path / "buch.epub"
    made = engine.run(GERMAN_BOOK, "-m", "site_builder", "epub", "--out", str(file))
    assert made.returncode == 0, made.stderr
    with zipfile.ZipFile(file) as book:
        texts = (name for name in book.namelist() if name.endswith((".xhtml", ".opf")))
        roots = {name: ElementTree.fromstring(book.read(name)) for name in texts}
    chapters = [root for name, root in roots.items() if name.endswith(".xhtml")]
    assert {page.get(f"{XML}lang") or page.get("lang") for page in chapters} == {"de"}
    shown = "\n".join("\n".join(root.itertext()) for root in roots.values())
    assert [text for _, text in phrases(ENGLISH) if text in shown and text not in GERMAN] == []
    for key in ("edition.answers", "frame.contents", "glossary.title"):
        assert WORDS(key) in shown


def test_german_books_own_tests_pass(engine: Engine) -> None:
    folder = str(GERMAN_BOOK / "tests")
    how = ("-q", "-p", "no:cacheprovider", "-c", "/dev/null", "--rootdir", folder)
    done = engine.run(GERMAN_BOOK, "-m", "pytest", *how, folder)
    assert done.returncode == 0, done.stdout + done.stderr
    done = engine.run(GERMAN_BOOK, "-c", "import simulations.scenes.camera")
    assert done.stderr.rstrip().endswith("No module named 'simulations.scenes.camera'")


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("thesis.tex", "is no book; legal: a folder that holds content/"),
        ("simulations/__init__.py", "hides the engine's part of simulations; legal: "),
        ("simulations/engine/frame.py", "hides the engine's part of simulations; legal: "),
        ("simulations/models/color.py", "hides the engine's part of simulations; legal: "),
    ],
)
def test_folder_that_is_no_book_or_hides_the_engine_is_refused(
    path: str, says: str, engine: Engine, tmp_path: Path
) -> None:
    (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / path).touch()
    done = engine.run(tmp_path, "-m", "site_builder", "check")
    assert done.returncode == 1
    assert says in done.stderr


@pytest.mark.browser
def test_german_book_works_in_the_browser(
    site: Path, german_book: Any, baseline_chromium: Browser
) -> None:
    with (
        serving(site) as server,
        visit(baseline_chromium, server, folded=True, bypass_csp=True) as reader,
    ):
        figure = reader.open_figure(german_book, "fadenpendel")
        figure.locator("input[name=length]").fill("1.5")
        reader.settle(figure)  # a figure whose cost is not known yet drafts
        before = reader.frames(figure)
        figure.locator("input[name=length]").fill("1")
        reader.wait_frame(figure, before)
        expect(figure.locator("output[name=dauer]")).to_have_text("2,02")
        expect(figure.locator(".control-value").first).to_have_text("1,00\u00a0m")
        report = figure.locator("details.stage-report")
        report.locator("summary").click()
        expect(report).to_contain_text(WORDS("script.stage_report.changed", names="length"))
        assert not [text for text in engine_sentences() if text in figure.inner_text()]
        answer(reader)
        search(reader)
        kept = reader.page.evaluate("Object.keys(localStorage)")
        assert kept
        assert all(name.startswith("schwingungen:") for name in kept)
        reader.assert_no_errors()


def answer(reader: Reader) -> None:
    form = reader.page.locator("#quiz-vier-meter")
    form.locator("input[name=answer]").fill("4.01")
    form.locator("button[type=submit]").click()
    expect(form.locator(".verdict")).to_have_text(WORDS("script.question.right"))
    by_figure = reader.page.locator("#quiz-stellen-sie-ein")
    by_figure.locator("button[type=submit]").click()
    expect(by_figure).to_have_attribute("data-answered", "correct")
    counted = WORDS("script.progress.answered", right=2, count=5)
    expect(reader.page.locator(".progress-count")).to_contain_text(counted)


def search(reader: Reader) -> None:
    """Search with an inflected form of the word on the page."""
    reader.page.keyboard.press("/")
    dialog = reader.page.locator("dialog.search")
    dialog.locator("input[type=search]").fill("hoher Tönen")
    found = dialog.locator("a[data-result]").first
    expect(found).to_have_attribute("href", re.compile("die-saite"))
    expect(dialog.get_by_role("status")).to_contain_text("Abschnitt")
    reader.page.keyboard.press("Escape")


LISTEN = """
const {start} = AudioBufferSourceNode.prototype;
window.heard = [];
AudioBufferSourceNode.prototype.start = function (when, offset) {
  const samples = this.buffer.getChannelData(0);
  const peak = samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  window.heard.push({length: samples.length, rate: this.buffer.sampleRate, peak, offset});
  this.loop = true; // or the sound may end before a busy machine has drawn the next frame
  return start.call(this, when, offset);
};
"""


@pytest.mark.browser
def test_sound_plays_on_a_press_and_follows_a_moved_control(
    site: Path, german_book: Any, baseline_chromium: Browser
) -> None:
    with (
        serving(site) as server,
        visit(baseline_chromium, server, LISTEN, bypass_csp=True) as reader,
    ):
        figure = reader.open_figure(german_book, "saite")
        button = figure.locator("[data-play-sound]")
        assert reader.page.evaluate("heard") == []
        play = button.text_content() or ""
        button.click()
        reader.page.wait_for_function("heard.length === 1")
        expect(button).not_to_have_text(play)
        before = reader.frames(figure)
        figure.locator("input[name=number]").fill("5")
        reader.page.wait_for_function("heard.length === 2")
        reader.wait_frame(figure, before)
        assert figure.locator("output[name=ruhe]").text_content() == "6"
        first, second = reader.page.evaluate("heard")
        assert (first["length"], first["rate"], first["offset"]) == (44_100, 22_050, 0)
        assert 0.4 < first["peak"] <= 0.5
        assert second["offset"] > 0, "goes on where the first was"
        reader.open_controls(figure)
        before = reader.frames(figure)
        figure.locator("input[name=phase]").fill("0.5")
        reader.wait_frame(figure, before)
        button.click()
        expect(button).to_have_text(play)
        reader.turn_to_figure(german_book, "fadenpendel")
        reader.assert_no_errors()
