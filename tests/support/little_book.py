"""A little book with one scene, checked and rendered, and a package of modules beside it."""

import json
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from support.html_outline import outline, read_html
from support.ladders import toy_data, toy_ladder
from support.places import ROOT

import simulations
from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.drafting import picture
from simulations.engine.drawing import line, polygon, text
from simulations.engine.frame import Frame, Panel, matrix_readout, readout
from simulations.engine.illustration import Illustration, in_steps
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.registry import UnknownIdError
from site_builder.assets import page_assets as site_assets
from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.editions.compose import compose
from site_builder.editions.notebooks.notebook import make_notebooks
from site_builder.figures.initial_frames import describing
from site_builder.markdown.directives import measured, pictures
from site_builder.output.scripts import Bundle
from site_builder.output.writer import Content, content_bytes
from site_builder.search.index import SHARED, make_records

STATIC = ROOT / "static"
FIXTURES = ROOT / "tests" / "fixtures"
ICON = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h7v7z"/></svg>\n'
OUTLINE_WITH_FIGURE = """\
title = "Small Book"
subtitle = "A book for tests."
prerequisites = "None."
hero = "demo"
hero_caption = "The *demo*."
chapters = [
  "00-first",
  "01-second",
]
"""
"""``book.toml`` with a figure on the cover."""
OUTLINE = 'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first", "01-second"]\n'
"""``book.toml`` without a figure on the cover."""
FRONT = "---\ntitle: First\nsummary: The first chapter.\n---\n"


THING = '''\
def double(x):
    """Twice."""
    return 2 * x


class Doubler:
    def apply(self, x):
        return double(x)
'''
SECOND = "---\ntitle: Second\nsummary: The second chapter.\n---\n\n## A section\n\nText.\n"


type MakeBook = Callable[..., Options]


@contextmanager
def plain_scripts() -> Iterator[pytest.MonkeyPatch]:
    """Copy scripts instead of bundling them, which takes no time, and register an illustration and
    a table of hard cases."""

    def as_written(sources: Mapping[str, Content], *entries: str) -> Bundle:
        scripts = {name: content_bytes(sources[name]) for name in entries}
        return Bundle({f"{name[:-3]}.js": text for name, text in scripts.items()}, (), frozenset())

    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(site_assets, "bundle_scripts", as_written)
        monkeypatch.setitem(pictures.MODULES, "similar-triangles", __name__)
        monkeypatch.setitem(measured.FILES, "halves", FIXTURES / "hard_cases" / "halves.toml")
        yield monkeypatch


@pytest.fixture
def bundled() -> Iterator[pytest.MonkeyPatch]:
    with plain_scripts() as monkeypatch:
        yield monkeypatch


def write_book(
    root: Path, body: str = "Text.\n", files: Mapping[str, str | None] | None = None
) -> Options:
    """Write a book whose first chapter is ``body``; ``files`` by path override the defaults."""
    sources: dict[str, str | None] = {
        "content/book.toml": OUTLINE_WITH_FIGURE,
        "content/00-first.md": FRONT + body,
        "content/01-second.md": SECOND,
        "simulations/models/thing.py": THING,
        "static/css/book.css": "body {}\n",
        "static/js/main.ts": "export {};\n",
        **{f"static/{name}": (STATIC / name).read_text(encoding="utf-8") for name in SHARED},
        "static/images/favicon.svg": ICON,
        "content/images/plan.svg": '<svg xmlns="http://www.w3.org/2000/svg"/>\n',
        "content/measurements.json": json.dumps(toy_data(), indent=1),
        **(files or {}),
    }
    for path, content in sources.items():
        if content is not None:
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(content, encoding="utf-8")
    return Options(
        root=root, runtime=False, search=False, load_scene=load_demo, load_ladder=toy_ladder
    )


@pytest.fixture
def make_book(tmp_path: Path, bundled: pytest.MonkeyPatch) -> MakeBook:  # noqa: ARG001
    return partial(write_book, tmp_path)


def diagnostics(options: Options) -> list[Diagnostic]:
    """The warnings and errors of the book."""
    found: list[Diagnostic] = []
    try:
        check_site(replace(options, warn=found.append))
    except BuildError as error:
        found += error.diagnostics
    return found


def rendered(options: Options) -> dict[str, bytes]:
    """The files of the site."""
    return {path: content_bytes(content) for path, content in render_site(options).items()}


@dataclass(frozen=True, slots=True)
class Settings:
    k1: float = slider("Distortion", 0.0, -0.5, 0.5, 0.01, unit="px")
    kind: str = choice("Kind", {"a": "First", "b": "Second"})
    on: bool = toggle("On")
    play: int = action("Play", "Pause", drives="k1", effect="play")


def describe(k1: float, tier: str) -> str:
    return f"Shows k1 of {k1:g} in tier {tier}."


def draw_demo(settings: Settings, outputs: Outputs) -> Frame:
    raster = np.full((4, 6, 4), 255, np.uint8)
    return Frame(
        panels=(
            Panel("picture", "Picture", 400, 300, raster=raster, pixelated=True),
            Panel("plan", "Plan", 400, 300, overlay=line((0, 0), (10, 10)) + text((1, 1), "a<b")),
        ),
        readouts=(
            readout("k1", "k₁", settings.k1, "px", role="ray"),
            matrix_readout("H", "Matrix", [[1, 0], [0, 1]]),
        ),
        description=outputs["sentence"],
    )


DEMO = Scene(
    id="demo",
    title="Demo",
    settings=Settings,
    draw=draw_demo,
    stages=(Stage("sentence", describe),),
    accuracy=Accuracy(levels=tiers("fast", "exact", labels={"fast": "Fast", "exact": "Exact"})),
)


def draw() -> Illustration:
    """An illustration, registered as ``similar-triangles``."""
    drawn = in_steps(*([polygon([(0, 0), (size, 0), (0, size)])] for size in (30, 60)))
    dots = picture((70, 0), 60, 60, np.zeros((2, 2, 4), np.uint8))
    panel = Panel("plan", "Plan", 400, 300, overlay=drawn + dots)
    return Illustration((panel,), "One triangle has twice the sides of the other.")


def half_of(length: float) -> float:
    if length < 0:
        raise ValueError(f"length={length:g}; legal: 0 or more")
    return length / 2


def load_demo(scene_id: str) -> Scene[Settings]:
    if scene_id == "broken":
        raise ImportError("no module")
    if scene_id != "demo":
        raise UnknownIdError(f"unknown simulation {scene_id!r}; legal: demo")
    return DEMO


IMPORT = "from simulations.notebook.live import figure"
FIELDS = ("title", "introduced", "explains", "asked", "text", "figures", "questions")
"""The fields of a search record that are shown."""


def part_of(options: Options, part: str) -> str:
    """Outline of the first chapter below its head, or of another ``part``: a page of the site by
    address, or the chapter in print (``paper``), as a ``notebook``, or in the ``search``."""
    match part:
        case "paper":
            printed = ElementTree.tostring(compose(options).sections[0].article)
            return outline(read_html(printed).elements[0])
        case "notebook":
            files = make_notebooks(check_site(options), options.root)
            cells = json.loads(content_bytes(files["first.ipynb"]))["cells"]
            _, *sources = ["".join(cell["source"]) for cell in cells]
            begin = sources.index(IMPORT) if IMPORT in sources else 0
            return "\n\n".join(sources[begin:]) + "\n"
        case "search":
            book, frames, _ = check_site(options)
            records, *_ = make_records(book, describing(frames))
            return "".join(
                f"{record.address}\n"
                + "".join(
                    f"  {name}: {found}\n" for name in FIELDS if (found := getattr(record, name))
                )
                for record in records
            )
    page = read_html(rendered(options)[f"{part or 'first'}/index.html"])
    (article,) = page.all("article") or page.all("main")
    return outline(article)


PACKAGE = "simulations.small"


@contextmanager
def small_package(folder: Path, modules: Mapping[str, str]) -> Iterator[None]:
    """A package `simulations.small` of these sources, by module name, while the block runs."""
    package = folder / "simulations" / "small"
    package.mkdir(parents=True)
    for name, source in {"__init__": "", **modules}.items():
        (package / f"{name}.py").write_text(source, encoding="utf-8")
    sys.path.append(str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in [name for name in sys.modules if name.startswith(PACKAGE)]:
            del sys.modules[name]
        vars(simulations).pop("small", None)
