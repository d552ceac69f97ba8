"""The pinned files: verified, cached, fetched from whichever source has them. No network here."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from site_builder.runtime import store
from site_builder.runtime.downloads import Source
from site_builder.runtime.fetch import RuntimeFetchError, fetch_runtime
from site_builder.runtime.pinned import RuntimeFile

CONTENT = {"engine.wasm": b"machine code", "library.zip": b"modules"}
FILES = tuple(RuntimeFile(name, store.sha256(data)) for name, data in CONTENT.items())


def source_of(content: dict[str, bytes], asked: list[str] | None = None) -> Source:
    def source(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
        for file in wanted:
            if asked is not None:
                asked.append(file.name)
            yield file, content[file.name]

    return source


def offline(_: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    raise OSError("network is unreachable")


def fetch(folder: Path, *sources: Source) -> dict[str, bytes]:
    labelled = [(f"source {number}", source) for number, source in enumerate(sources)]
    paths = fetch_runtime(folder, labelled, FILES)
    return {name: path.read_bytes() for name, path in paths.items()}


def test_a_second_fetch_asks_no_source(tmp_path: Path) -> None:
    fetch(tmp_path, source_of(CONTENT))
    assert fetch(tmp_path, offline) == CONTENT


@pytest.mark.parametrize("damage", [b"", b"machine c", b"machine codE"])
def test_a_damaged_cached_file_is_fetched_again_and_only_that(
    tmp_path: Path, damage: bytes
) -> None:
    fetch(tmp_path, source_of(CONTENT))
    store.location(tmp_path, FILES[0]).write_bytes(damage)
    asked: list[str] = []
    assert fetch(tmp_path, source_of(CONTENT, asked)) == CONTENT
    assert asked == ["engine.wasm"]


def test_the_next_source_is_asked_where_the_first_is_out_of_reach(tmp_path: Path) -> None:
    assert fetch(tmp_path, offline, source_of(CONTENT)) == CONTENT


def test_the_next_source_is_asked_only_for_what_the_first_gave_wrongly(tmp_path: Path) -> None:
    asked: list[str] = []
    truncated = CONTENT | {"library.zip": b"mod"}
    assert fetch(tmp_path, source_of(truncated), source_of(CONTENT, asked)) == CONTENT
    assert asked == ["library.zip"]


def test_wrong_bytes_are_never_stored(tmp_path: Path) -> None:
    with pytest.raises(RuntimeFetchError, match=r"engine\.wasm has SHA-256 .* expected"):
        fetch(tmp_path, source_of(CONTENT | {"engine.wasm": b"something else"}))
    assert not store.location(tmp_path, FILES[0]).exists()
    assert store.is_intact(tmp_path, FILES[1])


def test_a_source_that_breaks_off_keeps_what_it_gave(tmp_path: Path) -> None:
    def breaks_off(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
        yield wanted[0], CONTENT[wanted[0].name]
        raise ConnectionResetError("connection reset")

    asked: list[str] = []
    assert fetch(tmp_path, breaks_off, source_of(CONTENT, asked)) == CONTENT
    assert asked == ["library.zip"]


def test_without_any_source_the_message_names_files_attempts_and_the_way_out(
    tmp_path: Path,
) -> None:
    with pytest.raises(RuntimeFetchError) as raised:
        fetch(tmp_path, offline, offline)
    message = str(raised.value)
    assert "engine.wasm, library.zip" in message
    assert message.count("network is unreachable") == 2
    assert "Connect to the internet once" in message
    assert str(store.location(tmp_path, FILES[0])) in message


def test_no_partial_file_is_left_behind(tmp_path: Path) -> None:
    fetch(tmp_path, source_of(CONTENT))
    names = sorted(path.name for path in tmp_path.rglob("*") if path.is_file())
    assert names == sorted(CONTENT)
