"""Notebooks as readers have them: started in their folder, run without a window, they show what the
site shows."""

import re
import sys
from base64 import b64decode
from pathlib import Path
from xml.etree import ElementTree

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat import NotebookNode, v4
from support.engine import Engine, run
from support.places import ROOT, WAVES

from simulations.engine.frame import Raster
from site_builder.figures.frames import pixels

STATES = "application/vnd.jupyter.widget-state+json"
OVERLAY = re.compile(r'<(?:svg|g) class="overlay"[^>]*>(.*?)(?:</g>)?</svg>', re.DOTALL)
MOVE = """
shown = figure("leakage")
shown.widgets["cycles"].value = 10
print(shown.frame.description)
"""


def executed(file: Path, *more: str) -> NotebookNode:
    """The notebook with ``more`` cells at its end, run by a kernel in its folder."""
    notebook: NotebookNode = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    notebook.cells += [v4.new_code_cell(source) for source in more]
    resources = {"metadata": {"path": str(file.parent)}}
    NotebookClient(notebook, timeout=300, resources=resources).execute()
    return notebook


def drawings(notebook: NotebookNode) -> list[str]:
    """The SVG of all panels, in any order."""
    widgets = notebook.metadata.get("widgets", {STATES: {"state": {}}})[STATES]["state"].values()
    shown = (each for each in widgets if each["model_name"] == "ImageModel")
    return [b64decode(each["buffers"][0]["data"]).decode() for each in shown]


def rasters(svg: str) -> list[Raster]:
    images = ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}image")
    return [pixels(b64decode(image.get("href", "").partition(",")[2])) for image in images]


def identity(raster: Raster) -> tuple[tuple[int, ...], bytes]:
    return raster.shape, raster.tobytes()


def test_figures_of_another_book_run_from_its_folder_of_notebooks_alone(
    engine: Engine, waves_site: Path, tmp_path: Path
) -> None:
    done = engine.run(WAVES, "-m", "site_builder", "notebooks", "--out", str(tmp_path / "out"))
    assert done.returncode == 0, done.stderr
    notebook = executed(tmp_path / "out" / "spectra.ipynb", MOVE)
    page = (waves_site / "spectra" / "index.html").read_text(encoding="utf-8")
    shown = {overlay for svg in drawings(notebook) for overlay in overlays(svg)}
    still = set(overlays(page)[:2])
    assert still < shown
    assert len(shown - still) == 2, "the panels of the figure that was moved"
    assert "A tone of 10.00 cycles" in notebook.cells[-1].outputs[0].text


def overlays(markup: str) -> list[str]:
    return [" ".join(drawn.split()) for drawn in OVERLAY.findall(markup)]


@pytest.mark.deep
def test_every_notebook_of_this_book_runs_and_has_the_pictures_of_the_site(
    built_site: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    done = run(ROOT, sys.executable, "-m", "site_builder", "notebooks", "--out", str(out))
    assert done.returncode == 0, done.stderr
    for file in sorted(out.glob("*.ipynb")):
        shown = {identity(each) for svg in drawings(executed(file)) for each in rasters(svg)}
        stills = built_site.glob(f"assets/*/stills/{file.stem}--*.webp")
        assert shown == {identity(pixels(still.read_bytes())) for still in stills}, file.stem
