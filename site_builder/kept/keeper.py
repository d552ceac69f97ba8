"""Results kept under a hash of everything that they depend on.

``@kept`` marks a pure function of plain values: its result is looked up by the hash of its
arguments and of its code. A `Keeper` is at work only inside ``with keeping(…)``; without one every
function simply runs. What a function reads besides its arguments it tells while it runs, by
`reads_file`, `reads_folder` and `reads_code`, and the next time that is part of what is looked up.
"""

import functools
import hashlib
import pickle
import time
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path
from types import FunctionType
from typing import Any, Protocol

from site_builder.blame import is_remembered
from site_builder.kept.code import (
    Modules,
    code_hash,
    importers,
    is_as_it_was,
    look_at_loaded,
)
from site_builder.kept.files import file_hash, folder_hash
from site_builder.kept.fingerprint import SIZE, Prints, fingerprint
from site_builder.kept.packing import HOLDERS, home_of, modules_in, packed, unpacked

GENERATIONS = 3
"""Builds after which what nobody asked for leaves the memory."""
MOST_FRESH_BYTES = 16_000_000
"""What waits at most for the store: a large book's pages would fill the memory twice."""
MOST_SOURCES = 4000
"""Of which it is kept what they import."""
UNKNOWN = b"unknown"
ASKED = b"asked"

type Read = tuple[str, str]
"""``file`` or ``folder`` and a path, ``code`` and a module, or ``asked`` and the words for it."""
type Reads = Mapping[Read, bytes]
"""With the hash of each."""


class Bytes(Protocol):
    """Where results are kept beyond the process."""

    def get(self, key: bytes, /) -> bytes | None: ...
    def put(self, entries: Mapping[bytes, bytes], /) -> None: ...
    def reopened(self) -> "Bytes":
        """The same, for a process that was forked."""
        ...


class Nowhere:
    """Keeps nothing."""

    def get(self, _key: bytes) -> bytes | None:
        return None

    def put(self, _entries: Mapping[bytes, bytes]) -> None:
        pass

    def reopened(self) -> "Nowhere":
        return self


class UnkeepableError(Exception):
    """What a value depends on cannot be told."""


class MissingError(Exception):
    """What is asked for would have to be made."""


@dataclass(slots=True)
class _Entry:
    value: Any
    used: int
    modules: frozenset[str] | None = frozenset()
    """Those that something in it may be of; None where nobody can say."""
    packages: frozenset[str] = frozenset()
    """Below which these were looked for."""

    def may_be_of(self, modules: Collection[str], packages: frozenset[str]) -> bool:
        if not packages <= self.packages:
            self.modules, self.packages = modules_in(self.value, packages), packages
        return self.modules is None or not self.modules.isdisjoint(modules)


@dataclass(slots=True)
class Keeper:
    """Looks up results, first in memory, then in a store."""

    store: Bytes = field(default_factory=Nowhere)
    since_ns: float = float("inf")
    """When the process began to import its code: of a module written later nobody can say what
    ran, so nothing that it made is stored."""
    asked: dict[str, None] = field(default_factory=dict)
    """What was told by `asks`, of what is found as well as of what is made; in its order."""
    made: list[str] = field(default_factory=list)
    """Names of the functions that ran, in their order: what was not found."""
    _memory: dict[bytes, _Entry] = field(default_factory=dict)
    _fresh: dict[bytes, bytes] = field(default_factory=dict)
    """Not yet in the store."""
    _fresh_bytes: int = 0
    _missing: set[bytes] = field(default_factory=set)
    """Keys that the store was asked for in this build, and has not."""
    _codes: dict[str, bytes] = field(default_factory=dict)
    _modules: Modules = field(default_factory=dict)
    """Looked at for these; as they were, since it is this that the process has imported."""
    _sources: dict[bytes, tuple[str, ...]] = field(default_factory=dict)
    """What a file imports, by its hash: in one entry of the store, as every build asks for all."""
    _sources_fresh: bool = False
    _prints: Prints = field(default_factory=Prints)
    _hearing: list[dict[Read, bytes]] = field(default_factory=list)
    """What the functions read that are running now, the innermost last."""
    _age: int = 0
    _latest_ns: int = 0
    """When the latest module was written."""
    _looking: bool = False
    """Whether nothing is to be made."""
    _failed: dict[bytes, Exception] = field(default_factory=dict)
    """Why authors' code did not do what was asked of it, in this build: it is not tried again."""
    _beside: bool = False
    """Whether this is such a process."""

    def find[T](self, name: str, module: str, given: object, make: Callable[[], T]) -> T:
        """What ``make`` gives, made only where it is not known; see `find_named`."""
        return self.find_named(name, module, given, make)[0]

    def find_named[T](
        self, name: str, module: str, given: object, make: Callable[[], T]
    ) -> tuple[T, bytes]:
        """The result, and the hash of all that it was made from; empty where that is unknown.

        ``given`` is what it depends on, besides the code of ``module`` and what ``make`` tells
        while it runs.
        """
        try:
            own = self.fingerprint(given)
        except UnkeepableError:
            if self._looking:
                raise
            self.hear(("unknown", name), UNKNOWN)
            return make(), b""
        key = _hash(name.encode(), self.code(module), own)
        listed = self._recall(key)
        if listed is not None:
            reads = {read: self.state(read) for read in listed}
            address = _address(key, reads)
            entry = self._memory.get(address) or self._load(address)
            if entry is not None:
                entry.used = self._age
                self._pass_on(reads)
                return entry.value, address
        return self._make(name, key, make)

    def fingerprint(self, given: object) -> bytes:
        """Of plain data, scenes and ladders. Raises `UnkeepableError` for a scene of no module."""
        return fingerprint(given, self._own_fingerprint, self._prints)

    def code(self, module: str) -> bytes:
        """The hash of what a module can do."""
        if module not in self._codes:
            self._codes[module], written = code_hash(module, self._imports, self._modules)
            self._latest_ns = max(self._latest_ns, written)
        return self._codes[module]

    def state(self, read: Read) -> bytes:
        """The hash of what is read, as it is now."""
        kind, name = read
        match kind:
            case "code":
                return self.code(name)
            case "folder":
                return folder_hash(Path(name))
            case "file":
                return file_hash(Path(name)) or b"none"
            case "asked":
                return ASKED
            case _:
                return UNKNOWN

    def hear(self, read: Read, state: bytes) -> None:
        """Take note of what the running function reads."""
        if read[0] == "asked":
            self.asked[read[1]] = None
        if self._hearing:
            self._hearing[-1][read] = state

    def lacks(self, ask: Callable[[], object]) -> bool:
        """Whether ``ask`` would have to make something that can be kept."""
        try:
            self.found(ask)
        except MissingError:
            return True
        except UnkeepableError:
            pass
        return False

    def found[T](self, ask: Callable[[], T]) -> T:
        """What ``ask`` gives, nothing being made. Raises `MissingError`, and `UnkeepableError`."""
        self._looking = True
        try:
            return ask()
        finally:
            self._looking = False

    def begin_parcel(self) -> None:
        """In a process that was forked: what is made from here on goes into a parcel."""
        self.store, self._fresh, self.made = self.store.reopened(), {}, []
        self._beside = True

    def parcel(self) -> bytes:
        """What was made since it was begun, for `take_in`."""
        return pickle.dumps((self._fresh, self.made, self._failed, self._latest_ns))

    def take_in(self, parcel: bytes) -> None:
        """What another process made."""
        fresh, made, failed, latest_ns = pickle.loads(parcel)
        self._fresh |= fresh
        self._fresh_bytes += sum(map(len, fresh.values()))
        self.made += made
        self._failed |= failed
        self._latest_ns = max(self._latest_ns, latest_ns)

    def get_ready(self) -> None:
        """See what `importers` and `forget` will ask, while nobody waits."""
        look_at_loaded(self._imports, self._modules)
        packages = self._packages()
        for entry in self._memory.values():
            entry.may_be_of((), packages)

    def _packages(self) -> frozenset[str]:
        """Ours."""
        return frozenset(name.partition(".")[0] for name, each in self._modules.items() if each)

    def importers(self, files: Collection[Path]) -> frozenset[str] | None:
        """The modules of ``files``, and all of ours that import one of them: what this process may
        know no more when these have changed. Files that were written since it began are counted
        among them, whoever tells of them. None where one of them is no module that is known."""
        look_at_loaded(self._imports, self._modules)
        there = {each.file: name for name, each in self._modules.items() if each}
        changed = {file.resolve() for file in files}
        try:
            changed |= {file for file in there if file.stat().st_mtime_ns >= self.since_ns}
        except OSError:  # one is gone
            return None
        if not changed <= there.keys():
            return None
        return importers([there[file] for file in changed], self._modules)

    def forget(self, modules: Collection[str]) -> None:
        """In a process that was forked and has let go of ``modules``, and will import them as they
        are from here on: nothing that came of them is looked up, and none of them is found in what
        is."""
        self.store, self.since_ns = self.store.reopened(), time.time_ns()
        self._missing.clear()
        for name in modules:
            self._modules.pop(name, None)
            self._codes.pop(name, None)
        self._latest_ns = max(
            (each.written_ns for each in self._modules.values() if each), default=0
        )
        packages = self._packages() | {name.partition(".")[0] for name in modules}
        gone = [key for key, entry in self._memory.items() if entry.may_be_of(modules, packages)]
        for key in gone:
            del self._memory[key]

    def flush(self) -> None:
        """As `put_away`, and let go of what was not asked for lately."""
        self.put_away()
        self._failed, self._missing = {}, set()
        self._age += 1
        self._prints.next_round()
        old = [key for key, item in self._memory.items() if item.used + GENERATIONS < self._age]
        for key in old:
            del self._memory[key]

    def put_away(self) -> None:
        """Put what is new into the store."""
        fresh, self._fresh, self._fresh_bytes = self._fresh, {}, 0
        if fresh and self._sources_fresh:
            latest = dict([*self._sources.items()][-MOST_SOURCES:])
            fresh[SOURCES], self._sources_fresh = packed(latest), False
        if fresh and self._latest_ns < self.since_ns and is_as_it_was(self._modules):
            self.store.put(fresh)

    def _make[T](self, name: str, key: bytes, make: Callable[[], T]) -> tuple[T, bytes]:
        if self._looking:
            raise MissingError
        if error := self._failed.get(key):
            raise error
        self._hearing.append({})
        try:
            value = make()
        except Exception as error:
            if is_remembered(error):
                self._failed[key] = error
            raise
        finally:
            reads = self._hearing.pop()
        self.made.append(name)
        self._pass_on(reads)
        if any(state == UNKNOWN or state != self.state(read) for read, state in reads.items()):
            return value, b""
        address = _address(key, reads)
        self._keep(key, tuple(sorted(reads)))
        self._keep(address, value)
        return value, address

    def _pass_on(self, reads: Reads) -> None:
        for read, state in reads.items():
            self.hear(read, state)

    def _keep(self, key: bytes, value: object) -> None:
        self._memory[key] = _Entry(value, self._age)
        self._missing.discard(key)
        with suppress(pickle.PicklingError):  # then it is kept in memory alone
            self._fresh[key] = packed(value)
            self._fresh_bytes += len(self._fresh[key])
        if self._fresh_bytes > MOST_FRESH_BYTES and not self._beside:
            self.put_away()

    def _recall(self, key: bytes) -> Any:
        """The value under that key, or None."""
        entry = self._memory.get(key) or self._load(key)
        if entry is None:
            return None
        entry.used = self._age
        return entry.value

    def _load(self, key: bytes) -> _Entry | None:
        data = self._fresh.get(key)
        if data is None and key not in self._missing:
            data = self.store.get(key)
        if data is None:
            self._missing.add(key)
            return None
        try:
            entry = _Entry(unpacked(data), self._age)
        except Exception:  # whatever a pickle that fits no more may raise: it is made anew
            return None
        self._memory[key] = entry
        return entry

    def _own_fingerprint(self, value: object) -> bytes | None:
        """Scenes, ladders and functions are code and are known by their modules; a value that was
        kept itself, by what it was made from."""
        if type(value) not in (*HOLDERS, FunctionType):
            return getattr(value, "kept_as", None) or None
        module = home_of(value)
        if module is None or getattr(value, "__closure__", None):
            raise UnkeepableError
        return f"{module}:{getattr(value, '__qualname__', '')}".encode() + self.code(module)

    def _imports(self, hashed: bytes, read: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
        if not self._sources:
            self._sources |= self._recall(SOURCES) or {}
        names = self._sources.get(hashed)
        if names is None:
            names = self._sources[hashed] = read()
            self._sources_fresh = True
        return names


_at_work: ContextVar[Keeper | None] = ContextVar("keeper", default=None)


@contextmanager
def keeping(keeper: Keeper | None) -> Iterator[None]:
    """Within, results are kept by ``keeper``, and stored in the end, whatever happens."""
    if keeper is None:
        yield
        return
    before = _at_work.set(keeper)
    try:
        yield
    finally:
        _at_work.reset(before)
        keeper.flush()


def keeper_at_work() -> Keeper | None:
    return _at_work.get()


def store_now() -> None:
    """Put what is new into the store, while another process is waited for."""
    if keeper := _at_work.get():
        keeper.put_away()


def was_made() -> bool:
    """Whether anything had to be made in this process; so it is where nothing is kept."""
    keeper = _at_work.get()
    return keeper is None or bool(keeper.made)


def kept[**P, T](function: Callable[P, T]) -> Callable[P, T]:
    """``function``, asked only for what is not known. Its arguments are plain data, scenes and
    ladders; its result can be pickled and is never changed."""
    name, module = f"{function.__module__}.{function.__qualname__}", function.__module__

    @functools.wraps(function)
    def found(*args: P.args, **kwargs: P.kwargs) -> T:
        keeper = _at_work.get()
        if keeper is None:
            return function(*args, **kwargs)
        return keeper.find(name, module, (args, kwargs), lambda: function(*args, **kwargs))

    return found


def kept_as[T](
    name: str, given: object, make: Callable[[], T], module: str = ""
) -> tuple[T, bytes]:
    """What ``make`` gives for ``given``, and the hash of all that it was made from: empty where
    nothing is kept. ``module`` is where the code is; that of ``make`` unless told."""
    keeper = _at_work.get()
    if keeper is None:
        return make(), b""
    module = module or str(make.__module__)
    return keeper.find_named(f"{module}.{name}", module, given, make)


def given_hash(*given: object) -> bytes:
    """One hash in place of much that many ask with; nothing where nothing is kept."""
    keeper = _at_work.get()
    return keeper.fingerprint(given) if keeper else b""


def reads_file(file: Path) -> None:
    """Tell that the running function reads ``file``, or whether it is there."""
    _tell("file", str(file))


def reads_folder(folder: Path) -> None:
    """Tell that the running function reads whatever lies in ``folder``."""
    _tell("folder", str(folder))


def reads_code(thing: object) -> None:
    """Tell that the running function depends on the code of a scene, ladder or function."""
    module = home_of(thing)
    _tell("code" if module else "unknown", module or "")


def asks(words: str) -> None:
    """Tell in ``words`` what the running function asks for: whoever finds its result, which asks
    for nothing, can ask for that himself, before it has to be made anew."""
    _tell("asked", words)


def reads_unknown() -> None:
    """Tell that nobody can say what the running function depends on: its result is not kept."""
    _tell("unknown", "")


def _tell(kind: str, name: str) -> None:
    if keeper := _at_work.get():
        keeper.hear((kind, name), keeper.state((kind, name)))


def _address(key: bytes, reads: Reads) -> bytes:
    return _hash(
        key, *(f"{kind} {name} ".encode() + reads[kind, name] for kind, name in sorted(reads))
    )


def _hash(*parts: bytes) -> bytes:
    digest = hashlib.blake2b(digest_size=SIZE)
    for part in parts:
        digest.update(len(part).to_bytes(4, "little") + part)
    return digest.digest()


SOURCES = _hash(b"sources")
"""The key of `Keeper._sources`."""
