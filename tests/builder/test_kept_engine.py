"""An edited file of the engine makes anew what depends on it and nothing else: whole builds, each
by a process of its own, as it were."""

import ast
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from support.small_package import PACKAGE, small_package

from simulations.engine.scene import Scene
from site_builder.book_root import ENGINE, ENGINE_PARTS
from site_builder.build import Options, render_site
from site_builder.kept import code
from site_builder.kept.keeper import Keeper, keeping
from site_builder.languages import words
from site_builder.output.assets import Content, content_bytes

SCENE = '''\
from dataclasses import dataclass

from simulations.engine.{room} import {name}
from simulations.engine.frame import Frame, Panel
from simulations.engine.scene import Scene
from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    size: float = slider("Size", 20, 1, 90, 1)


def draw(settings, _outputs):
    """One mark."""
    mark = {mark}
    return Frame((Panel("plan", "Plan", 400, 300, overlay=mark),), (), f"Size {{settings.size:g}}.")


SCENE = Scene("{id}", "A mark", Settings, draw)
'''
LINED = SCENE.format(
    room="drawing", name="line", mark="line((0, 0), (settings.size, 9))", id="lined"
)
ARCHED = SCENE.format(
    room="drafting", name="arc", mark="arc((99, 99), settings.size, 0, 2)", id="arched"
)
CHAPTER = """\
---
title: Chapter {id}
summary: It has a figure.
---

:::{{simulation}} {id}
A mark.
:::

```python
x = 1
```
"""
OUTLINE = """\
title = "Two Marks"
subtitle = "A book for tests."
prerequisites = "None."
chapters = ["00-first", "01-second"]
"""


def named(package: Path) -> dict[str, Path]:
    """Every file of a package by the full name of its module."""
    files = sorted(package.rglob("*.py"))
    names = [file.relative_to(package.parent).with_suffix("").parts for file in files]
    return {".".join(n).removesuffix(".__init__"): f for n, f in zip(names, files, strict=True)}


@dataclass(slots=True)
class Shelf:
    """A store in memory."""

    entries: dict[bytes, bytes] = field(default_factory=dict)

    def get(self, key: bytes) -> bytes | None:
        return self.entries.get(key)

    def put(self, entries: Mapping[bytes, bytes]) -> None:
        self.entries.update(entries)

    def reopened(self) -> "Shelf":
        return self


def bytes_of(files: Mapping[str, Content]) -> dict[str, bytes]:
    return {name: content_bytes(content) for name, content in files.items()}


@dataclass(frozen=True, slots=True)
class Workshop:
    """A book, and a copy of the engine whose files are hashed in the place of those that run."""

    book: Options
    engine: Path
    shelf: Shelf

    def build(self) -> tuple[Counter[str], Mapping[str, bytes]]:
        """How often each kept function ran, and the site."""
        keeper = Keeper(self.shelf)
        with keeping(keeper):
            files = bytes_of(render_site(self.book))
        return Counter(keeper.made), files

    def build_clean(self) -> Mapping[str, bytes]:
        return bytes_of(render_site(self.book))

    def replace(self, path: str, old: str, new: str) -> None:
        """In a file of the engine; a new process reads the words anew."""
        file = self.engine / path
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new), encoding="utf-8")
        words.load_words.cache_clear()

    def append(self, path: str, text: str) -> None:
        with (self.engine / path).open("a", encoding="utf-8") as file:
            file.write(text)


@pytest.fixture
def workshop(
    make_book: Callable[..., Options], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Workshop]:
    engine = tmp_path / "engine"
    shutil.copytree(
        ENGINE / "site_builder",
        engine / "site_builder",
        ignore=shutil.ignore_patterns("__pycache__", "templates", "skeletons", "book"),
    )
    for file in (ENGINE / "simulations").rglob("*.py"):
        path = file.relative_to(ENGINE)
        if path.parts[1].removesuffix(".py") in (*ENGINE_PARTS, "__init__"):
            (engine / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, engine / path)
    root = code._root
    monkeypatch.setattr(code, "ENGINE", engine)
    monkeypatch.setattr(
        code, "_root", lambda name: engine if (engine / name).is_dir() and name else root(name)
    )
    monkeypatch.setattr(words, "HERE", engine / "site_builder" / "languages")
    words.load_words.cache_clear()

    def load(scene_id: str) -> Scene[Any]:
        found: Scene[Any] = import_module(f"{PACKAGE}.{scene_id}").SCENE
        return found

    chapters = {"00-first": "lined", "01-second": "arched"}
    texts = {f"content/{name}.md": CHAPTER.format(id=scene) for name, scene in chapters.items()}
    book = make_book(files={"content/book.toml": OUTLINE, **texts})
    with small_package(engine / "simulations", {"lined": LINED, "arched": ARCHED}):
        yield Workshop(replace(book, load_scene=load), engine, Shelf())
    words.load_words.cache_clear()


@cache
def imports() -> Mapping[str, frozenset[str]]:
    """Each module of the engine to those that it imports, the packages around it among them."""
    files = named(ENGINE / "site_builder") | named(ENGINE / "simulations")
    return {
        name: frozenset({*mentioned(file), name.rpartition(".")[0]} & files.keys())
        for name, file in files.items()
    }


def mentioned(file: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def reach(module: str) -> set[str]:
    """The module and all that it imports, however indirectly."""
    found: set[str] = set()
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += imports()[name]
    return found


def dependants(ran: Counter[str], module: str) -> set[str]:
    """Those of the functions whose modules import it, however indirectly."""
    return {name for name in ran if module in reach(home(name))}


def home(function: str) -> str:
    """Its module; its own name may have dots."""
    parts = function.split(".")
    names = (".".join(parts[:n]) for n in range(len(parts), 0, -1))
    return next(name for name in names if name in imports())


@pytest.mark.parametrize(
    "module",
    [
        "site_builder.markdown.text.code",
        "site_builder.charts.axes",
        "site_builder.checks.svg",
        "simulations.engine.plotting.plot",
    ],
)
def test_an_edited_module_makes_anew_what_imports_it_and_nothing_else(
    workshop: Workshop, module: str
) -> None:
    first, before = workshop.build()
    workshop.append(module.replace(".", "/") + ".py", "\n# edited\n")
    again, after = workshop.build()
    assert set(again) == dependants(first, module)
    assert after == before


def test_an_edited_module_of_figures_draws_those_anew_that_import_it(workshop: Workshop) -> None:
    workshop.build()
    workshop.append("simulations/engine/drafting.py", "\n# edited\n")
    again, _ = workshop.build()
    assert again == {
        "site_builder.drawing.frames.print_at": 1,
        "site_builder.chapters.read": 1,
        "site_builder.pages.render.page": 1,
    }


def test_an_edited_word_of_the_interface_is_in_every_page_and_draws_no_figure(
    workshop: Workshop,
) -> None:
    _, before = workshop.build()
    workshop.replace("site_builder/languages/en.toml", "Skip to the text", "Jump to the text")
    again, after = workshop.build()
    old, new = (
        {name for name, data in site.items() if word in data and name.endswith(".html")}
        for site, word in ((before, b"Skip to the text"), (after, b"Jump to the text"))
    )
    assert len(new) > 2
    assert new == old
    assert again["site_builder.drawing.frames.print_at"] == 0
    assert after == workshop.build_clean()


def test_an_edited_word_of_another_language_makes_nothing_anew(workshop: Workshop) -> None:
    workshop.build()
    workshop.replace("site_builder/languages/de.toml", "Zum Text", "Weiter zum Text")
    assert workshop.build()[0].total() == 0
