"""Authors' code in processes with limits of time and memory.

A scene that never ends, sleeps, or fills the memory is then a mistake like any other, and what it
prints is a warning. Without `limited`, as in tests, the code runs in this process.
"""

import functools
import io
import math
import multiprocessing
import os
import pickle
import signal
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any, Never

from pebble import ProcessExpired, ProcessPool

from site_builder.cache.results import keep_out
from site_builder.diagnostics.blame import place_here, place_of, remember, words_of
from site_builder.sandbox.data import packed, unpacked
from site_builder.sandbox.fence import raise_fence

GRACE_S = 2.0
"""After which a process that does not react to the alarm, as in a call into numpy, is killed."""
PRELOADED = ("site_builder.sandbox.pool", "site_builder.cache.results", "simulations.registry")
"""Modules that most jobs import."""
REFERENCE_S = 0.006
"""Processor's time of `_slowness` on a common machine."""
SLOWEST = 8.0
"""How many times as slow a machine can be, before its limits no longer grow."""
MOST_PRINTED = 200
"""Letters of a job's output that are kept."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What one call may take."""

    seconds: float = 10.0
    """Seconds of computing, and seconds of waiting, on a common machine; a slower one has more."""
    wall_seconds: float = 90.0
    """Limit by the clock, for what reacts to no signal."""
    bytes: int = 4_000_000_000
    """Bytes of memory, beside what its process has at the start."""


class LimitError(RuntimeError):
    """The code took too long, or ended its process."""


@dataclass(slots=True)
class _Sandbox:
    limits: Limits
    pool: ProcessPool
    """It starts with the first job."""
    failures: dict[bytes, Exception] = field(default_factory=dict)
    """Errors by job: what failed is not tried again, as it may take all its time again."""
    overdue: dict[str, LimitError] = field(default_factory=dict)
    """Errors by what the job is of."""
    running: set[Future[Any]] = field(default_factory=set)
    printed: dict[str, str] = field(default_factory=dict)
    """What the code printed, by the line that did first."""
    copies: dict[str, Any] = field(default_factory=dict)
    """Scenes and ladders without their code, by module."""


_active: _Sandbox | None = None


@contextmanager
def limited(limits: Limits | None) -> Iterator[None]:
    """Within, `run_limited` has these limits."""
    global _active
    before = _active
    _active = _Sandbox(limits, _make_pool(limits)) if limits else None
    try:
        yield
    finally:
        ended, _active = _active, before
        if ended:
            for future in [*ended.running]:  # or its thread would never end
                future.cancel()
            ended.pool.stop()  # type: ignore[no-untyped-call]
            ended.pool.join()


def run_limited[T](job: Callable[[], T], of: str = "") -> T:
    """What ``job`` returns or raises. Raises `LimitError`, at once where another job ``of`` this
    scene did so, and `TypeError` for a job that cannot be sent."""
    if _active is None:
        return job()
    try:
        pickled = pickle.dumps(job)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise TypeError(f"{error}; legal: data and functions of modules") from None
    if known := _active.failures.get(pickled) or _active.overdue.get(of):
        raise known
    try:
        return _result(pickled, _active)  # type: ignore[no-any-return]
    except Exception as error:
        _active.failures[pickled] = error
        if of and isinstance(error, LimitError):
            _active.overdue[of] = error
        raise


def copies() -> dict[str, Any] | None:
    """Scenes and ladders without their code, by module; None where no limits hold."""
    return _active.copies if _active else None


def printed() -> Iterator[tuple[str, int, str]]:
    """File, line and text of what the code printed."""
    for place, text in (_active.printed if _active else {}).items():
        path, _, line = place.rpartition(":")
        yield path, int(line), text


def side_by_side[T](jobs: Iterable[Callable[[], T]]) -> list[Future[T]]:
    """Each of ``jobs`` done; what of it calls `run_limited` runs on all cores."""
    threads = ThreadPoolExecutor(_cores() if _active else 1)
    try:
        futures = [threads.submit(job) for job in jobs]
        wait(futures)
    finally:
        threads.shutdown(wait=False, cancel_futures=True)
    return futures


def _cores() -> int:
    """How many processes can work at once."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def _result(pickled: bytes, sandbox: _Sandbox) -> Any:
    limits = sandbox.limits
    future = sandbox.pool.schedule(
        _answer, args=(pickled, limits), timeout=limits.wall_seconds + GRACE_S
    )
    sandbox.running.add(future)
    try:
        good, answer, place, text = future.result()
    except TimeoutError:
        raise LimitError(_too_long(limits.wall_seconds)) from None
    except ProcessExpired as error:
        if error.exitcode == -signal.SIGXCPU:
            raise LimitError(_too_long(limits.seconds)) from None
        raise LimitError(f"its process was ended by {_ender(error.exitcode)}") from None
    finally:
        sandbox.running.discard(future)
    if text:
        sandbox.printed.setdefault(place, text)
        keep_out()
    value = unpacked(answer)
    if not good:
        raise value
    return value


def _make_pool(limits: Limits) -> ProcessPool:
    """A pool of fresh processes, which share no thread or lock with this one."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([*PRELOADED])
    return ProcessPool(_cores(), initializer=_fence, initargs=(limits.bytes,), context=context)


def _answer(pickled: bytes, limits: Limits) -> tuple[bool, bytes, str, str]:
    """In the pool: whether the job succeeded, and its result or exception; the line that printed
    first, and the beginning of what was printed."""
    output = _Output()
    try:
        with redirect_stdout(output), redirect_stderr(output), _clocks(limits.seconds), _no_exit():
            result = pickle.loads(pickled)()
        answer = True, packed(result)
    except Exception as error:
        answer = False, _portable(error)
    except BaseException as error:  # or it would end the build without a word
        answer = False, _portable(_told(error))
    return *answer, output.place, output.text


class _Output(io.TextIOBase):
    """Where the code prints."""

    def __init__(self) -> None:
        self.place = self.text = ""

    def write(self, text: str) -> int:
        if not self.text:
            self.place = place_here() or "simulations:1"
        self.text += text[: MOST_PRINTED - len(self.text)]
        return len(text)


@contextmanager
def _clocks(seconds: float) -> Iterator[None]:
    """Raises `LimitError` at the line that is running when the time for computing or for waiting is
    over. Code that reacts to no signal while it computes is ended by the system."""
    allowed, begun = seconds * _slowness(), time.monotonic() - _busy_s()
    _end_process_after(time.process_time() + allowed + GRACE_S)

    def overdue(_signal: int, _frame: FrameType | None) -> Never:
        raise LimitError(_too_long(seconds))

    def look(_signal: int, _frame: FrameType | None) -> None:
        if time.monotonic() - _busy_s() - begun > allowed:
            raise LimitError(f"waits for more than {seconds:g} s")

    signal.signal(signal.SIGPROF, overdue)
    signal.signal(signal.SIGALRM, look)
    signal.setitimer(signal.ITIMER_PROF, allowed)
    signal.setitimer(signal.ITIMER_REAL, allowed, min(0.5, allowed))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)


@functools.cache
def _slowness() -> float:
    """How many times as long as a common machine this one takes to compute, at least 1."""
    taken = []
    for _ in range(5):
        start = time.process_time()
        sum(number * number for number in range(100_000))
        taken.append(time.process_time() - start)
    return min(max(1.0, min(taken) / REFERENCE_S), SLOWEST)


def _busy_s() -> float:
    """Seconds that the process has computed or stood in line for a processor."""
    try:
        in_line_ns = int(Path("/proc/self/schedstat").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        in_line_ns = 0
    return time.process_time() + in_line_ns / 1e9


def _end_process_after(seconds: float) -> None:
    """Have the system end the process once it has computed for so long in all."""
    if sys.platform == "win32":
        return
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), most))


@contextmanager
def _no_exit() -> Iterator[None]:
    """Make ``os._exit`` an error of the line that calls it; a process that it ends with 0 would not
    be missed."""

    def end(status: int) -> Never:
        raise LimitError(f"ends the program by os._exit({status})")

    before = os._exit
    for module in (os, sys.modules[os.name]):
        vars(module)["_exit"] = end
    try:
        yield
    finally:
        for module in (os, sys.modules[os.name]):
            vars(module)["_exit"] = before


def _told(error: BaseException) -> Exception:
    """An exception that ends programs, as one that does not: ``SystemExit: 2``."""
    words = words_of(error)
    said = f"ends the program by {type(error).__name__}{words and f': {words}'}"
    return remember(LimitError(said), place_of(error), said)


def _portable(error: Exception) -> bytes:
    """The error pickled, which is without its traceback: its place, and the words that come from
    there, go with it."""
    place, words = place_of(error), words_of(error)
    bare = remember(error.with_traceback(None), place, words)
    bare.__cause__ = bare.__context__ = None
    try:
        data = pickle.dumps(bare)
        unpacked(data)
    except Exception:  # a class of the author's, or one that needs arguments to be made again
        said = f"{type(error).__name__}: {words}"
        return pickle.dumps(remember(RuntimeError(said), place, said))
    return data


def _too_long(seconds: float) -> str:
    return f"takes more than {seconds:g} s"


def _ender(code: int | None) -> str:
    if not code or code > 0:
        return f"its own code, as {code}"
    return next((each.name for each in signal.Signals if each == -code), f"signal {-code}")


def _fence(more_bytes: int) -> None:
    """In a process of the pool: its memory, output, files and network."""
    _limit_memory(more_bytes)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)  # where libraries print, and JSON is printed by the builder
    os.close(nowhere)
    raise_fence()


def _limit_memory(more: int) -> None:
    """Allow so many bytes more than the process has now, where the system can limit it."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    wanted = pages * resource.getpagesize() + more
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    if most == resource.RLIM_INFINITY or wanted < most:
        resource.setrlimit(resource.RLIMIT_AS, (wanted, most))
