"""Editions as readers get them: notebooks, run in their folder, show the pictures of the site; an
e-book passes EPUBCheck."""

import io
import re
import shutil
import sys
import zipfile
from base64 import b64decode
from pathlib import Path
from xml.etree import ElementTree

import nbformat
import pytest
from nbclient import NotebookClient
from nbformat import NotebookNode, v4
from support.engine import Engine, built_once, run
from support.places import GERMAN_BOOK, ROOT
from support.printed_figures import pages_of_figures
from support.qti import illegal_parts

from simulations.engine.frame import Raster
from site_builder.build import Options, load
from site_builder.cache.results import Cache, using
from site_builder.editions.questions import make_qti
from site_builder.figures.frames import pixels
from site_builder.pool.processes import using_pool

STATES = "application/vnd.jupyter.widget-state+json"
OVERLAY = re.compile(r'<(?:svg|g) class="overlay[^"]*"[^>]*>(.*?)(?:</g>)?</svg>', re.DOTALL)
MOVE = """
shown = figure("saite")
shown.widgets["number"].value = 4
print(shown.frame.description)
"""
FENCE = re.compile(r"^```\w+\n((?:.*\n)*?def (\w+)\((?:.*\n)*?)```$", re.MULTILINE)
DEFINED = re.compile(r"^def (\w+)\(", re.MULTILINE)
QUICK = ("02", "06")
"""Chapters whose notebooks every run of the suite executes."""
PACKED = b"PK"
"""The first bytes of a Java archive, which Debian's command is."""
MISSING = "epubcheck is not installed; `apt-get install epubcheck` installs it, with Java"


def executed(file: Path, *more: str) -> NotebookNode:
    """The notebook with its solutions below what each exercise starts with and ``more`` cells at
    its end, run by a kernel in its folder."""
    notebook: NotebookNode = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    solutions = {
        name: code
        for cell in notebook.cells
        for code, name in FENCE.findall(cell.source if cell.cell_type == "markdown" else "")
    }
    for cell in notebook.cells:
        if cell.cell_type == "code" and (begun := DEFINED.search(cell.source)):
            cell.source += solutions.get(begun[1], "")
    notebook.cells += [v4.new_code_cell(source) for source in more]
    resources = {"metadata": {"path": str(file.parent)}}
    run = NotebookClient(notebook, timeout=300, resources=resources, force_raise_errors=True)
    run.execute()
    return notebook


def drawings(notebook: NotebookNode) -> list[str]:
    """The SVG of all panels, in any order."""
    widgets = notebook.metadata.get("widgets", {STATES: {"state": {}}})[STATES]["state"].values()
    shown = (each for each in widgets if each["model_name"] == "ImageModel")
    return [b64decode(each["buffers"][0]["data"]).decode() for each in shown]


def overlays(markup: str) -> list[str]:
    return [" ".join(drawn.split()) for drawn in OVERLAY.findall(markup)]


def rasters(svg: str) -> list[Raster]:
    images = ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}image")
    return [pixels(b64decode(image.get("href", "").partition(",")[2])) for image in images]


def identity(raster: Raster) -> tuple[tuple[int, ...], bytes]:
    return raster.shape, raster.tobytes()


def test_notebooks_of_another_book_run_from_their_folder_alone(
    engine: Engine, site: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    done = engine.run(GERMAN_BOOK, "-m", "site_builder", "notebooks", "--out", str(out))
    assert done.returncode == 0, done.stderr
    notebook = executed(out / "die-saite.ipynb", MOVE)
    page = (site / "die-saite" / "index.html").read_text(encoding="utf-8")
    shown = {overlay for svg in drawings(notebook) for overlay in overlays(svg)}
    still = set(overlays(page)[:1])
    assert still < shown
    assert len(shown - still) == 1, "the panel of the figure that was moved"
    assert notebook.cells[-1].outputs[0].text == "Eine Saite in 4 gleichen Teilen.\n"


@pytest.fixture(scope="session")
def notebooks(built_site: Path, tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """This book's."""
    assert built_site.is_dir(), "what it has computed is cached"
    command = (sys.executable, "-m", "site_builder", "notebooks", "--out")
    return built_once(
        tmp_path_factory, worker_id, "notebooks", lambda out: run(ROOT, *command, str(out))
    )


@pytest.mark.parametrize(
    "chapter",
    [
        pytest.param(file.stem[3:], marks=() if file.stem[:2] in QUICK else pytest.mark.deep)
        for file in sorted((ROOT / "content").glob("[0-9]*.md"))
    ],
)
def test_notebooks_of_this_book_run_and_show_the_sites_pictures(
    notebooks: Path, built_site: Path, chapter: str
) -> None:
    shown = {
        identity(each)
        for svg in drawings(executed(notebooks / f"{chapter}.ipynb"))
        for each in rasters(svg)
    }
    stills = built_site.glob(f"assets/*/stills/{chapter}--*.webp")
    assert shown == {identity(pixels(still.read_bytes())) for still in stills}


def test_questions_of_this_book_are_legal_in_qti(built_site: Path) -> None:
    assert built_site.is_dir(), "what it has computed is cached"
    with using(Cache()), using_pool():
        loaded = load(Options(root=ROOT, address="https://host/book/"))
    archive = zipfile.ZipFile(io.BytesIO(make_qti(loaded.book)))
    assert not illegal_parts({name: archive.read(name).decode() for name in archive.namelist()})


@pytest.mark.deep
@pytest.mark.parametrize("book", [ROOT, GERMAN_BOOK], ids=lambda book: book.name)
def test_epubcheck_finds_no_errors_or_warnings_in_an_e_book(
    engine: Engine, tmp_path: Path, book: Path
) -> None:
    """EPUBCheck is the W3C's checker."""
    checker = shutil.which("epubcheck")
    assert checker, MISSING
    out = tmp_path / "book.epub"
    python = sys.executable if book == ROOT else engine.python
    made = run(book, python, "-m", "site_builder", "epub", "--out", str(out))
    assert made.returncode == 0, made.stderr
    java = ("java", "-jar") if Path(checker).read_bytes().startswith(PACKED) else ()
    done = run(tmp_path, *java, checker, "--failonwarnings", str(out))
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.deep
@pytest.mark.browser
def test_no_figure_of_the_pdf_is_torn(tmp_path: Path) -> None:
    out = tmp_path / "book.pdf"
    done = run(ROOT, sys.executable, "-m", "site_builder", "pdf", "--out", str(out))
    assert done.returncode == 0, done.stderr
    pages = pages_of_figures(out)
    assert len(pages) > 90
    assert all(len(each) == 1 for each in pages)
