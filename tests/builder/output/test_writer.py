"""The site is written whole or not at all."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from site_builder.output.writer import advice, write_site

ROOT = Path(__file__).parents[3]
NOBODY = 65534
"""The user without rights."""


def test_the_site_is_replaced_as_a_whole(tmp_path: Path) -> None:
    out = tmp_path / "site"
    write_site({"book.json": b"{}", "old/page.html": b"old"}, out)
    write_site({"book.json": b"{}", "new/page.html": b"new"}, out)
    assert sorted(p.relative_to(out).as_posix() for p in out.rglob("*.*")) == [
        "book.json", "new/page.html",
    ]  # fmt: skip
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_a_write_that_fails_leaves_the_last_site(tmp_path: Path) -> None:
    out = tmp_path / "site"
    write_site({"book.json": b"{}"}, out)
    with pytest.raises(FileNotFoundError):
        write_site({"book.json": b"new", "gone.png": tmp_path / "gone.png"}, out)
    assert (out / "book.json").read_bytes() == b"{}"
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_a_swap_that_fails_brings_the_last_site_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "site"
    write_site({"book.json": b"{}"}, out)
    rename = Path.rename

    def refuse_the_new(self: Path, target: Path) -> Path:
        if self.name.endswith("-new"):
            raise PermissionError("in use")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse_the_new)
    with pytest.raises(PermissionError):
        write_site({"book.json": b"new", "more": b""}, out)
    assert (out / "book.json").read_bytes() == b"{}"
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


def test_unchanged_files_keep_their_modification_time(tmp_path: Path) -> None:
    out = tmp_path / "site"
    write_site({"book.json": b"{}", "a.html": b"a"}, out)
    for name in ("book.json", "a.html"):
        os.utime(out / name, (1000, 1000))
    write_site({"book.json": b"{}", "a.html": b"b"}, out)
    assert (out / "book.json").stat().st_mtime == 1000
    assert (out / "a.html").stat().st_mtime > 1000


def test_what_others_did_to_a_written_site_is_put_right(tmp_path: Path) -> None:
    out, files = tmp_path / "site", {"book.json": b"{}", "a": b"a"}
    write_site(files, out)
    (out / "a").write_bytes(b"damaged")
    (out / "stray").touch()
    assert set(write_site(files, out)) == {"a", "stray"}
    assert {file.name: file.read_bytes() for file in out.iterdir()} == files


@pytest.mark.parametrize("out", [".", "thesis.tex"])
def test_what_is_no_site_is_never_replaced(tmp_path: Path, out: str) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(ValueError, match="holds no site"):
        write_site({"book.json": b"{}"}, tmp_path / out)
    assert (tmp_path / "thesis.tex").read_text() == "years of work"


def test_what_has_changed_is_told(tmp_path: Path) -> None:
    out = tmp_path / "site"
    assert set(write_site({"book.json": b"{}", "a": b"a"}, out)) == {"book.json", "a"}
    assert set(write_site({"book.json": b"{}", "b": b"b"}, out)) == {"a", "b"}
    assert write_site({"book.json": b"{}", "b": b"b"}, out) == ()


def test_what_a_killed_build_left_behind_goes_with_the_next(tmp_path: Path) -> None:
    (tmp_path / ".site-new" / "a").mkdir(parents=True)
    (tmp_path / ".other-new").mkdir()
    write_site({"book.json": b"{}"}, tmp_path / "site")
    assert sorted(path.name for path in tmp_path.iterdir()) == [".other-new", "site"]


def test_a_site_that_a_killed_build_had_moved_away_is_put_back(tmp_path: Path) -> None:
    write_site({"book.json": b"{}", "kept": b"good"}, tmp_path / "site")
    (tmp_path / "site").rename(tmp_path / ".site-old")
    with pytest.raises(FileNotFoundError):
        write_site({"book.json": b"new", "gone": tmp_path / "gone"}, tmp_path / "site")
    assert (tmp_path / "site" / "kept").read_bytes() == b"good"


def test_two_builds_at_once_leave_one_whole_site(tmp_path: Path) -> None:
    """Each in a process of its own, as they would be."""
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
    assert [path.name for path in tmp_path.iterdir()] == ["site"]


@pytest.fixture
def sealed() -> Iterator[Path]:
    """A folder with a site in it, where nobody may write: neither root, who may everything."""
    folder = Path(tempfile.mkdtemp())
    write_site({"book.json": b"{}", "a": b"a"}, folder / "site")
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
def test_where_nobody_may_write_the_last_site_stays_and_the_message_has_a_way_out(
    sealed: Path, more: dict[str, bytes]
) -> None:
    with pytest.raises(PermissionError) as raised:
        write_site({"book.json": b"{}", "a": b"new", **more}, sealed)
    assert "choose a folder that can be written, by --out" in advice(raised.value)
    assert {file.name: file.read_bytes() for file in sealed.iterdir()} == {
        "book.json": b"{}",
        "a": b"a",
    }
    assert [place.name for place in sealed.parent.iterdir()] == ["site"]
