"""Results of pure functions, stored on disk.

``@cached`` looks a result up under the hash of the function's name, its arguments, and the sources
that its module imports. A function so marked reads nothing else: a file that matters is an argument
itself, or its hash is. Scenes, ladders and functions among the arguments count as their sources.

The cache works within ``with using(Cache(folder))``; elsewhere every function simply runs. An entry
that is missing, damaged or unreadable is computed again, without a word.
"""

import functools
import pickle
import sqlite3
import threading
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from site_builder.cache.hashing import UnhashableError, changed_sources, hash_of, source_hash
from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.folders import cache_folder

FILE = "results-2.sqlite"
"""With the version of its format."""
MOST_BYTES = 400_000_000
"""Beyond this the older half of the entries is deleted."""
WAIT_S = 5.0
"""For another build that is writing."""
TABLE = "CREATE TABLE IF NOT EXISTS results (key BLOB PRIMARY KEY, value BLOB)"
OLDER_HALF = "SELECT rowid FROM results ORDER BY rowid LIMIT (SELECT count(*) / 2 FROM results)"


class Cache:
    """Bytes under keys, in a file that several builds may use at once."""

    def __init__(self, folder: Path | None = None, most_bytes: int = MOST_BYTES) -> None:
        self._file = (folder or cache_folder()) / FILE
        self._connection: sqlite3.Connection | None = None
        self._lock = threading.Lock()
        self.loaded: dict[bytes, Any] = {}
        """Results that this process has read, by key; they are never changed, and serve again."""
        with self._usable():
            self._file.parent.mkdir(parents=True, exist_ok=True)
            self._connection = sqlite3.connect(
                self._file, timeout=WAIT_S, isolation_level=None, check_same_thread=False
            )
            self._connection.execute("PRAGMA journal_mode = WAL")
            self._connection.execute("PRAGMA synchronous = OFF")
            self._connection.execute(TABLE)
            if self._file.stat().st_size > most_bytes:
                self._connection.execute(f"DELETE FROM results WHERE rowid IN ({OLDER_HALF})")
                self._connection.execute("VACUUM")

    def get(self, key: bytes) -> bytes | None:
        with self._usable():
            if self._connection:
                query = "SELECT value FROM results WHERE key = ?"
                row = self._connection.execute(query, (key,)).fetchone()
                return zlib.decompress(row[0]) if row else None
        return None

    def put(self, key: bytes, value: bytes) -> None:
        with self._usable():
            if self._connection:
                row = (key, zlib.compress(value, 1))
                self._connection.execute("INSERT OR REPLACE INTO results VALUES (?, ?)", row)

    def close(self) -> None:
        with self._usable():
            if self._connection:
                self._connection.close()
        self._connection = None

    @contextmanager
    def _usable(self) -> Iterator[None]:
        """By one thread at a time. A file that is locked, full or read-only is done without; a
        damaged one is deleted."""
        try:
            with self._lock:
                yield
        except (sqlite3.OperationalError, OSError, zlib.error):
            pass
        except sqlite3.DatabaseError:
            if self._connection:
                self._connection.close()
            self._connection = None
            with suppress(OSError):
                for file in self._file.parent.glob(f"{self._file.name}*"):
                    file.unlink()


_active: Cache | None = None


@contextmanager
def using(cache: Cache | None) -> Iterator[None]:
    """Within, results are looked up in ``cache``, which is closed in the end."""
    global _active
    before, _active = _active, cache
    try:
        yield
    finally:
        _active = before
        if cache:
            cache.close()


def cached[**P, T](function: Callable[P, T]) -> Callable[P, T]:
    """``function``, called only for arguments whose result is not stored. Its result can be
    pickled and is never changed."""

    @functools.wraps(function)
    def with_cache(*args: P.args, **kwargs: P.kwargs) -> T:
        return cached_result(
            function.__qualname__,
            (args, kwargs),
            lambda: function(*args, **kwargs),
            module=function.__module__,
        )

    return with_cache


def cached_result[T](
    name: str,
    arguments: object,
    make: Callable[[], T],
    *,
    module: str = "",
    is_final: Callable[[T], bool] = lambda _result: True,
) -> T:
    """Result of ``make``, stored where it ``is_final``. It may depend on ``arguments`` and on the
    sources that ``module`` imports (default: the module of ``make``)."""
    if _active is None:
        return make()
    module = module or make.__module__
    try:
        key = hash_of(module, name, source_hash(module), arguments)
    except UnhashableError:
        return make()
    if key in _active.loaded:
        return _active.loaded[key]  # type: ignore[no-any-return]
    if (data := _active.get(key)) is not None:
        with suppress(Exception):  # whatever a pickle of another version may raise
            return _active.loaded.setdefault(key, pickle.loads(data))  # type: ignore[no-any-return]
    result = make()
    if is_final(result) and not changed_sources():
        with suppress(pickle.PicklingError, AttributeError, TypeError):
            _active.put(key, pickle.dumps(result, pickle.HIGHEST_PROTOCOL))
    return result


def cached_reading[T](
    name: str, given: object, problems: Diagnostics, read: Callable[[Diagnostics], T]
) -> T:
    """What ``read`` finds, as `cached_result`; its diagnostics go to ``problems``. With a mistake
    nothing is stored."""

    def make() -> tuple[T, Diagnostics]:
        own = Diagnostics()
        return read(own), own

    value, own = cached_result(
        name, given, make, module=read.__module__, is_final=lambda found: not found[1]
    )
    problems.found.extend(own.found)
    problems.doubts.extend(own.doubts)
    return value
