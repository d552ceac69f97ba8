"""The site is written whole or not at all."""

import os
from pathlib import Path

import pytest

from site_builder.output.writer import write_site


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
        write_site({"book.json": b"new"}, out)
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


def test_a_folder_that_holds_something_else_is_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(ValueError, match="holds no site"):
        write_site({"book.json": b"{}"}, tmp_path)
    assert (tmp_path / "thesis.tex").is_file()


def test_a_file_is_never_replaced_by_a_site(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(ValueError, match="holds no site"):
        write_site({"book.json": b"{}"}, tmp_path / "thesis.tex")
