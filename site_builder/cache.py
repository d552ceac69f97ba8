"""Results of pure functions, stored on disk.

``@cached`` looks a result up under the hash of the function's name, its arguments, and the sources
that its module imports. A function so marked reads nothing else: a file that matters is an argument
itself, or its hash is. Scenes, ladders and functions among the arguments count as their sources.

The cache works within ``with using(Cache(folder))``; elsewhere every function simply runs. An entry
that is missing, damaged or unreadable is computed again, without a word.
"""

import copyreg
import functools
import hashlib
import pickle
import platform
import re
import sqlite3
import sys
import threading
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from contextlib import contextmanager, suppress
from dataclasses import fields, is_dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np
from platformdirs import user_cache_path

import simulations
from simulations.engine.hard_cases import HardCases
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from site_builder import STARTED_NS
from site_builder.diagnostics import Diagnostics
from site_builder.engine_files import DISTRIBUTION, ENGINE
from site_builder.files import SIZE

OWN = DISTRIBUTION.replace("-", "_") + "-"
"""With which the engine's own entry among the installed packages begins."""
FILE = "results-2.sqlite"
"""With the version of its format."""
MOST_BYTES = 400_000_000
"""Beyond this the older half of the entries is deleted."""
WAIT_S = 5.0
"""For another build that is writing."""
TABLE = "CREATE TABLE IF NOT EXISTS results (key BLOB PRIMARY KEY, value BLOB)"
OLDER_HALF = "SELECT rowid FROM results ORDER BY rowid LIMIT (SELECT count(*) / 2 FROM results)"
HOLDERS: Mapping[type, str] = {Scene: "SCENE", Ladder: "LADDER", HardCases: "TABLE"}
"""Values that are code, and the name under which their module holds them."""
IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|.*)|import[ \t]+(.*))", re.MULTILINE
)


class UnhashableError(TypeError):
    """A value that is no plain data."""


class Cache:
    """Bytes under keys, in a file that several builds may use at once."""

    def __init__(self, folder: Path | None = None, most_bytes: int = MOST_BYTES) -> None:
        self._file = (folder or user_cache_path("image-formation", appauthor=False)) / FILE
        self._connection: sqlite3.Connection | None = None
        self._lock = threading.Lock()
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
    def found(*args: P.args, **kwargs: P.kwargs) -> T:
        return cached_result(
            function.__qualname__,
            (args, kwargs),
            lambda: function(*args, **kwargs),
            module=function.__module__,
        )

    return found


def cached_result[T](
    name: str,
    given: object,
    make: Callable[[], T],
    *,
    module: str = "",
    is_final: Callable[[T], bool] = lambda _result: True,
) -> T:
    """What ``make`` returns, which depends on ``given`` and on the sources that ``module`` imports,
    by default that of ``make``; stored where it ``is_final``."""
    if _active is None:
        return make()
    module = module or make.__module__
    try:
        key = hash_of(module, name, source_hash(module), given)
    except UnhashableError:
        return make()
    if (data := _active.get(key)) is not None:
        with suppress(Exception):  # whatever a pickle of another version may raise
            return pickle.loads(data)  # type: ignore[no-any-return]
    result = make()
    if is_final(result) and not _changed_sources():
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


def hash_of(*values: object) -> bytes:
    """Of plain data, arrays, dataclasses, scenes, ladders and functions, the same in every process.
    Raises `UnhashableError`."""
    digest = hashlib.blake2b(digest_size=SIZE)
    _add(values, digest.update)
    return digest.digest()


def _add(value: Any, update: Callable[[bytes], None]) -> None:
    """Every part with its kind and length, so that no two values look alike."""

    def put(kind: str, data: bytes) -> None:
        update(f"{kind} {len(data)} ".encode() + data)

    match value:
        case None | bool() | int() | float() | complex():
            put(type(value).__name__, repr(value).encode())
        case Enum():
            put("enum", f"{type(value).__qualname__}.{value.name}".encode())
        case str() | Path():
            put(type(value).__name__, str(value).encode("utf-8", "surrogatepass"))
        case bytes():
            put("bytes", value)
        case np.ndarray() | np.generic():
            put(f"array {value.dtype.str} {value.shape}", value.tobytes())
        case Mapping():
            put("mapping", str(len(value)).encode())
            for key, item in value.items():
                _add(key, update)
                _add(item, update)
        case Set():
            put("set", b"".join(sorted(hash_of(item) for item in value)))
        case Sequence():
            put("sequence", str(len(value)).encode())
            for item in value:
                _add(item, update)
        case functools.partial():
            _add((value.func, value.args, value.keywords), update)
        case Scene() | Ladder() | HardCases() | FunctionType():
            module = module_of(value)
            if module is None or getattr(value, "__closure__", None):
                raise UnhashableError(f"{value!r} belongs to no module")
            put("code", f"{module} {getattr(value, '__qualname__', '')} ".encode())
            put("sources", source_hash(module))
        case _ if getattr(value, "cache_key", b""):
            put("cached", value.cache_key)
        case _ if is_dataclass(value):
            put("dataclass", type(value).__qualname__.encode())
            for each in fields(value):
                _add(getattr(value, each.name), update)
        case _:
            raise UnhashableError(f"{type(value).__qualname__}; legal: plain data")


def module_of(value: object) -> str | None:
    """The module that holds a scene, ladder or table of hard cases, or that defines a function;
    None where there is none."""
    name = HOLDERS.get(type(value))
    if name is None:
        return getattr(value, "__module__", None)
    modules = [module for module in [*sys.modules.values()] if module is not None]
    return next((each.__name__ for each in modules if vars(each).get(name) is value), None)


@functools.cache
def source_hash(module: str) -> bytes:
    """Of the sources of ``module`` and all of ours that it imports, however indirectly, and of the
    versions of Python and the installed packages."""
    found: dict[str, bytes] = {}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name not in found and (source := _source(name)):
            found[name], imported = source
            waiting += imported
    return hash_of(sorted(found.items()), _versions())


@functools.cache
def _source(module: str) -> tuple[bytes, tuple[str, ...]] | None:
    """The hash of a module's source, and names that may be modules which it imports; None of what
    is none of ours."""
    package = module.partition(".")[0]
    if package not in ("simulations", "site_builder"):
        return None
    is_shared = package == "simulations"
    roots = [Path(folder).parent for folder in simulations.__path__] if is_shared else [ENGINE]
    places = [root.joinpath(*module.split(".")) for root in roots]
    files = (file for each in places for file in (each.with_suffix(".py"), each / "__init__.py"))
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        return None
    text = file.read_bytes().decode("utf-8", "replace")
    _written_ns.append(file.stat().st_mtime_ns)
    names = {module.rpartition(".")[0]}
    for origin, members, plain in IMPORT.findall(text):
        names |= {origin, *re.findall(r"[\w.]+", plain)}
        names |= {f"{origin}.{member}" for member in re.findall(r"\w+", members)}
    return hash_of(text), tuple(sorted(names))


_written_ns: list[int] = []
"""Times of change of the sources that were hashed."""


def _changed_sources() -> bool:
    """Whether a source was written since this process began: what it runs may be older."""
    return max(_written_ns, default=0) >= STARTED_NS


@functools.cache
def _versions() -> tuple[object, ...]:
    found = {file.name for folder in sys.path for file in Path(folder).glob("*.dist-info")}
    ours = {name for name in found if name.startswith(OWN)}  # known by their sources
    return sys.version, platform.machine(), found - ours


def _held(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


def _by_name(value: Any) -> tuple[Any, tuple[str, str]]:
    module = module_of(value)
    if module is None:
        raise pickle.PicklingError(f"{value.id!r} is in no module")
    return _held, (module, HOLDERS[type(value)])


for _holder in HOLDERS:  # what is code is pickled as the name of it
    copyreg.pickle(_holder, _by_name)
