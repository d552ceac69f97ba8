"""Files of a book: unreadable files, the lines of TOML keys, and invalid pictures and drawings."""

import io
import os
import tomllib
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from PIL import Image
from support import little_book
from support.little_book import OUTLINE, MakeBook, diagnostics

from site_builder.checks import pictures as picture_checks
from site_builder.checks.pictures import SVG, read_overlay, read_svg
from site_builder.files.text import Sources, Toml

type Files = Mapping[str, bytes | Callable[[Path], object] | None]

CHAPTER = "content/00-first.md"
BOOK = "content/book.toml"
DATA = "content/measurements.json"
FRONT = little_book.FRONT.encode()
FIGURE = FRONT + b":::{figure} images/a.png\n:alt: A picture.\nA picture.\n:::\n"


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
        ({CHAPTER: FRONT.replace(b"First", b'"a\\ud800"')},
         f"{CHAPTER}:2: control character U+D800; legal:"),
        ({CHAPTER: FRONT + "a \ufffe\n".encode()},
         f"{CHAPTER}:5: control character U+FFFE; legal:"),
        ({CHAPTER: FRONT + b"One.\n\nTwo [words](https://a.example/ '&#12;').\n"},
         f"{CHAPTER}:7: control character U+000C; legal:"),
        ({BOOK: OUTLINE.encode() + b'[macros]\nR = "\\u0000"\n'},
         f"{BOOK}:6: control character U+0000; legal:"),
        ({CHAPTER: FRONT + b"Text.\n\n" * 1_000_000},
         f"{CHAPTER}:1: 7.0 MB of text; legal: at most 1 MB"),
        ({CHAPTER: b""}, f"{CHAPTER}:1: no front matter; legal:"),
        ({CHAPTER: FRONT.replace(b"First", b"[" * 5000)}, f"{CHAPTER}:1: malformed YAML: maximum"),
        ({BOOK: OUTLINE.encode() + b"x = " + b"[" * 5000}, f"{BOOK}:5: malformed TOML: maximum"),
        ({BOOK: OUTLINE.encode() + b"x = " + b"9" * 5000}, f"{BOOK}:5: malformed TOML: Exceeds"),
        ({DATA: b"[" * 100_000}, f"{DATA}:1: malformed JSON: maximum"),
        ({DATA: b"9" * 5000}, f"{DATA}:1: malformed JSON: Exceeds"),
        ({CHAPTER: Path.mkdir}, f"{BOOK}:4: unknown chapter '00-first'; legal: 01-second"),
        ({CHAPTER: FRONT + b"{cite}`key`\n", "content/references.bib": os.mkfifo},
         f"{CHAPTER}:5: unknown work 'key'; legal:"),
        ({CHAPTER: FIGURE, "content/images/a.png": link_to("a.png")},
         f"{CHAPTER}:5: unknown picture file 'images/a.png'; "),
        ({CHAPTER: FIGURE, "content/images/a.png": link_to("/etc/hostname")},
         f"{CHAPTER}:5: picture file 'images/a.png' leads out of content/; legal:"),
    ],
)  # fmt: skip
def test_unreadable_file_is_reported(make_book: MakeBook, files: Files, report: str) -> None:
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
def test_invalid_utf_8_is_reported_at_its_line(make_book: MakeBook, path: str, text: str) -> None:
    files = {CHAPTER: FRONT + b"Text.\n", path: text.encode("latin-1")}
    line = text[: text.index("\xe9")].count("\n") + 1
    assert f"{path}:{line}: byte 0xe9 is not UTF-8; legal: UTF-8" in mistakes(make_book, files)


@pytest.mark.parametrize("mark", [b"\xef\xbb\xbf", b""])
@pytest.mark.parametrize("end", [b"\r\n", b"\n"])
def test_byte_order_marks_and_line_ends_are_accepted(
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


def test_line_of_each_toml_key_is_found(tmp_path: Path) -> None:
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


type Reported = Callable[[str, bytes], list[str]]


def picture(width: int, height: int, kind: str = "PNG") -> bytes:
    buffer = io.BytesIO()
    Image.new("L", (width, height), 200).save(buffer, kind)
    return buffer.getvalue()


@pytest.fixture
def reported(make_book: MakeBook) -> Reported:
    """The diagnostics of a picture file."""

    def find(name: str, data: bytes) -> list[str]:
        options = make_book()
        (options.root / "content" / "images" / name).write_bytes(data)
        found = diagnostics(options)
        return [str(one).removeprefix(f"content/images/{name}:") for one in found]

    return find


def vast(side: int) -> bytes:
    """A picture whose header claims this width and height."""
    small = picture(8, 8)
    chunk = b"IHDR" + side.to_bytes(4) * 2 + small[24:29]
    return small[:12] + chunk + zlib.crc32(chunk).to_bytes(4) + small[33:]


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("a.png", b"", "1: no picture; legal: PNG"),
        ("a.png", picture(60, 60)[:-20], "1: a damaged picture: "),
        ("a.jpg", picture(60, 60, "JPEG")[:-200], "1: a damaged picture: "),
        ("a.png", picture(60, 60, "JPEG"), "1: holds JPEG; legal: PNG, as its name says"),
        ("a.png", vast(7_000), "1: 7000 × 7000 px; legal: "),
        ("a.png", vast(50_000), "1: more pixels than can be read"),
    ],
    ids=["empty", "cut", "cut", "another kind", "large", "vast"],
)
def test_invalid_picture_is_reported(reported: Reported, name: str, data: bytes, says: str) -> None:
    assert reported(name, data)[-1].startswith(says)


def test_photograph_with_gps_data_gives_a_warning(reported: Reported) -> None:
    buffer, exif = io.BytesIO(), Image.Exif()
    exif.get_ifd(0x8825)[1] = "N"
    Image.new("L", (8, 8)).save(buffer, "JPEG", exif=exif)
    (only,) = reported("a.jpg", buffer.getvalue())
    assert only.startswith("1: warning: says where it was taken")


def test_valid_picture_is_not_reported(reported: Reported) -> None:
    for kind in ("png", "webp", "jpeg"):
        assert reported(f"a.{kind}", picture(8, 8, kind.upper())) == []


def test_picture_with_too_many_pixels_or_bytes_is_refused(
    reported: Reported, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_checks, "MOST_PIXELS", 60)
    assert reported("a.png", picture(8, 8)) == ["1: 8 × 8 px; legal: at most 60 pixels"]
    monkeypatch.setattr(picture_checks, "MOST_BYTES", 2_000_000)
    assert "1: a picture of 2.1 MB; legal: at most 2 MB" in reported("a.svg", b" " * 2_100_000)


HEAD = f'<svg xmlns="{SVG}" viewBox="0 0 9 9">'


@pytest.mark.parametrize(
    "file",
    [
        f'{HEAD}<g class="a b"><path d="M0 0"/></g><style>.a {{ fill: red }}</style></svg>',
        f'<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY a "b">]>{HEAD}<text>&a;</text></svg>',
        f'{HEAD}<metadata><a xmlns="http://creativecommons.org/ns#"/></metadata></svg>',
    ],
)
def test_drawing_of_any_program_may_be_published(file: str) -> None:
    assert read_svg(file.encode()).faults == ()


@pytest.mark.parametrize(
    ("file", "line", "says"),
    [
        ('<html xmlns="http://www.w3.org/1999/xhtml"/>', 1, "<html> at the top; legal: <svg xmlns"),
        ("<!-- without a namespace -->\n<svg></svg>", 2, "<svg> at the top; legal: <svg xmlns"),
        (f"{HEAD}\n<g>\n</svg>", 3, "no SVG: mismatched tag"),
        (f"{HEAD}\n&a;</svg>", 2, "no SVG: undefined entity"),
        ("", 1, "no SVG: no element found"),
        ('<?xml version="1.0" encoding="utf-7"?><svg/>', 1, "no SVG: "),
        (HEAD.encode("utf-16").decode("latin-1"), 1, "no SVG: "),
    ],
)
def test_invalid_drawing_is_reported_at_its_line(file: str, line: int, says: str) -> None:
    (fault,) = read_svg(file.encode("latin-1")).faults
    assert (fault.line, fault.message[: len(says)]) == (line, says)


def test_style_element_is_legal_in_a_file_but_not_in_a_scene_drawing() -> None:
    (fault,) = read_overlay("<g/>\n<style>.a { fill: red }</style>").faults
    assert (fault.line, fault.message.partition(";")[0]) == (2, "<style> in a drawing")
    assert read_overlay('<g class="a b"><g class="b c"/></g>').classes == {"a", "b", "c"}
