"""A small book in a temporary folder, with one small scene, so that no test needs the real one."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support.little_book import FRONT, load_demo

from site_builder import site_assets
from site_builder.build import Options
from site_builder.output.assets import Content, content_bytes
from site_builder.output.scripts import Bundle
from site_builder.search.index import SHARED

STATIC = Path(__file__).parents[2] / "static"
ICON = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h7v7z"/></svg>\n'
OUTLINE = """\
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


@pytest.fixture(autouse=True)
def bundled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Scripts are bundled as they are, which takes no time."""

    def as_written(sources: Mapping[str, Content], *entries: str) -> Bundle:
        scripts = {name: content_bytes(sources[name]) for name in entries}
        return Bundle({f"{name[:-3]}.js": text for name, text in scripts.items()}, (), frozenset())

    monkeypatch.setattr(site_assets, "bundle_scripts", as_written)


@pytest.fixture
def make_book(tmp_path: Path) -> MakeBook:
    """Writes a book whose first chapter is ``body``; other files by path override the defaults."""

    def make(body: str = "Text.\n", files: dict[str, str | None] | None = None) -> Options:
        sources: dict[str, str | None] = {
            "content/book.toml": OUTLINE,
            "content/00-first.md": FRONT + body,
            "content/01-second.md": SECOND,
            "simulations/models/thing.py": THING,
            "static/css/book.css": "body {}\n",
            "static/js/main.ts": "export {};\n",
            **{f"static/{name}": (STATIC / name).read_text(encoding="utf-8") for name in SHARED},
            "static/images/favicon.svg": ICON,
            "content/images/plan.svg": '<svg xmlns="http://www.w3.org/2000/svg"/>\n',
            **(files or {}),
        }
        for path, content in sources.items():
            if content is not None:
                (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
                (tmp_path / path).write_text(content, encoding="utf-8")
        return Options(tmp_path, runtime=False, search=False, load_scene=load_demo)

    return make


@pytest.fixture
def run(make_book: MakeBook, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """The command on a small book whose first chapter is ``body``; it shows no figure."""
    from site_builder.__main__ import main

    outline = "".join(line for line in OUTLINE.splitlines(True) if not line.startswith("hero"))

    def command(*words: str, body: str = "Text.\n") -> int:
        options = make_book(body, {"content/book.toml": outline})
        monkeypatch.setattr("site_builder.__main__.ROOT", options.root)
        return main(list(words))

    return command
