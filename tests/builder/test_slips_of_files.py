"""Slips with files: their letters, their names, where they lie. None is silent, none ends in a
traceback, and none brings more mistakes with it than it is."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from simulations.engine.handles import Handle
from simulations.engine.scene import Scene
from site_builder.build import Options, check_site
from site_builder.diagnostics import BuildError

type MakeBook = Callable[..., Options]
type Files = Mapping[str, bytes | Callable[[Path], object] | None]

CHAPTER = "content/00-first.md"
FRONT = b"---\ntitle: First\nsummary: The first chapter.\n---\n"
OUTLINE = (
    b'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first", "01-second"]\n'
)
LEADS_OUT = {
    CHAPTER: FRONT + b":::{download} data/list.csv\nA list.\n:::\n",
    "content/data/list.csv": lambda file: file.symlink_to("/etc/hostname"),
}
LOOP = {
    CHAPTER: FRONT + b":::{download} data/x.csv\n:::\n",
    "content/data/x.csv": lambda file: file.symlink_to("x.csv"),
}
NAMED = "legal: 'NN-slug'"


@pytest.mark.parametrize(
    ("files", "told"),
    [
        (
            {CHAPTER: (FRONT + b"Text.\n").decode().encode("utf-16")},
            f"{CHAPTER}:1: UTF-16; legal: ",
        ),
        ({CHAPTER: FRONT + "Caf\xe9.\n".encode("latin-1")}, f"{CHAPTER}:5: byte 0xe9 is not UTF-8"),
        ({CHAPTER: FRONT + b"One.\n\nT\0wo.\n"}, f"{CHAPTER}:7: control character U+0000; legal: "),
        ({CHAPTER: FRONT + b"B\x07ell.\n"}, f"{CHAPTER}:5: control character U+0007; legal: "),
        ({CHAPTER: b""}, f"{CHAPTER}:1: no front matter; legal: "),
        ({CHAPTER: FRONT}, f"{CHAPTER}:1: no text; legal: some below the front matter"),
        (
            {CHAPTER: Path.mkdir},
            "content/book.toml:4: unknown chapter '00-first'; legal: 01-second",
        ),
        (LOOP, f"{CHAPTER}:5: unknown file 'data/x.csv'; legal: "),
        (LEADS_OUT, f"{CHAPTER}:5: file 'data/list.csv' leads out of content/; legal: "),
        ({"content/book.toml": OUTLINE.decode().encode("utf-16")}, "content/book.toml:1: UTF-16"),
        (
            {"content/book.toml": OUTLINE + b'title = "U"\n'},
            "content/book.toml:5: malformed TOML: ",
        ),
        (
            {
                CHAPTER: None,
                "content/00 first.md": FRONT + b"Text.\n",
                "content/book.toml": OUTLINE.replace(b"00-first", b"00 first"),
            },
            f"content/book.toml:4: chapter '00 first'; {NAMED}",
        ),
        (
            {
                CHAPTER: None,
                "content/00-First.md": FRONT + b"Text.\n",
                "content/book.toml": OUTLINE.replace(b"00-first", b"00-First"),
            },
            f"content/book.toml:4: chapter '00-First'; {NAMED}",
        ),
        (
            {
                "content/01-second.md": None,
                "content/book.toml": OUTLINE.replace(b"01-second", b"00-first"),
            },
            "content/book.toml:4: chapter '00-first' has the address first/, as chapter ",
        ),
        (
            {"content/measurements.json": b'{\n "machine": \n'},
            "content/measurements.json:3: malformed JSON: ",
        ),
    ],
)
def test_a_slip_of_files_is_told_at_its_place(make_book: MakeBook, files: Files, told: str) -> None:
    options = make_book(files={**dict.fromkeys(files), "content/book.toml": OUTLINE.decode()})
    for name, content in files.items():
        file = options.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, bytes):
            file.write_bytes(content)
        elif content:
            content(file)
    first, *_ = mistakes(options)
    assert first.startswith(told)


@pytest.mark.parametrize("mark", [b"\xef\xbb\xbf", b""])
@pytest.mark.parametrize("end", [b"\r\n", b"\n"])
def test_marks_and_line_ends_of_other_editors_are_no_mistake(
    make_book: MakeBook, mark: bytes, end: bytes
) -> None:
    options = make_book()
    text = FRONT + b"Text.\n\n- One\n\t- Two\n"
    (options.root / CHAPTER).write_bytes(mark + text.replace(b"\n", end))
    assert mistakes(options) == []


@pytest.mark.parametrize(
    ("handle", "told"),
    [
        ({"pull": lambda _settings, _place: None}, "handle 'h': pull gives None; legal: {'k1': …}"),
        ({"pull": lambda _settings, _place: {"z": 1}}, "handle 'h': a pull changes 'z'; legal: k1"),
        (
            {"at": lambda _settings, _outputs: "x"},
            "handle 'h': at gives 'x'; legal: (x, y) or None",
        ),
        ({"panel": "plans"}, "handle 'h': panel 'plans'; legal: picture, plan"),
    ],
)
def test_a_handle_that_would_fail_in_its_reader_s_hand_is_told_when_the_book_is_built(
    make_book: MakeBook, handle: Mapping[str, Any], told: str
) -> None:
    options = make_book("\n:::{simulation} demo\n:::\n")
    sound: Handle[Any] = Handle(
        "h", "plan", "H", ("k1",), lambda _s, _o: (1.0, 1.0), lambda _s, _p: {"k1": 0}
    )

    def load(scene_id: str) -> Scene[object]:
        return replace(options.load_scene(scene_id), handles=(replace(sound, **handle),))

    first, *_ = mistakes(replace(options, load_scene=load))
    assert first.startswith(f"{CHAPTER}:6: simulation 'demo' cannot be drawn: ")
    assert told in first


def mistakes(options: Options) -> list[str]:
    try:
        check_site(options)
    except BuildError as error:
        return [str(told) for told in error.diagnostics]
    return []
