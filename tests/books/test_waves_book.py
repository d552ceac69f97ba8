"""A book on another subject: built whole by this engine, of its own parts alone."""

import json
import re
import zipfile
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect
from support.engine import Engine
from support.found import ILLUSTRATIONS, TABLES
from support.places import WAVES
from support.reader import visit
from support.static_server import serving
from support.waves import SCENES

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.files.engine import is_engine

STYLES = re.compile(r"<style>.*?</style>", re.DOTALL)
"""The engine's; their colours have names that a book's figures may have, too."""


def modules_of(site: Path) -> set[str]:
    (archive,) = site.glob("runtime/*/simulations.zip")
    with zipfile.ZipFile(archive) as opened:
        paths = [Path(name).with_suffix("").parts for name in opened.namelist()]
    return {".".join(parts).removesuffix(".__init__") for parts in paths}


def test_it_has_its_own_chapters_figures_and_questions(waves_book: Any) -> None:
    assert [chapter["id"] for chapter in waves_book["chapters"]] == ["strings", "spectra", "beats"]
    assert sorted(scene["id"] for scene in waves_book["simulations"]) == sorted(SCENES)
    kinds = {quiz["kind"] for quiz in waves_book["quizzes"]}
    assert kinds == {"single", "multiple", "number", "order", "figure"}


def test_its_readers_get_its_modules_and_the_engine_s_and_no_others(waves_site: Path) -> None:
    of_the_engine = set(filter(is_engine, modules_of(waves_site)))
    own = {
        ".".join(file.relative_to(WAVES).with_suffix("").parts).removesuffix(".__init__")
        for file in (WAVES / "simulations").rglob("*.py")
    }
    assert modules_of(waves_site) == of_the_engine | own
    assert {name for name in of_the_engine if ".models." in name} <= own


def test_its_runtime_names_its_scenes_and_ladders_alone(waves_site: Path) -> None:
    (file,) = waves_site.glob("runtime/*/runtime.json")
    table = json.loads(file.read_text(encoding="utf-8"))
    assert sorted(table["scenes"]) == sorted(SCENES)
    assert list(table["ladders"]) == ["tone-frequency"]


def test_nothing_that_readers_get_is_of_this_book(waves_site: Path) -> None:
    ours = [*SCENE_MODULES, *LADDER_MODULES, *ILLUSTRATIONS, *(table.id for table in TABLES)]
    ids = re.compile(rf"""["'#/](?:figure-|ladder-|extremes-)?({"|".join(ours)})["'/]""")
    told = [
        f"{file.relative_to(waves_site)}: {found[1]}"
        for file in waves_site.rglob("*")
        if file.suffix in (".html", ".json") and not {*file.parts} & {"licences", "runtime.json"}
        for found in ids.finditer(STYLES.sub("", file.read_text(encoding="utf-8")))
    ]
    assert told == []


def test_the_page_that_a_book_has_nothing_for_is_not_made(waves_site: Path) -> None:
    assert (waves_site / "glossary" / "index.html").is_file()
    assert not (waves_site / "lecture-plan").exists()


def test_the_licence_of_the_engine_is_printed(waves_site: Path) -> None:
    page = (waves_site / "licences" / "index.html").read_text(encoding="utf-8")
    assert "textbook-builder" in page
    assert "The Image Formation authors" in page


def test_what_it_quotes_is_its_own_code(waves_site: Path) -> None:
    page = waves_site / "source" / "simulations" / "models" / "spectra" / "index.html"
    assert "by_definition" in page.read_text(encoding="utf-8")


def test_its_own_tests_pass(engine: Engine) -> None:
    folder = str(WAVES / "tests")
    how = ("-q", "-p", "no:cacheprovider", "-c", "/dev/null", "--rootdir", folder)
    done = engine.run(WAVES, "-m", "pytest", *how, folder)
    assert done.returncode == 0, done.stdout + done.stderr


def test_it_has_the_models_of_the_engine_and_nothing_else_of_this_book(engine: Engine) -> None:
    both = "import simulations.models.color.srgb, simulations.models.spectra"
    assert engine.run(WAVES, "-c", both).stderr == ""
    done = engine.run(WAVES, "-c", "import simulations.scenes.camera")
    assert done.stderr.rstrip().endswith("No module named 'simulations.scenes.camera'")


def test_a_folder_that_is_no_book_is_refused_in_words(engine: Engine, tmp_path: Path) -> None:
    done = engine.run(tmp_path, "-m", "site_builder", "check")
    assert done.returncode == 1
    assert done.stderr == f"{tmp_path} is no book; legal: a folder that holds content/\n"


@pytest.mark.parametrize(
    "path",
    ["simulations/__init__.py", "simulations/engine/frame.py", "simulations/models/color.py"],
)
def test_what_would_hide_a_part_of_the_engine_is_refused(
    path: str, engine: Engine, tmp_path: Path
) -> None:
    (tmp_path / path).parent.mkdir(parents=True)
    (tmp_path / path).touch()
    done = engine.run(tmp_path, "-m", "site_builder", "check")
    assert done.returncode == 1
    assert "hides the engine's part of simulations; legal: " in done.stderr


@pytest.mark.browser
def test_its_figures_live(waves_site: Path, waves_book: Any, brisk_chromium: Browser) -> None:
    with serving(waves_site) as server, visit(brisk_chromium, server) as reader:
        figure = reader.open_figure(waves_book, "standing-waves")
        before = reader.frames(figure)
        figure.locator("input[name=number]").fill("5")
        reader.wait_frame(figure, before)
        assert (figure.locator("output[name=still]").text_content() or "").startswith("6")
        reader.turn_to_figure(waves_book, "leakage")
        reader.assert_no_complaints()


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
def test_a_press_plays_its_samples_and_a_moved_control_changes_them(
    waves_site: Path, waves_book: Any, brisk_chromium: Browser
) -> None:
    with serving(waves_site) as server, visit(brisk_chromium, server, LISTEN) as reader:
        figure = reader.open_figure(waves_book, "standing-waves")
        button = figure.locator("[data-play-sound]")
        assert reader.page.evaluate("heard") == []
        button.click()
        reader.page.wait_for_function("heard.length === 1")
        expect(button).to_have_text("Stop the sound")
        figure.locator("input[name=number]").fill("5")
        reader.page.wait_for_function("heard.length === 2")
        first, second = reader.page.evaluate("heard")
        assert (first["length"], first["rate"], first["offset"]) == (44_100, 22_050, 0)
        assert 0.4 < first["peak"] <= 0.5
        assert second["offset"] > 0, "goes on where the first was"
        reader.uncover(figure)
        before = reader.frames(figure)
        figure.locator("input[name=phase]").fill("0.5")
        reader.wait_frame(figure, before)
        button.click()
        expect(button).to_have_text("Play the sound")
        assert len(reader.page.evaluate("heard")) == 2, "the same samples are not begun again"
        reader.assert_no_complaints()
