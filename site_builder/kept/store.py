"""What is kept on disk: bytes under keys, in one file of the user's cache folder.

The file is a convenience and never a truth: what is damaged, locked or cannot be written is made
anew, and the build goes on.
"""

import hashlib
import sqlite3
import time
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

import brotli
from platformdirs import user_cache_path

NAME = "kept-3.sqlite"
"""With the number of its format."""
BEFORE = ("kept-1.sqlite", "kept-2.sqlite")
"""Nobody opens them any more."""
QUALITY = 0
"""Of what is packed: as small as by zlib at its quickest, in half the time."""
LEAST_PACKED = 400
"""Bytes of the least entry that is packed: to begin takes as long as to pack some thousand."""
PLAIN, PACKED = b"\0", b"\1"
"""How an entry begins."""
MOST_BYTES = 400_000_000
"""What is kept at most; the entries used longest ago go first."""
SHARE_LEFT = 0.75
"""Of `MOST_BYTES`, when some had to go."""
CHECK = 32
"""Bytes of the checksum in front of each entry."""
DAY = 86_400
WAIT_S = 5.0
"""For another build that is writing."""
TABLE = (
    "CREATE TABLE IF NOT EXISTS kept "
    "(key BLOB PRIMARY KEY, value BLOB NOT NULL, used INTEGER NOT NULL) WITHOUT ROWID"
)


def default_folder() -> Path:
    """Where this user's results are kept."""
    return user_cache_path("image-formation", appauthor=False)


class Store:
    """Bytes by key. Reads and writes that fail are as if nothing had been kept."""

    def __init__(self, folder: Path, most_bytes: int = MOST_BYTES) -> None:
        self._file = folder / NAME
        self._most_bytes = most_bytes
        self._connection: sqlite3.Connection | None = None
        self._lost = False
        """Whether the file can be neither read nor made."""

    def get(self, key: bytes) -> bytes | None:
        """What is kept there, where it is intact."""
        try:
            row = self._open().execute("SELECT value, used FROM kept WHERE key = ?", (key,))
            value, used = row.fetchone() or (None, 0)
            if value is not None and time.time() - used > DAY:
                self._touch(key)
        except sqlite3.DatabaseError as error:
            self._recover(error)
            return None
        return None if value is None else _opened(value)

    def put(self, entries: Mapping[bytes, bytes]) -> None:
        """Keep these, all or none of them."""
        now = int(time.time())
        rows = [(key, _sealed(value), now) for key, value in entries.items()]
        for _ in range(2):  # once more where the file had to be made anew
            try:
                with self._open() as connection:
                    connection.executemany("INSERT OR REPLACE INTO kept VALUES (?, ?, ?)", rows)
                self._shrink()
            except sqlite3.DatabaseError as error:
                self._recover(error)
            else:
                return

    def reopened(self) -> "Store":
        """The same file, for a process that was forked: a connection serves only its own."""
        return Store(self._file.parent, self._most_bytes)

    def close(self) -> None:
        if self._connection is not None:
            with suppress(sqlite3.Error):
                self._connection.close()
            self._connection = None

    def __del__(self) -> None:
        self.close()

    def _open(self) -> sqlite3.Connection:
        if self._lost:
            raise sqlite3.OperationalError("cannot be opened")
        if self._connection is None:
            try:
                self._file.parent.mkdir(parents=True, exist_ok=True)
                for name in BEFORE:
                    self._file.with_name(name).unlink(missing_ok=True)
            except OSError as error:
                raise sqlite3.OperationalError(str(error)) from error
            self._connection = sqlite3.connect(self._file, timeout=WAIT_S)
            # Power may fail: the checksums find what was lost.
            self._connection.execute("PRAGMA synchronous = OFF")
            self._connection.execute(TABLE)
        return self._connection

    def _recover(self, error: sqlite3.DatabaseError) -> None:
        """Make the file anew where it is damaged; do without it where it cannot be written."""
        self.close()
        if isinstance(error, sqlite3.OperationalError):  # locked, full, read-only, not there
            self._lost = self._lost or "locked" not in str(error)
            return
        try:
            for file in self._file.parent.glob(f"{self._file.name}*"):
                file.unlink(missing_ok=True)
        except OSError:
            self._lost = True

    def _touch(self, key: bytes) -> None:
        with suppress(sqlite3.OperationalError), self._open() as connection:
            connection.execute("UPDATE kept SET used = ? WHERE key = ?", (int(time.time()), key))

    def _shrink(self) -> None:
        """Let go of what was used longest ago, where there is too much."""
        connection = self._open()
        size = _size(connection)
        if size <= self._most_bytes:
            return
        rows = connection.execute("SELECT key, length(value) FROM kept ORDER BY used, key")
        gone = _first_of(rows.fetchall(), size - SHARE_LEFT * self._most_bytes)
        with connection:
            connection.executemany("DELETE FROM kept WHERE key = ?", gone)
        connection.execute("VACUUM")


def _size(connection: sqlite3.Connection) -> int:
    pages, free, bytes_each = (
        int(connection.execute(f"PRAGMA {name}").fetchone()[0])
        for name in ("page_count", "freelist_count", "page_size")
    )
    return (pages - free) * bytes_each


def _first_of(rows: Iterable[tuple[bytes, int]], wanted: float) -> list[tuple[bytes]]:
    """Keys of as many of the first rows as come to so many bytes."""
    chosen: list[tuple[bytes]] = []
    for key, length in rows:
        if wanted <= 0:
            break
        chosen.append((key,))
        wanted -= length
    return chosen


def _sealed(value: bytes) -> bytes:
    small = len(value) < LEAST_PACKED
    told = PLAIN + value if small else PACKED + brotli.compress(value, quality=QUALITY)
    return hashlib.sha256(told).digest() + told


def _opened(sealed: bytes) -> bytes | None:
    check, told = sealed[:CHECK], sealed[CHECK:]
    if hashlib.sha256(told).digest() != check:
        return None
    value: bytes = told[1:] if told.startswith(PLAIN) else brotli.decompress(told[1:])
    return value
