"""Files of a book: their bytes, names and places; where keys of TOML stand; settings."""

import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support import little_book
from support.little_book import OUTLINE, MakeBook, diagnostics

from site_builder.files.text import Sources, Toml

type Files = Mapping[str, bytes | Callable[[Path], object] | None]

CHAPTER = "content/00-first.md"
BOOK = "content/book.toml"
FRONT = little_book.FRONT.encode()


def link_to(target: str) -> Callable[[Path], object]:
    return lambda file: file.symlink_to(target)


@pytest.mark.parametrize(
    ("files", "report"),
    [
        ({CHAPTER: (FRONT + b"Text.\n").decode().encode("utf-16")}, f"{CHAPTER}:1: UTF-16; legal:"),
        ({BOOK: OUTLINE.encode("utf-16")}, f"{BOOK}:1: UTF-16; legal:"),
        ({BOOK: None}, f"{BOOK}:1: no outline; legal: a file with title, subtitle,"),
        ({CHAPTER: FRONT + b"One.\n\nT\0wo.\n"}, f"{CHAPTER}:7: control character U+0000; legal:"),
        ({CHAPTER: FRONT.replace(b"First", b"a\x07") + b"Text.\n"},
         f"{CHAPTER}:2: control character U+0007; legal:"),
        ({CHAPTER: FRONT + b"Text.\n\n" * 1_000_000},
         f"{CHAPTER}:1: 7.0 MB of text; legal: at most 1 MB"),
        ({CHAPTER: b""}, f"{CHAPTER}:1: no front matter; legal:"),
        ({CHAPTER: Path.mkdir}, f"{BOOK}:4: unknown chapter '00-first'; legal: 01-second"),
        ({CHAPTER: FRONT + b":::{download} data/x.csv\n:::\n",
          "content/data/x.csv": link_to("x.csv")},
         f"{CHAPTER}:5: unknown file 'data/x.csv'; legal:"),
        ({CHAPTER: FRONT + b":::{download} data/a.csv\nA list.\n:::\n",
          "content/data/a.csv": link_to("/etc/hostname")},
         f"{CHAPTER}:5: file 'data/a.csv' leads out of content/; legal:"),
    ],
)  # fmt: skip
def test_a_file_that_cannot_be_read_is_reported(
    make_book: MakeBook, files: Files, report: str
) -> None:
    assert mistakes(make_book, files)[0].startswith(report)


@pytest.mark.parametrize(
    ("path", "text"),
    [
        (BOOK, "title = 'caf\xe9'\n"),
        (CHAPTER, "---\ntitle: First\nsummary: s\n---\n\ncaf\xe9\n"),
        ("content/glossary.toml", "[ray]\nsays = 'caf\xe9'\n"),
        ("content/symbols.toml", "[book]\n'x' = ['caf\xe9']\n"),
        ("content/lecture-plan.toml", "\nintro = 'caf\xe9'\n"),
        ("content/references.bib", "@book{a,\ntitle = {Caf\xe9}}\n"),
    ],
)
def test_bytes_that_are_no_utf_8_are_reported_at_their_line(
    make_book: MakeBook, path: str, text: str
) -> None:
    files = {CHAPTER: FRONT + b"Text.\n", path: text.encode("latin-1")}
    line = text[: text.index("\xe9")].count("\n") + 1
    assert f"{path}:{line}: byte 0xe9 is not UTF-8; legal: UTF-8" in mistakes(make_book, files)


@pytest.mark.parametrize("mark", [b"\xef\xbb\xbf", b""])
@pytest.mark.parametrize("end", [b"\r\n", b"\n"])
def test_marks_and_line_ends_of_other_editors_are_no_mistake(
    make_book: MakeBook, mark: bytes, end: bytes
) -> None:
    text = FRONT + b"Text.\n\n- One\n\t- Two\n"
    assert mistakes(make_book, {CHAPTER: mark + text.replace(b"\n", end)}) == []


def mistakes(make_book: MakeBook, files: Files) -> list[str]:
    options = make_book(files={BOOK: OUTLINE, **dict.fromkeys(files)})
    for name, content in files.items():
        file = options.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, bytes):
            file.write_bytes(content)
        elif content:
            content(file)
    return [str(found) for found in diagnostics(options)]


def test_keys_are_found_where_they_stand(tmp_path: Path) -> None:
    text = (
        "a = 1\n[b]\n'k = 1' = 2\n\"c\".d = 3\nlist = [\n 'a = 2',\n]\n"
        "[b.'x.y']\nlong = '''\nb = 1\n[b]\n'''\nlast = 4\n[[s]]\nn = 1\n[[s]]\nn = 2\n"
    )
    tomllib.loads(text)
    (tmp_path / "x.toml").write_text(text)
    read = Sources(tmp_path).toml("x.toml")
    assert read
    keys = (("a",), ("b",), ("b", "k = 1"), ("b", "c", "d"), ("b", "x.y", "last"))
    entries = (("s", 0, "n"), ("s", 1, "n"))
    assert [read.line(*key) for key in (*keys, *entries)] == [1, 2, 3, 4, 13, 15, 17]
    missing = Toml({"a": {}}, {("a",): 7})
    assert (missing.line("a", "b"), missing.line("c")) == (7, 1)
