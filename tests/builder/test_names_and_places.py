"""File names that need escaping, side files of editors, and unusual places of a book or site."""

import errno
import html
import io
import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
from PIL import Image
from support.little_book import OUTLINE, MakeBook, diagnostics, load_demo
from support.places import ROOT

from simulations.engine.frame import Frame
from simulations.engine.stages import Outputs
from site_builder.build import render_site
from site_builder.editions.compose import compose
from site_builder.editions.epub import make_epub
from site_builder.output.writer import content_bytes, write_site

PICTURES = ("Fig #3.png", "50%.png", "a?b.PNG", "straße & co.JPG", "%41.jpeg")


def picture(name: str) -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (4, 3)).save(buffer, "PNG" if name.lower().endswith("png") else "JPEG")
    return buffer.getvalue()


def named_book(make_book: MakeBook, root: Path) -> MakeBook:
    for name in PICTURES:
        (root / "content").mkdir(exist_ok=True)
        (root / "content" / name).write_bytes(picture(name))
    shown = [f":::{{figure}} {name}\n:alt: A picture.\nA caption.\n:::\n" for name in PICTURES]
    return lambda **files: make_book("\n".join(shown), {"content/book.toml": OUTLINE, **files})


def test_links_lead_to_files_with_unusual_names(make_book: MakeBook, tmp_path: Path) -> None:
    options = named_book(make_book, tmp_path)()
    files = render_site(options)
    page = html.unescape(content_bytes(files["first/index.html"]).decode())
    found = [
        unquote(each) for each in re.findall(r'(?:src|href)="\.\./([^"#?]*/content/[^"]*)"', page)
    ]
    assert {each.rpartition("/")[2] for each in found} == {*PICTURES}
    assert {*found} <= {*files}
    assert not re.findall(r'(?:src|href)="[^"]*/content/[^"]*[ #?][^"]*"', page)
    with zipfile.ZipFile(io.BytesIO(make_epub(compose(options), tmp_path))) as book:
        assert len([name for name in book.namelist() if "/images/" in name]) == len(PICTURES)


def test_escape_sequences_and_line_breaks_in_file_names_are_not_printed(
    make_book: MakeBook,
) -> None:
    names = ("content/a\x1b[31m\nb.md:1: c.md", "content/img\x1b[2J\nz.svg")
    body = ":::{figure} other.png\n:alt: A.\nB.\n:::\n"
    for one in diagnostics(make_book(body, dict.fromkeys(names, "A."))):
        assert str(one).isprintable()


SIDE_FILES = {
    "content/._00-first.md": "\0",
    "content/.00-first.md.swp": "\0",
    "content/00-first.md~": "Old.",
    "content/#00-first.md#": "Old.",
    "simulations/models/.#thing.py": "no Python",
    "simulations/models/._thing.py": "\0",
    "simulations/scenes/.#demo.py": "no Python",
}


def test_side_files_of_editors_are_ignored(make_book: MakeBook) -> None:
    plain = render_site(make_book("Text.\n"))
    assert render_site(make_book("Text.\n", SIDE_FILES)) == plain


LONG = "a" * 300
TOO_LONG = [
    (f":::{{figure}} {LONG}.png\n:alt: A.\nB.\n:::\n", "unknown picture file"),
    (f"::::{{simulation}} demo\n:label: {LONG}\nA.\n::::\n", "legal: small letters"),
]


@pytest.mark.parametrize(("body", "message"), TOO_LONG)
def test_too_long_file_name_or_label_is_reported(
    body: str, message: str, make_book: MakeBook
) -> None:
    found = diagnostics(make_book(body, {"content/book.toml": OUTLINE}))
    assert [one.path for one in found if message in one.message] == ["content/00-first.md"]


def test_too_long_name_of_a_chapter_or_panel_is_reported(make_book: MakeBook) -> None:
    found = diagnostics(make_book("", {"content/book.toml": OUTLINE.replace("00-first", LONG)}))
    assert ("content/book.toml", 4) in {(one.path, one.line) for one in found}
    demo = load_demo("demo")

    def draw(settings: Any, outputs: Outputs) -> Frame:
        frame = demo.draw(settings, outputs)
        return replace(
            frame, panels=tuple(replace(each, name=each.name * 40) for each in frame.panels)
        )

    options = make_book("::::{simulation} demo\nA.\n::::\n", {"content/book.toml": OUTLINE})
    bent = replace(demo, draw=draw, handles=())
    found = diagnostics(replace(options, load_scene=lambda _id: bent))
    assert any("names a file" in one.message for one in found)


def test_braces_in_labels_of_numbered_elements_are_text(make_book: MakeBook) -> None:
    own = f'{OUTLINE}[labels]\nfigure = "Fig {{x}} {{% raw %}}"\n'
    files = render_site(make_book("::::{simulation} demo\nA.\n::::\n", {"content/book.toml": own}))
    assert b"Fig {x} {% raw %} 0.1" in content_bytes(files["first/index.html"])


def linked(folder: Path) -> Path:
    """A link to another folder."""
    (folder / "elsewhere").mkdir()
    (folder / "site").symlink_to(folder / "elsewhere")
    return folder / "site"


def mounted(folder: Path) -> Path:
    """A folder that cannot be renamed."""
    (folder / "mounted").mkdir()
    return folder / "mounted"


@pytest.mark.parametrize("place", [linked, mounted])
def test_site_folder_that_is_a_link_or_mount_point_is_rewritten(
    place: Callable[[Path], Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, rename = place(tmp_path), Path.rename

    def refuse(self: Path, target: Path) -> Path:
        if self.name == "mounted":
            raise OSError(errno.EBUSY, "Device or resource busy")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse)
    for number in range(3):
        files = {"book.json": b"{}", f"page-{number}/index.html": bytes([number])}
        write_site(files, out)
        there = {
            each.relative_to(out).as_posix(): each for each in out.rglob("*") if each.is_file()
        }
        assert {name: file.read_bytes() for name, file in there.items()} == files
    assert out.is_symlink() == (place is linked)


def test_scenes_are_found_though_the_book_is_not_on_the_python_path(tmp_path: Path) -> None:
    scenes = tmp_path / "simulations" / "scenes"
    scenes.mkdir(parents=True)
    for name in ("__init__", "own"):
        (scenes / f"{name}.py").touch()
    script = "import site_builder, simulations.registry as r; print(*r.SCENE_MODULES)"
    # The engine is found as if installed, not by the working folder.
    path = {"PYTHONSAFEPATH": "1", "PYTHONPATH": str(ROOT)}
    printed = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path, env={**os.environ, **path}, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert "own" in printed.split()
