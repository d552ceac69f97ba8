"""Building and writing: whole or not at all, the same bytes from the same sources."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder import build
from site_builder.build import Options, render_site
from site_builder.diagnostics import BuildError
from site_builder.output.assets import content_bytes, hashed_folder
from site_builder.output.writer import write_site
from site_builder.serve import Builds
from site_builder.source import OWN_FOLDERS

type MakeBook = Callable[..., Options]


def test_a_build_is_deterministic(make_book: MakeBook) -> None:
    options = make_book(":::{simulation} demo\n:::\n")
    first, second = render_site(options), render_site(options)
    assert {p: content_bytes(c) for p, c in first.items()} == {
        p: content_bytes(c) for p, c in second.items()
    }


def test_a_mistake_writes_nothing(make_book: MakeBook, tmp_path: Path) -> None:
    make_book(":::{nope}\n:::\n")
    written: list[Path] = []
    with pytest.raises(BuildError):
        build.build_site(
            tmp_path,
            tmp_path / "site",
            runtime=False,
            write=lambda _files, out: written.append(out),
        )
    assert written == []


def test_a_scene_that_raises_is_a_mistake_at_its_figure(make_book: MakeBook) -> None:
    options = make_book("\n:::{simulation} demo\n:::\n")

    def load(scene_id: str) -> object:
        scene = options.load_scene(scene_id)
        return type(scene)(scene.id, scene.title, scene.controls, lambda *_: 1 / 0)  # type: ignore[arg-type,return-value]

    with pytest.raises(BuildError) as raised:
        render_site(Options(options.root, runtime=False, load_scene=load))  # type: ignore[arg-type]
    assert [str(found) for found in raised.value.diagnostics] == [
        "content/00-first.md:6: simulation 'demo' cannot be drawn: ZeroDivisionError: "
        "division by zero",
        "content/book.toml:4: simulation 'demo' cannot be drawn: ZeroDivisionError: "
        "division by zero",
    ]


def test_pages_listen_for_rebuilds_only_while_serving(make_book: MakeBook) -> None:
    options = make_book()
    for reload in (False, True):
        files = render_site(Options(options.root, False, reload, options.load_scene))
        assert (b"/.reload/" in content_bytes(files["first/index.html"])) is reload


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


def test_the_folder_of_assets_is_named_by_names_and_contents() -> None:
    folders = {
        hashed_folder("assets", files)[0]
        for files in ({"a": b"1"}, {"a": b"2"}, {"b": b"1"}, {"a": b"1", "b": b""}, {"ab": b"1"})
    }
    assert len(folders) == 5
    assert hashed_folder("assets", {"a": b"1"})[1].keys() == {
        hashed_folder("assets", {"a": b"1"})[0] + "a"
    }


def test_what_is_hidden_is_not_published(make_book: MakeBook) -> None:
    hidden = {"static/css/.book.css.swp": "x", "static/.git/hooks/x.js": "x", "static/a.js": "x"}
    published = render_site(make_book(files=hidden))
    names = {path.split("/", 2)[2] for path in published if path.startswith("assets/")}
    assert "a.js" in names
    assert not any("swp" in name or ".git" in name for name in names)


def test_no_chapter_may_take_the_place_of_the_site_s_own_folders(make_book: MakeBook) -> None:
    body = ":::{source} simulations.models.thing:double\n:::\n"
    folders = {path.split("/")[0] for path in render_site(make_book(body)) if "/" in path}
    assert folders - {"first", "second"} | {"runtime"} == set(OWN_FOLDERS)


def test_open_pages_hear_of_good_and_of_bad_builds() -> None:
    builds = Builds()
    builds.finish("")
    assert builds.event() == "event: built\ndata: 1\n\n"
    builds.finish('content/a.md:1: "bad"\nmore')
    assert builds.event() == 'event: failed\ndata: "content/a.md:1: \\"bad\\"\\nmore"\n\n'
    builds.finish("")
    assert builds.event() == "event: built\ndata: 2\n\n"
