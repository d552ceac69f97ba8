"""Writing the site: completely or not at all, with joined style sheets and bundled scripts."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image
from support.little_book import MakeBook
from support.places import ROOT

from site_builder.assets.page_assets import scaled_picture
from site_builder.build import render_site
from site_builder.diagnostics.diagnostic import BuildError
from site_builder.output.scripts import bundle_scripts
from site_builder.output.style_sheets import join_style_sheets
from site_builder.output.writer import advice, content_bytes, hashed_folder, write_site

NOBODY = 65534
"""The user without rights."""
BOOK = {"book.json": b"{}"}


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_site_is_replaced_completely_and_changed_files_are_returned(tmp_path: Path) -> None:
    out = tmp_path / "site"
    assert set(write_site({**BOOK, "old/page.html": b"old"}, out)) == {"book.json", "old/page.html"}
    changed = write_site({**BOOK, "new/page.html": b"new"}, out)
    assert set(changed) == {"old/page.html", "new/page.html"}
    written = sorted(path.relative_to(out).as_posix() for path in out.rglob("*.*"))
    assert written == ["book.json", "new/page.html"]
    assert names(tmp_path) == ["site"]
    assert write_site({**BOOK, "new/page.html": b"new"}, out) == ()


def test_failed_write_or_rename_leaves_the_last_site(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "site"
    write_site(BOOK, out)
    with pytest.raises(FileNotFoundError):
        write_site({"book.json": b"new", "gone.png": tmp_path / "gone.png"}, out)
    assert ((out / "book.json").read_bytes(), names(tmp_path)) == (b"{}", ["site"])
    rename = Path.rename

    def refuse_the_new(self: Path, target: Path) -> Path:
        if self.name.endswith("-new"):
            raise PermissionError("in use")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse_the_new)
    with pytest.raises(PermissionError):
        write_site({"book.json": b"new", "more": b""}, out)
    assert ((out / "book.json").read_bytes(), names(tmp_path)) == (b"{}", ["site"])


def test_unchanged_files_keep_their_time_and_damaged_ones_are_rewritten(tmp_path: Path) -> None:
    out, files = tmp_path / "site", {**BOOK, "a": b"a"}
    write_site(files, out)
    for name in files:
        os.utime(out / name, (1000, 1000))
    (out / "a").write_bytes(b"damaged")
    (out / "stray").touch()
    assert set(write_site(files, out)) == {"a", "stray"}
    assert {file.name: file.read_bytes() for file in out.iterdir()} == files
    assert (out / "book.json").stat().st_mtime == 1000
    assert (out / "a").stat().st_mtime > 1000


@pytest.mark.parametrize("out", [".", "thesis.tex"])
def test_folder_or_file_that_is_not_a_site_is_never_replaced(tmp_path: Path, out: str) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(ValueError, match="holds no site"):
        write_site(BOOK, tmp_path / out)
    assert (tmp_path / "thesis.tex").read_text() == "years of work"


def test_next_build_cleans_up_after_a_killed_one(tmp_path: Path) -> None:
    (tmp_path / ".site-new" / "a").mkdir(parents=True)
    (tmp_path / ".other-new").mkdir()
    write_site({**BOOK, "kept": b"good"}, tmp_path / "site")
    assert names(tmp_path) == [".other-new", "site"]
    (tmp_path / "site").rename(tmp_path / ".site-old")
    with pytest.raises(FileNotFoundError):
        write_site({"book.json": b"new", "gone": tmp_path / "gone"}, tmp_path / "site")
    assert (tmp_path / "site" / "kept").read_bytes() == b"good"


def test_concurrent_builds_leave_one_complete_site(tmp_path: Path) -> None:
    """Each build in its own process."""
    program = (
        "import sys; from pathlib import Path; from site_builder.output.writer import write_site\n"
        "files = {f'{n}.html': sys.argv[2].encode() for n in range(99)} | {'book.json': b'{}'}\n"
        "for _ in range(9): write_site(files, Path(sys.argv[1]))"
    )
    command = [sys.executable, "-c", program, str(tmp_path / "site")]
    both = [subprocess.Popen([*command, name], cwd=ROOT) for name in ("one", "two")]
    assert [build.wait() for build in both] == [0, 0]
    found = {file.read_bytes() for file in (tmp_path / "site").glob("*.html")}
    assert found in ({b"one"}, {b"two"})
    assert names(tmp_path) == ["site"]


@pytest.fixture
def read_only_site() -> Iterator[Path]:
    """A site in a read-only folder, for a user without rights even where tests run as root."""
    folder = Path(tempfile.mkdtemp())
    write_site({**BOOK, "a": b"a"}, folder / "site")
    for each in (folder / "site", folder):
        each.chmod(0o555)
    before = os.geteuid()
    if not before:
        os.seteuid(NOBODY)
    yield folder / "site"
    if not before:
        os.seteuid(before)
    for each in (folder, folder / "site"):
        each.chmod(0o755)
    shutil.rmtree(folder)


@pytest.mark.parametrize("more", [{}, {"b": b"b"}], ids=["one file", "several"])
def test_site_in_a_read_only_folder_stays_and_the_message_gives_advice(
    read_only_site: Path, more: dict[str, bytes]
) -> None:
    with pytest.raises(PermissionError) as raised:
        write_site({**BOOK, "a": b"new", **more}, read_only_site)
    assert "--out" in advice(raised.value)
    assert {file.name: file.read_bytes() for file in read_only_site.iterdir()} == {
        **BOOK,
        "a": b"a",
    }
    assert names(read_only_site.parent) == ["site"]


def test_assets_folder_is_named_by_its_hash_and_has_no_hidden_files(make_book: MakeBook) -> None:
    given = ({"a": b"1"}, {"a": b"2"}, {"b": b"1"}, {"a": b"1", "b": b""}, {"ab": b"1"})
    assert len({hashed_folder("assets", files)[0] for files in given}) == len(given)
    folder, files = hashed_folder("assets", {"a": b"1"})
    assert files.keys() == {folder + "a"}
    hidden = {"static/css/.book.css.swp": "x", "static/.git/hooks/x.js": "x", "static/a.js": "x"}
    published = [path for path in render_site(make_book(files=hidden)) if path.startswith("assets")]
    assert any(path.endswith("/a.js") for path in published)
    assert not any("swp" in path or ".git" in path for path in published)


ENTRY = "css/book.css"


def test_imported_style_sheets_replace_their_import_rules() -> None:
    files = {
        ENTRY: b'/* All. */\n@import "a.css";\n@import "b.css";\nlast {}\n',
        "css/a.css": b"a { background: url(../x.png) }\n",
        "css/b.css": b"b {}\n",
        "js/main.js": b"",
    }
    joined = join_style_sheets(files, ENTRY)
    assert sorted(joined) == [ENTRY, "js/main.js"]
    assert joined[ENTRY] == b"/* All. */\na { background: url(../x.png) }\nb {}\nlast {}\n"


@pytest.mark.parametrize("name", ["missing.css", "deep/a.css", "../a.css"])
def test_import_that_cannot_be_joined_is_reported_with_its_line(name: str) -> None:
    sheet = f'@import "a.css";\n@import "{name}";\n'.encode()
    files = {ENTRY: sheet, "css/a.css": b"", "css/deep/a.css": b"", "a.css": b""}
    with pytest.raises(BuildError, match=f"^static/css/book.css:2: cannot import {name!r}"):
        join_style_sheets(files, ENTRY)


SOURCES: Mapping[str, bytes] = {
    "js/main.ts": b'import { shown } from "./page/shown.js";\nshown("page");\n',
    "js/page/shown.ts": b"export const shown = (what: string) => console.log(what);\n",
}


@pytest.mark.parametrize(
    ("module", "message"),
    [
        (b"export const hidden = 1;\n", 'static/js/main.*"shown"'),
        (b"export const = 1;\n", r"static/js/page/shown\.ts:1: Expected identifier"),
    ],
    ids=["missing export", "syntax error"],
)
def test_mistake_in_a_script_is_reported_with_file_and_line(module: bytes, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        bundle_scripts({**SOURCES, "js/page/shown.ts": module}, "js/main.ts")


@pytest.mark.parametrize(
    ("name", "size", "width", "shipped"),
    [
        ("photo.jpg", (4000, 3000), 420.0, (840, 630)),
        ("few colours.png", (4000, 300), 700.0, (1400, 105)),
        ("small.webp", (800, 600), 700.0, (800, 600)),
    ],
)
def test_picture_ships_with_two_pixels_per_displayed_pixel(
    name: str, size: tuple[int, int], width: float, shipped: tuple[int, int], tmp_path: Path
) -> None:
    picture = Image.new("P" if name.endswith("png") else "RGB", size)
    picture.save(tmp_path / name)
    with Image.open(BytesIO(content_bytes(scaled_picture(tmp_path / name, width)))) as made:
        assert made.size == shipped
