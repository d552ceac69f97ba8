"""Files that hold other bytes, or other TOML, than they may; and where keys stand."""

import tomllib
from pathlib import Path

import pytest

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.text import Toml, read_toml

ROOT = Path(__file__).resolve().parents[2]


def test_keys_are_found_where_they_stand(tmp_path: Path) -> None:
    text = (
        "a = 1\n[b]\n'k = 1' = 2\n\"c\".d = 3\nlist = [\n 'a = 2',\n]\n"
        "[b.'x.y']\nlong = '''\nb = 1\n[b]\n'''\nlast = 4\n[[s]]\nn = 1\n[[s]]\nn = 2\n"
    )
    tomllib.loads(text)
    (tmp_path / "x.toml").write_text(text)
    read = read_toml(tmp_path, "x.toml", Diagnostics())
    assert read
    assert [
        read.line(*keys)
        for keys in (
            ("a",),
            ("b",),
            ("b", "k = 1"),
            ("b", "c", "d"),
            ("b", "x.y", "last"),
            ("s", 0, "n"),
            ("s", 1, "n"),
        )
    ] == [1, 2, 3, 4, 13, 15, 17]


@pytest.mark.parametrize("file", sorted((ROOT / "content").glob("*.toml")), ids=lambda f: f.name)
def test_every_key_of_the_book_has_its_place(file: Path) -> None:
    read = read_toml(ROOT, f"content/{file.name}", Diagnostics())
    assert read
    lines = read.text.split("\n")
    for table, entries in read.table.items():
        for key in entries if isinstance(entries, dict) else ():
            assert key.split("\\")[-1] in lines[read.line(table, key) - 1]


def test_a_key_that_is_not_there_is_placed_at_its_table() -> None:
    read = Toml({"a": {}}, {("a",): 7})
    assert (read.line("a", "b"), read.line("c")) == (7, 1)
