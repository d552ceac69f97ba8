"""What is kept on disk is what was put there, or nothing."""

import sqlite3
from pathlib import Path

import pytest

from site_builder.kept.store import NAME, Store


def test_what_was_put_is_found_by_another_process(tmp_path: Path) -> None:
    Store(tmp_path).put({b"one": b"1", b"two": b"22"})
    again = Store(tmp_path)
    assert (again.get(b"one"), again.get(b"two"), again.get(b"three")) == (b"1", b"22", None)


def test_an_entry_whose_bytes_have_changed_is_not_found(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.put({b"one": b"1", b"two": b"22"})
    store.close()
    with sqlite3.connect(tmp_path / NAME) as connection:
        value = connection.execute("SELECT value FROM kept WHERE key = ?", (b"one",)).fetchone()[0]
        harmed = value[:-1] + bytes([value[-1] ^ 1])
        connection.execute("UPDATE kept SET value = ? WHERE key = ?", (harmed, b"one"))
    connection.close()
    assert (store.get(b"one"), store.get(b"two")) == (None, b"22")


@pytest.mark.parametrize("damage", [b"", b"no database at all" * 99, None])
def test_a_damaged_file_is_made_anew(tmp_path: Path, damage: bytes | None) -> None:
    store = Store(tmp_path)
    store.put({bytes([n]): bytes(999) for n in range(99)})
    store.close()
    file = tmp_path / NAME
    whole = file.read_bytes()
    file.write_bytes(whole[: len(whole) // 2] if damage is None else damage)
    for n in range(99):
        assert store.get(bytes([n])) in (None, bytes(999))
    store.put({b"new": b"!"})
    assert Store(tmp_path).get(b"new") == b"!"


def test_a_folder_that_cannot_be_written_keeps_nothing_and_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    store = Store(tmp_path / "file")
    store.put({b"one": b"1"})
    assert store.get(b"one") is None


def test_what_was_used_longest_ago_goes_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = Store(tmp_path, most_bytes=400_000)
    noise = [bytes((n * k * k) % 251 for k in range(9_000)) for n in range(1, 90)]
    for day, data in enumerate(noise):
        monkeypatch.setattr("time.time", lambda day=day: 86_400.0 * day)
        store.put({str(day).encode(): data})
    found = [day for day in range(len(noise)) if store.get(str(day).encode()) is not None]
    assert found
    assert found == list(range(found[0], len(noise)))
    assert (tmp_path / NAME).stat().st_size < 500_000
