"""A book in German: no word of its interface is English, and its figures, questions and search
speak as its pages do."""

import json
import re
import zipfile
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any
from xml.etree import ElementTree

import pytest
from playwright.sync_api import Browser, expect
from support.built import built_once
from support.engine import Engine
from support.interface_words import engine_sentences, phrases, said
from support.places import GERMAN_BOOK
from support.reader import Reader, visit
from support.static_server import serving

from site_builder.languages.words import ENGLISH, load_words

WORDS = load_words("de")
XML = "{http://www.w3.org/XML/1998/namespace}"


@pytest.fixture(scope="session")
def german_site(engine: Engine, tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    def build(out: Path) -> CompletedProcess[str]:
        return engine.run(GERMAN_BOOK, "-m", "site_builder", "build", "--out", str(out))

    return built_once(tmp_path_factory, worker_id, "german", build)


@pytest.fixture(scope="session")
def german_book(german_site: Path) -> Any:
    return json.loads((german_site / "book.json").read_text(encoding="utf-8"))


def page(site: Path, address: str) -> str:
    return (site / address / "index.html").read_text(encoding="utf-8")


def test_it_shows_every_kind_of_question_and_of_prediction(german_book: Any) -> None:
    kinds = {quiz["kind"] for quiz in german_book["quizzes"]}
    assert kinds == {"single", "multiple", "number", "order", "figure"}
    kinds = {prediction["kind"] for prediction in german_book["predictions"]}
    assert kinds == {"choice", "number", "sketch"}


def test_no_english_word_of_the_interface_is_left(german_site: Path) -> None:
    german = "\n".join(phrase for _, phrase in phrases(WORDS))
    files = [file for file in german_site.rglob("*") if file.suffix in (".html", ".js", ".css")]
    left = [
        f"{file.relative_to(german_site)}: {phrase!r} ({key})"
        for file in files
        for text in (said(file),)
        for key, phrase in phrases(ENGLISH)
        if phrase in text and phrase not in german
    ]
    assert left == []


def test_the_engine_of_its_figures_says_no_english_sentence(german_site: Path) -> None:
    shown = [file for file in german_site.rglob("*.html") if "assets" not in file.parts]
    texts = {file: re.sub(r"<[^>]*>", "\n", said(file)) for file in shown}
    left = [
        f"{file.relative_to(german_site)}: {sentence!r}"
        for file, text in texts.items()
        for sentence in engine_sentences()
        if sentence in text
    ]
    assert left == []


def test_its_e_book_is_in_german(engine: Engine, tmp_path: Path) -> None:
    file = tmp_path / "buch.epub"
    made = engine.run(GERMAN_BOOK, "-m", "site_builder", "epub", "--out", str(file))
    assert made.returncode == 0, made.stderr
    with zipfile.ZipFile(file) as book:
        texts = {name: book.read(name).decode() for name in book.namelist() if is_text(name)}
    roots = {name: ElementTree.fromstring(text) for name, text in texts.items()}
    pages = [root for name, root in roots.items() if name.endswith(".xhtml")]
    assert {page.get(f"{XML}lang") or page.get("lang") for page in pages} == {"de"}
    german = "\n".join(phrase for _, phrase in phrases(WORDS))
    shown = "\n".join("\n".join(root.itertext()) for root in roots.values())
    assert [said for _, said in phrases(ENGLISH) if said in shown and said not in german] == []
    for key in ("edition.answers", "edition.contents", "glossary.title"):
        assert WORDS(key) in shown


def is_text(name: str) -> bool:
    return name.endswith((".xhtml", ".opf"))


def test_every_page_says_its_language(german_site: Path) -> None:
    pages = [file for file in german_site.rglob("*.html") if "assets" not in file.parts]
    tags = {tag for file in pages for tag in re.findall(r'<html lang="([^"]*)"', said(file))}
    assert tags == {"de"}


def test_quotes_numbers_and_names_are_german(german_site: Path) -> None:
    text = said(german_site / "das-pendel" / "index.html")
    assert "Ein „Pendel“ ist" in text
    assert "zeigt die Abbildung 2,48\u00a0s." in text
    assert "Galilei und Elsevier 1638" in text
    assert "1. Auflage" in text


def test_numbering_begins_where_the_outline_says_and_labels_are_its_own(
    german_site: Path, german_book: Any
) -> None:
    assert [chapter["number"] for chapter in german_book["chapters"]] == [1, 2, 3]
    text = page(german_site, "das-pendel")
    assert ">Abbildung 1.1</a>" in text
    assert ">Rechenbeispiel 1.1</a>" in text


def test_its_licence_is_its_own(german_site: Path) -> None:
    assert "unter CC BY-SA 4.0" in page(german_site, "das-pendel")


@pytest.mark.browser
def test_a_visit_in_german(german_site: Path, german_book: Any, brisk_chromium: Browser) -> None:
    with serving(german_site) as server, visit(brisk_chromium, server, bypass_csp=True) as reader:
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
        assert not [said for said in engine_sentences() if said in figure.inner_text()]
        _answer(reader)
        _search(reader)
        kept = reader.page.evaluate("Object.keys(localStorage)")
        assert kept
        assert all(name.startswith("schwingungen:") for name in kept)
        reader.assert_no_complaints()


def _answer(reader: Reader) -> None:
    form = reader.page.locator("#quiz-vier-meter")
    form.locator("input[name=answer]").fill("4.01")
    form.locator("button[type=submit]").click()
    expect(form.locator(".verdict")).to_have_text(WORDS("script.question.right"))
    by_figure = reader.page.locator("#quiz-stellen-sie-ein")
    by_figure.locator("button[type=submit]").click()
    expect(by_figure).to_have_attribute("data-answered", "correct")
    counted = WORDS("script.progress.answered", right=2, count=5)
    expect(reader.page.locator(".progress-count")).to_contain_text(counted)


def _search(reader: Reader) -> None:
    """By another form of the word than the page has."""
    reader.page.keyboard.press("/")
    dialog = reader.page.locator("dialog.search")
    dialog.locator("input[type=search]").fill("kleiner Winkeln")
    expect(dialog.locator("a[data-result]").first).to_have_attribute(
        "href", re.compile("die-kleinen-winkel")
    )
    expect(dialog.get_by_role("status")).to_contain_text("Abschnitt")
    reader.page.keyboard.press("Escape")
