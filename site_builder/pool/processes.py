"""Jobs in a pool of processes, and the author's functions and objects as the builder has them.

The builder never imports a module of the book's. In the result of a job a `Remote` stands for each
function, class or object of the author's; in a later job it becomes that again. A job that takes
too long or ends its process is an error at the line that was running. What jobs print goes to the
standard error. Without `using_pool`, as in tests, they run in this process.
"""

import faulthandler
import io
import multiprocessing
import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, fields, is_dataclass, make_dataclass
from functools import partial
from tempfile import NamedTemporaryFile
from typing import Any, TextIO

from pebble import ProcessExpired, ProcessPool

from simulations.engine.controls import Control
from simulations.engine.controls.control import setting
from site_builder.cache.hashing import HOLDERS, hash_of, source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import place_in_trace, place_of, remember, words_of
from site_builder.diagnostics.progress import advance, counting
from site_builder.files.engine import ENGINE_PARTS

SECONDS = 60.0
"""Limit of a job by the clock."""
PRELOADED = ("site_builder.pool.processes", "simulations.registry")
"""Modules that most jobs import."""


class KilledError(RuntimeError):
    """The job took too long and was killed, or it ended its process."""


@dataclass(frozen=True, slots=True)
class _Pool:
    processes: ProcessPool
    """They start with the first job."""
    seconds: float
    killed: dict[object, KilledError] = field(default_factory=dict)
    """Errors by what the job is of, which is not tried again."""
    copies: dict[str, Any] = field(default_factory=dict)
    """Scenes and ladders without their code, by module."""


_active: _Pool | None = None


@contextmanager
def using_pool(seconds: float = SECONDS) -> Iterator[None]:
    """Within, jobs run in a pool of fresh processes, which share no thread or lock with this
    one."""
    global _active
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([*PRELOADED])
    processes = ProcessPool(_cores(), initializer=_print_to_stderr, context=context)
    before, _active = _active, _Pool(processes, seconds)
    try:
        yield
    finally:
        _active = before
        processes.stop()  # type: ignore[no-untyped-call]
        processes.join()


def run_in_pool[T](job: Callable[[], T], of: object = None) -> T:
    """What ``job`` returns or raises. Raises `KilledError`, at once where another job ``of`` the
    same thing did so, and `TypeError` for a job that cannot be sent."""
    pool = _active
    if pool is None:
        return job()
    if of in pool.killed:
        raise pool.killed[of]
    try:
        pickled = pickle.dumps(job)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise TypeError(f"{error}; legal: data and functions of modules") from None
    try:
        good, answer = _answered(pickled, pool, f"{of!r} " if isinstance(of, str) else "")
    except KilledError as error:
        if of is not None:
            pool.killed[of] = error
        raise
    value = pickle.loads(answer)
    if not good:
        raise value
    return value  # type: ignore[no-any-return]


def copies() -> dict[str, Any] | None:
    """Scenes and ladders without their code, by module; None where there is no pool."""
    return _active.copies if _active else None


def side_by_side[T](jobs: Iterable[Callable[[], T]], what: str = "jobs") -> list[Future[T]]:
    """Each of ``jobs`` done; what of it calls `run_in_pool` runs on all cores. ``what`` they make
    is counted."""
    threads = ThreadPoolExecutor(_cores() if _active else 1)
    try:
        futures = [threads.submit(job) for job in jobs]
        with counting(what, len(futures)):
            for _ in as_completed(futures):
                advance()
    finally:
        threads.shutdown(wait=False, cancel_futures=True)
    return futures


def _cores() -> int:
    """How many processes can work at once."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def _answered(pickled: bytes, pool: _Pool, who: str) -> tuple[bool, bytes]:
    """The answer of a process. Raises `KilledError` that says ``who`` has none."""
    with NamedTemporaryFile() as trace:
        future = pool.processes.schedule(_answer, (pickled, trace.name), timeout=pool.seconds)
        try:
            return future.result()
        except TimeoutError:
            said = f"{who}takes more than {pool.seconds:g} s"
        except ProcessExpired as error:
            said = f"{who}ends its process, {_ending(error.exitcode)}"
        # As Python writes it: all beyond ASCII as escape sequences.
        text = trace.read().decode("unicode_escape", "replace")
    raise remember(KilledError(said), place_in_trace(text), said)


def _ending(code: int | None) -> str:
    """
    >>> _ending(3), _ending(-11)
    ('exit code 3', 'SIGSEGV')
    """
    found = (each.name for each in signal.Signals if each == -(code or 0))
    return next(found, f"exit code {code}")


def _print_to_stderr() -> None:
    """In a new process of the pool: the standard output has what the command says, as JSON."""
    with suppress(OSError):  # closed by what started the command
        os.dup2(2, 1)
    sys.stdout = sys.stderr


def _answer(pickled: bytes, trace: str) -> tuple[bool, bytes]:
    """In the pool: whether the job succeeded, and its result or exception."""
    with open(trace, "w") as file, _tracing(file):  # noqa: PTH123
        try:
            return True, packed(pickle.loads(pickled)())
        except BaseException as error:  # SystemExit, too
            return False, _portable(error)


@contextmanager
def _tracing(file: TextIO) -> Iterator[None]:
    """Within, what ends the process writes to ``file`` which lines were running: a fault of the
    processor, the pool's signal, and ``os._exit``."""
    leave = os._exit

    def end(status: int) -> None:
        faulthandler.dump_traceback(file)
        leave(status or 1)  # the pool would not miss a process that ends with 0

    faulthandler.enable(file)
    faulthandler.register(signal.SIGTERM, file, chain=True)
    os._exit = end  # type: ignore[assignment]
    try:
        yield
    finally:
        os._exit = leave
        faulthandler.unregister(signal.SIGTERM)
        faulthandler.disable()


def _portable(error: BaseException) -> bytes:
    """The error pickled, without its traceback: its place, and the words that come from there, go
    with it. One of an author's class is an error of ours."""
    place, words = place_of(error), words_of(error)
    kind = type(error)
    if isinstance(error, Exception) and not is_authors(kind.__module__):
        bare = remember(error.with_traceback(None), place, words)
        bare.__cause__ = bare.__context__ = None
        with suppress(Exception):  # it may need arguments to be made again
            data = packed(bare)
            pickle.loads(data)
            return data
    said = f"{kind.__name__}: {words}"
    return pickle.dumps(remember(RuntimeError(said), place, said))


def is_authors(module: str) -> bool:
    """Whether a module, by its full name, may be of the book's own."""
    package, _, rest = module.partition(".")
    part = rest.partition(".")[0]
    return package == "simulations" and (part == "models" or part not in ENGINE_PARTS)


@dataclass(frozen=True, slots=True)
class Remote:
    """An object of the author's, as the builder has it."""

    module: str
    pickled: bytes
    """Nothing where it has no name to be pickled by, as a ``lambda`` of a scene."""

    @property
    def cache_key(self) -> bytes:
        return hash_of("remote", self.pickled, source_hash(self.module))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return _attribute(self, name)

    def __reduce__(self) -> tuple[Any, ...]:
        return _remote, (type(self), self.module, self.pickled)


class RemoteFunction(Remote):
    """A function or class of the author's, which is called in the pool."""

    __slots__ = ()

    def __call__(self, *given: object, **named: object) -> Any:
        """Raises whatever the function does, and `KilledError`."""
        return _called(self, given, named)


def _remote(kind: type[Remote], module: str, pickled: bytes) -> Any:
    """In the builder a `Remote`, in the pool what it stands for."""
    if _active:
        return kind(module, pickled)
    if not pickled:
        raise TypeError(f"a function of {module} without a name; legal: one defined by 'def'")
    return pickle.loads(pickled)


@cached
def _called(
    function: RemoteFunction, given: tuple[object, ...], named: Mapping[str, object]
) -> Any:
    return run_in_pool(partial(_call, function, given, named), of=function)


def _call(
    function: Callable[..., Any], given: tuple[object, ...], named: Mapping[str, object]
) -> Any:
    return function(*given, **named)


@cached
def _attribute(remote: Remote, name: str) -> Any:
    return run_in_pool(partial(getattr, remote, name))


def packed(value: object) -> bytes:
    """The value as bytes that name no module of the author's."""
    buffer = io.BytesIO()
    _Packer(buffer, pickle.HIGHEST_PROTOCOL).dump(value)
    return buffer.getvalue()


class _Packer(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        kind = type(value)
        if kind in HOLDERS:  # whose own reduction is its name
            return value.__reduce_ex__(pickle.HIGHEST_PROTOCOL)
        if isinstance(value, type) and is_dataclass(value) and is_authors(value.__module__):
            controls = [each.metadata.get("control") for each in fields(value)]
            if controls and all(controls):
                return _settings, (value.__name__, [_entry(each) for each in fields(value)])
        if callable(value):
            module = getattr(value, "__module__", None) or kind.__module__
            has_name = "<" not in getattr(value, "__qualname__", "<object>")
            is_found = has_name and not is_authors(module)
            return NotImplemented if is_found else (RemoteFunction, (module, _pickled_name(value)))
        if is_authors(kind.__module__):
            return Remote, (kind.__module__, pickle.dumps(value))
        return NotImplemented


def _pickled_name(function: object) -> bytes:
    try:
        return pickle.dumps(function)
    except (pickle.PicklingError, AttributeError, TypeError):
        return b""


def _entry(each: Any) -> tuple[str, Any, Control]:
    return each.name, each.type, each.metadata["control"](name=each.name)


def _settings(title: str, entries: Iterable[tuple[str, Any, Control]]) -> type[Any]:
    """A dataclass of settings with these controls."""

    def default_field(control: Control) -> Any:
        return setting(control.default, lambda **_name: control)

    given = [(name, kind, default_field(control)) for name, kind, control in entries]
    return make_dataclass(title, given, frozen=True, slots=True)
