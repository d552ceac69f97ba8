"""Results are stored under all that they depend on; damage to the store is harmless."""

import multiprocessing
import sqlite3
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from simulations.registry import load_scene
from site_builder.cache import hashing
from site_builder.cache import results as cache
from site_builder.cache.results import FILE, Cache, cached, cached_reading, using
from site_builder.diagnostics.diagnostic import Diagnostics

calls: list[object] = []


@cached
def double(value: int) -> int:
    calls.append(value)
    return 2 * value


@cached
def scene_title(scene: object) -> str:
    calls.append(scene)
    return str(scene)


@pytest.fixture(autouse=True)
def _no_calls(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    calls.clear()
    monkeypatch.setattr(hashing, "STARTED_NS", float("inf"))  # else sources may be too young
    yield
    calls.clear()


def test_a_stored_result_serves_the_next_build(tmp_path: Path) -> None:
    for _ in range(2):
        with using(Cache(tmp_path)):
            assert double(1) == 2
    assert calls == [1]


def test_scenes_count_as_their_sources(tmp_path: Path) -> None:
    with using(Cache(tmp_path)):
        for name in ("camera", "camera", "lens-distortion"):
            scene_title(load_scene(name))
    assert len(calls) == 2


def test_changed_sources_are_run_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with using(Cache(tmp_path)):
        double(1)
        monkeypatch.setattr(cache, "source_hash", lambda _module: b"other")
        double(1)
    assert calls == [1, 1]


def test_what_sources_written_after_the_start_made_is_not_stored(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hashing, "STARTED_NS", 0)
    with using(Cache(tmp_path)):
        assert (double(1), double(1)) == (2, 2)
    assert calls == [1, 1]


def execute(file: Path, statement: str) -> None:
    with closing(sqlite3.connect(file)) as connection, connection:
        connection.execute(statement)


DAMAGES: dict[str, Callable[[Path], object]] = {
    "no database": lambda file: file.write_bytes(b"no database " * 1000),
    "gone": lambda file: file.unlink(),
    "no table": lambda file: execute(file, "DROP TABLE results"),
    "other columns": lambda file: execute(file, "ALTER TABLE results RENAME value TO other"),
    "damaged entries": lambda file: execute(file, "UPDATE results SET value = x'00'"),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_cache_is_done_without(damage: Callable[[Path], object], tmp_path: Path) -> None:
    with using(Cache(tmp_path)):
        double(1)
    damage(tmp_path / FILE)
    for _ in range(2):
        with using(Cache(tmp_path)):
            assert double(1) == 2
    assert calls[1:]


def test_a_folder_that_cannot_be_made_is_done_without(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with using(Cache(tmp_path / "file" / "below")):
        assert double(1) == 2


def test_the_older_half_goes_where_there_is_too_much(tmp_path: Path) -> None:
    with closing(Cache(tmp_path)) as cache:
        for number in range(200):
            cache.put(bytes([number]), np.random.default_rng(number).bytes(1000))
    with closing(Cache(tmp_path, most_bytes=100_000)) as cache:
        left = [number for number in range(200) if cache.get(bytes([number])) is not None]
    assert left == [*range(100, 200)]
    assert (tmp_path / FILE).stat().st_size < 150_000


def write_many(folder: Path, first: int) -> None:
    cache = Cache(folder)
    for number in range(first, first + 200):
        cache.put(str(number).encode(), str(number).encode() * 100)
    cache.close()


def test_builds_at_the_same_time_store_all_their_results(tmp_path: Path) -> None:
    context = multiprocessing.get_context("spawn")
    builds = [context.Process(target=write_many, args=(tmp_path, first)) for first in (0, 100, 200)]
    for build in builds:
        build.start()
    for build in builds:
        build.join()
    cache = Cache(tmp_path)
    assert all(cache.get(str(n).encode()) == str(n).encode() * 100 for n in range(400))
    cache.close()


def test_warnings_are_stored_and_mistakes_are_not(tmp_path: Path) -> None:
    def read(problems: Diagnostics) -> int:
        calls.append("read")
        problems.warn("a.md", 1, "odd")
        return 1

    def fail(problems: Diagnostics) -> int:
        calls.append("fail")
        problems.add("a.md", 1, "wrong")
        return 1

    with using(Cache(tmp_path)):
        for reader in (read, read, fail, fail):
            problems = Diagnostics()
            cached_reading(reader.__name__, "a", problems, reader)
            assert [*problems.found, *problems.doubts]
    assert calls == ["read", "fail", "fail"]


def test_threads_share_a_cache(tmp_path: Path) -> None:
    with using(Cache(tmp_path)), ThreadPoolExecutor(8) as threads:
        for _ in range(2):
            assert list(threads.map(double, range(200))) == [2 * n for n in range(200)]
    assert sorted(map(str, calls)) == sorted(map(str, range(200)))
