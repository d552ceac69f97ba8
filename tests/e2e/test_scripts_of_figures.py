"""*Copy as Python*: a script that says, without the book, what the figure says."""

import ast
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page
from support.reader import Reader

from simulations.script import script

pytestmark = pytest.mark.browser
ROOT = Path(__file__).resolve().parents[2]

FIGURES = """() => [...document.querySelectorAll('simulation-figure')].map((figure) => ({
  id: figure.closest('figure').id,
  scene: figure.dataset.simulation,
  schema: JSON.parse(figure.querySelector('script.schema').textContent),
  says: [...figure.querySelectorAll('.readout')].map((box) => [
    box.querySelector('.readout-label').textContent,
    box.querySelector('output').textContent,
    box.querySelector('.unit').textContent,
  ]),
}))"""

RUN_ALL = """
import runpy, sys
sys.path.insert(0, sys.argv[1])
for file in sys.argv[2:]:
    runpy.run_path(file)
    print("\\f", end="")
"""


def run_elsewhere(folder: Path, scripts: list[str]) -> list[str]:
    """What each script prints, in a folder that has nothing of the book."""
    files = [folder / f"{number}.py" for number in range(len(scripts))]
    for file, text in zip(files, scripts, strict=True):
        file.write_text(text, encoding="utf-8")
    command = [sys.executable, "-I", "-X", "utf8", "-c", RUN_ALL, str(ROOT), *map(str, files)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout.split("\f")[:-1]


def says(rows: list[list[str]]) -> str:
    return "".join(f"{label}: {text} {unit}".rstrip() + "\n" for label, text, unit in rows)


def lines(text: str) -> list[str]:
    """In one order: a page shows first the readouts that are not folded."""
    return sorted(text.splitlines())


@pytest.mark.deep
def test_the_script_of_every_figure_prints_the_numbers_of_its_page(
    plain_reader: Reader, book: Any, tmp_path: Path
) -> None:
    figures: list[dict[str, Any]] = []
    for _ in plain_reader.leaf_through(["", *(chapter["url"] for chapter in book["chapters"])]):
        figures += plain_reader.page.evaluate(FIGURES)
    assert {figure["scene"] for figure in figures} == {s["id"] for s in book["simulations"]}
    scripts = [
        script(
            figure["scene"],
            json.dumps(figure["schema"]["values"]),
            figure["schema"]["default_tier"],
            "[]",
        )
        for figure in figures
    ]
    printed = run_elsewhere(tmp_path, scripts)
    shown = [says(figure["says"]) for figure in figures]
    assert [lines(text) for text in printed] == [lines(text) for text in shown]


def test_a_script_begins_with_what_it_is_told_and_is_the_same_otherwise() -> None:
    plain, noted = (
        ast.parse(script("camera", "{}", "", json.dumps(["Camera.", *more])))
        for more in ([], ["It ran other Python."])
    )
    assert ast.get_docstring(plain) == "Camera."
    assert ast.get_docstring(noted) == "Camera.\n\nIt ran other Python."
    assert [ast.dump(part) for part in plain.body[1:]] == [ast.dump(p) for p in noted.body[1:]]


def test_the_script_that_is_copied_prints_what_the_figure_shows_now(
    visitor: Reader, tmp_path: Path
) -> None:
    visitor.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    visitor.turn_to_unlinked(
        "lens-distortion/?figure-lens-distortion.k1=-0.31&figure-lens-distortion.k2=0.07"
    )
    figure = visitor.figure("lens-distortion")
    figure.locator(".share > summary").click()
    figure.locator("[data-copy-python]").click()
    figure.locator(".tools-said", has_text="copied").wait_for()
    shown = next(
        each for each in visitor.page.evaluate(FIGURES) if each["id"] == "figure-lens-distortion"
    )
    assert run_elsewhere(tmp_path, [copied(visitor.page)]) == [says(shown["says"])]


def copied(page: Page) -> str:
    return str(page.evaluate("navigator.clipboard.readText()"))
