"""Chapters as notebooks: nothing of the prose is lost, and figures are cells."""

import re
from base64 import b64decode
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import nbformat
import pytest
from support.little_book import files_of

from site_builder.build import Options, check_site
from site_builder.editions.notebooks.blocks import PARTS
from site_builder.editions.notebooks.folder import make_notebooks
from site_builder.markdown.directives import DIRECTIVES
from site_builder.output.assets import content_bytes

SITE = "https://host/book/"
SOME_OF_ALL = """
::::{note} Aside
First words.

:::{source} simulations.models.thing:Doubler.apply
Quoted.
:::

Last words.
::::

:::{predict} how-many
How many?
- [ ] Seven
  : Count again.
- [x] Nine
  : That is all.
:::

:::{answer} how-many
There are nine.
:::

:::{simulation} demo
:k1: 0.25
:kind: b
:tier: fast
Pull it.

More of it.
:::
"""


@pytest.fixture
def cells(make_book: Callable[..., Options]) -> Callable[..., list[Any]]:
    """Those of the first chapter."""

    def make(body: str, address: str = "") -> list[Any]:
        options = replace(make_book(body), address=address)
        files = make_notebooks(check_site(options), options.root)
        notebook = nbformat.reads(content_bytes(files["first.ipynb"]).decode(), as_version=4)
        return list(notebook.cells)

    return make


def sources(cells: list[Any], kind: str) -> list[str]:
    return [cell.source for cell in cells if cell.cell_type == kind]


def test_every_directive_has_its_cells() -> None:
    assert {directive.template for directive in DIRECTIVES} | {"prose"} == set(PARTS)


def test_figures_and_quoted_code_are_cells_to_run(cells: Callable[..., list[Any]]) -> None:
    assert sources(cells(SOME_OF_ALL), "code") == [
        "from simulations.notebook.live import figure",
        "from simulations.models.thing import Doubler",
        'figure("demo", tier="fast", k1=0.25, kind="b")',
    ]


def test_words_around_code_are_quoted_and_answers_are_folded(
    cells: Callable[..., list[Any]],
) -> None:
    words = "\n\n".join(sources(cells(SOME_OF_ALL), "markdown"))
    assert "> **Aside**\n>\n> First words." in words
    assert "> Last words." in words
    right = "Nine  \n  That is all."
    assert f"Prediction 0.1: Answer</summary>\n\n{right}\n\nThere are nine.\n\n</details>" in words
    assert "**Figure 0.1** Pull it.\n\nMore of it." in words


def test_a_figure_shows_its_frame_before_it_is_run(cells: Callable[..., list[Any]]) -> None:
    (figure,) = (cell for cell in cells(SOME_OF_ALL) if cell.source.startswith('figure("demo"'))
    (output,) = figure.outputs
    assert output.data["text/plain"] == "Shows k1 of 0.25 in tier fast."
    assert b64decode(output.data["image/png"]).startswith(b"\x89PNG")


def test_every_kind_of_question_has_its_answers_in_a_fold(
    cells: Callable[..., list[Any]],
) -> None:
    asked = [
        text
        for text in sources(
            cells(files_of("questions")["text.md"].replace(r"$\half$", "the start")), "markdown"
        )
        if "<details>" in text
    ]
    shown = [text.partition("<details>")[0] for text in asked]
    folds = [
        "\n".join(re.findall(r"^(?:- |\d|  ).*", text.partition("<details>")[2], re.M))
        for text in asked
    ]
    assert [len(re.findall(r"^- [A-Z]:", text, re.M)) for text in shown] == [2, 3, 0, 3, 0]
    assert "**Wrong:** Here" in folds[0]
    assert "  Yes, as *always*" in folds[0]
    assert "**Wrong:** otherwise" in folds[2]
    assert "3. Three" in folds[3]
    assert "k1 0.25" in folds[4] or "Distortion 0.25" in folds[4]


@pytest.mark.parametrize(("address", "link"), [("", ""), (SITE, f"]({SITE}second/)")])
def test_references_lead_to_the_site_where_it_has_an_address(
    cells: Callable[..., list[Any]], address: str, link: str
) -> None:
    (text,) = (
        text
        for text in sources(cells(files_of("paper")["text.md"], address), "markdown")
        if "## Here" in text
    )
    assert text.startswith("## Here\n\nSee ")
    assert (link in text) if link else "](" not in text


def test_a_recording_lies_beside_its_notebook_and_its_transcript_is_folded(
    make_book: Callable[..., Options],
) -> None:
    body = ":::{audio} sounds/a tone.wav\n:title: A tone\n:licence: Mine\nIt *hums*.\n:::\n"
    options = make_book(body, {"content/sounds/a tone.wav": "RIFF"})
    files = make_notebooks(check_site(options), options.root)
    assert content_bytes(files["content/sounds/a tone.wav"]) == b"RIFF"
    (_, cell) = nbformat.reads(content_bytes(files["first.ipynb"]).decode(), as_version=4).cells
    assert cell.source.startswith('<audio controls src="content/sounds/a%20tone.wav"></audio>')
    assert "**Figure 0.1** A tone (Mine)" in cell.source
    assert "<details>\n<summary>What is heard, in words</summary>\n\nIt *hums*." in cell.source


def test_only_a_folder_of_notebooks_is_replaced(run: Callable[..., int], tmp_path: Path) -> None:
    out, full = tmp_path / "out", tmp_path / "full"
    full.mkdir()
    (full / "thesis.txt").touch()
    assert [run("notebooks", "--out", str(folder)) for folder in (out, out, full)] == [0, 0, 1]
    assert (out / "first.ipynb").is_file()
    assert [file.name for file in full.iterdir()] == ["thesis.txt"]
