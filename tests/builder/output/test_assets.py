"""Folders named by what is in them; nothing hidden is published."""

from collections.abc import Callable

from site_builder.build import Options, render_site
from site_builder.output.assets import hashed_folder


def test_the_folder_of_assets_is_named_by_names_and_contents() -> None:
    folders = {
        hashed_folder("assets", files)[0]
        for files in ({"a": b"1"}, {"a": b"2"}, {"b": b"1"}, {"a": b"1", "b": b""}, {"ab": b"1"})
    }
    assert len(folders) == 5
    assert hashed_folder("assets", {"a": b"1"})[1].keys() == {
        hashed_folder("assets", {"a": b"1"})[0] + "a"
    }


def test_what_is_hidden_is_not_published(make_book: Callable[..., Options]) -> None:
    hidden = {"static/css/.book.css.swp": "x", "static/.git/hooks/x.js": "x", "static/a.js": "x"}
    published = render_site(make_book(files=hidden))
    names = {path.split("/", 2)[2] for path in published if path.startswith("assets/")}
    assert "a.js" in names
    assert not any("swp" in name or ".git" in name for name in names)
