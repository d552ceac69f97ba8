"""A build that keeps results makes what a clean one makes, and no more than has changed."""

import json
import shutil
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from simulations.engine.scene import Scene
from simulations.registry import load_scene
from site_builder.benchmarks.measurements import DATA as MEASUREMENTS
from site_builder.build import Options, render_site
from site_builder.diagnostics import BuildError
from site_builder.kept import ahead
from site_builder.kept.keeper import Keeper, keeping
from site_builder.output.assets import content_bytes
from site_builder.pages import render

ROOT = Path(__file__).parents[2]

OUTLINE = """\
title = "Small Book"
subtitle = "A book for tests."
prerequisites = "None."
chapters = ["00-first", "01-second", "02-third"]
"""
FIRST = """\
---
title: First
summary: The first chapter.
---

## A section

A pinhole is small {cite}`zhang2000`, as $x = 1$ is; the corner reads
{readout}`transform-2d area amount=40`.

:::{figure} images/plan.svg
:alt: A plan.
A plan.
:::
"""
SECOND = """\
---
title: Second
summary: The second chapter.
---

## Another

Text, and {ref}`a-section`; $y = 2$.

:::{simulation} transform-2d
:amount: 20
Move it.
:::
"""
THIRD = """\
---
title: Third
summary: The third chapter.
---

## Code

:::{source} simulations.models.thing:double
Twice.
:::

```python
x = 1
```
"""
REFERENCES = """\
@article{zhang2000,
  author = {Zhang, Zhengyou}, title = {A flexible technique}, journal = {PAMI}, year = {2000},
}
"""
GLOSSARY = '["pinhole"]\nsays = "A small hole."\nexplained = "first#a-section"\n'
FILES = {
    "content/book.toml": OUTLINE,
    "content/00-first.md": FIRST,
    "content/01-second.md": SECOND,
    "content/02-third.md": THIRD,
    "content/references.bib": REFERENCES,
    "content/glossary.toml": GLOSSARY,
}
type Bake = Callable[[], tuple[Mapping[str, bytes] | str, Counter[str]]]


def built(options: Options) -> Mapping[str, bytes] | str:
    """The files of the site, or its mistakes."""
    try:
        files = render_site(options)
    except BuildError as error:
        return str(error)
    return {name: content_bytes(content) for name, content in files.items()}


@pytest.fixture
def book(make_book: Callable[..., Options]) -> Options:
    def load(scene_id: str) -> Scene[Any]:
        return load_scene(scene_id)

    return replace(make_book(files=FILES), load_scene=load)


@pytest.fixture
def templates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The engine's, as a copy that can be edited."""
    copy = tmp_path / "templates"
    shutil.copytree(render.TEMPLATES, copy)
    monkeypatch.setattr(render, "TEMPLATES", copy)
    render._environment.cache_clear()
    yield copy
    render._environment.cache_clear()


@contextmanager
def incrementally(options: Options) -> Iterator[Bake]:
    """Builds with what earlier builds have made; says what ran anew."""
    keeper = Keeper()

    def bake() -> tuple[Mapping[str, bytes] | str, Counter[str]]:
        keeper.made.clear()
        with keeping(keeper):
            files = built(options)
        return files, Counter(name.rpartition(".")[2] for name in keeper.made)

    yield bake


def change(options: Options, path: str, old: str, new: str) -> None:
    file = options.root / path
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


EDGES = [
    ("content/01-second.md", "Text, and", "Words, and", {"survey": 1, "read": 1, "page": 1}),
    ("content/02-third.md", "x = 1", "x = 2", {"survey": 1, "read": 1, "page": 1}),
    ("content/images/plan.svg", "<svg", "<svg ", {"read": 1, "picture": 1}),
    ("content/02-third.md", "title: Third", "title: 3rd", {"survey": 1, "read": 3}),
    ("content/references.bib", "{2000}", "{2001}", {"read": 3}),
    ("content/glossary.toml", "A small", "A tiny", {"read": 3}),
    ("content/book.toml", "Small Book", "Large Book", {"read": 0, "survey": 0}),
    ("simulations/models/thing.py", "Twice", "Two times", {"read": 1, "declared": 1}),
    ("static/css/book.css", "{}", "{ }", {"read": 0, "survey": 0, "picture": 0}),
]


@pytest.mark.parametrize(("path", "old", "new", "again"), EDGES)
def test_what_has_changed_is_made_anew_and_no_more(
    book: Options, path: str, old: str, new: str, again: Mapping[str, int]
) -> None:
    with incrementally(book) as bake:
        bake()
        assert bake()[1].total() == 0
        change(book, path, old, new)
        files, made = bake()
        assert {name: made[name] for name in again} == again
        assert files == built(book)
        change(book, path, new, old)
        assert bake()[1].total() == 0


def test_an_edited_template_makes_the_pages_that_a_clean_build_makes(
    book: Options, templates: Path
) -> None:
    with incrementally(book) as bake:
        before, _ = bake()
        frame = templates / "base.html"
        text = frame.read_text(encoding="utf-8").replace("<main ", '<main data-edited="" ')
        frame.write_text(text, encoding="utf-8")
        after, made = bake()
        assert isinstance(before, dict)
        assert made["page"] == sum(name.endswith(".html") for name in before)
        assert after == built(book)
        assert after != before


def test_edited_measurements_change_the_numbers_that_a_clean_build_changes(book: Options) -> None:
    measured = json.loads((ROOT / MEASUREMENTS).read_text(encoding="utf-8"))
    file = book.root / MEASUREMENTS
    file.write_text(json.dumps(measured), encoding="utf-8")
    change(book, "content/02-third.md", "## Code", "## Code\n\n{measured}`precision float32 far`.")
    with incrementally(book) as bake:
        before, _ = bake()
        measured["ladders"]["precision"]["tiers"]["float32"]["errors"]["far"] *= 2
        file.write_text(json.dumps(measured), encoding="utf-8")
        after, _ = bake()
        assert isinstance(before, dict)
        assert isinstance(after, dict)
        assert after == built(book)
        page = "third/index.html"
        assert after[page] != before[page]


def test_one_word_of_a_chapter_changes_its_page_alone(book: Options) -> None:
    with incrementally(replace(book, reload=True)) as bake:
        before, _ = bake()
        change(book, "content/01-second.md", "Text, and", "Words, and")
        after, _ = bake()
        assert isinstance(before, dict)
        assert isinstance(after, dict)
        assert {name for name in after if after[name] != before[name]} == {"second/index.html"}


def test_a_style_sheet_changes_no_page_while_the_book_is_written(book: Options) -> None:
    with incrementally(replace(book, reload=True)) as bake:
        before, _ = bake()
        change(book, "static/css/book.css", "{}", "{ }")
        after, made = bake()
        assert isinstance(before, dict)
        assert isinstance(after, dict)
        changed = {name for name in after if after[name] != before[name]}
        assert (changed, made["page"]) == ({"assets/now/css/book.css"}, 0)


def test_mistakes_are_told_again_in_every_build(book: Options) -> None:
    with incrementally(book) as bake:
        bake()
        change(book, "content/01-second.md", "`a-section`", "`nowhere`")
        first, _ = bake()
        assert isinstance(first, str)
        assert "nowhere" in first
        assert bake()[0] == first
        change(book, "content/01-second.md", "`nowhere`", "`a-section`")
        assert isinstance(bake()[0], dict)


def test_warnings_are_told_again_in_every_build(book: Options) -> None:
    change(book, "content/02-third.md", "## Code", "## Code\n\nLater: {ref}`first`.")
    change(book, "content/00-first.md", "---\n\n##", "before:\n  - third: code\n---\n\n##")
    told: list[str] = []
    options = replace(book, warn=lambda warning: told.append(str(warning)))
    with incrementally(options) as bake:
        bake()
        once = list(told)
        bake()
    assert once
    assert told == once * 2


EDITS = [
    *((path, old, new) for path, old, new, _ in EDGES),
    ("content/00-first.md", "## A section", "## A section\n\n$$z = 3$$ (eq-z)"),
    ("content/00-first.md", "amount=40", "amount=41"),
    ("content/00-first.md", "plan.svg", "none.svg"),
    ("content/01-second.md", ":amount: 20", ":amount: 25"),
    ("content/01-second.md", "`a-section`", "`nowhere`"),
    ("content/01-second.md", "title: Second", "title: A pinhole"),
    ("content/02-third.md", "thing:double", "thing:Doubler"),
    ("content/book.toml", '"01-second", "02-third"', '"02-third", "01-second"'),
    ("content/book.toml", ', "02-third"', ""),
]


@pytest.mark.long
@given(st.lists(st.sampled_from(EDITS), min_size=1, max_size=5))
@settings(max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_edits_one_after_the_other_give_what_a_clean_build_gives(
    book: Options, edits: list[tuple[str, str, str]]
) -> None:
    for path, text in FILES.items():
        (book.root / path).write_text(text, encoding="utf-8")
    with incrementally(book) as bake:
        bake()
        for path, old, new in edits:
            file = book.root / path
            text = file.read_text(encoding="utf-8")
            # The same edit again takes it back.
            text = text.replace(new, old) if new in text else text.replace(old, new)
            file.write_text(text, encoding="utf-8")
            assert bake()[0] == built(book)


def test_a_book_is_the_same_however_many_processes_make_it(
    book: Options, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for number in (1, 3):
        monkeypatch.setattr(ahead, "cores", lambda number=number: number)
        with keeping(Keeper()):
            found.append(built(book))
    assert found[0] == found[1]
    assert isinstance(found[0], Mapping)
