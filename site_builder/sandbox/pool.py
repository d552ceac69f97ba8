"""Authors' code in processes with limits of time and memory.

A scene that never ends, sleeps, or fills the memory is then a mistake like any other. Without
`limited`, as in tests, the code runs in this process.
"""

import math
import multiprocessing
import os
import pickle
import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import FrameType
from typing import Any, Never

from pebble import ProcessExpired, ProcessPool

from site_builder.diagnostics.blame import place_of, remember, words_of
from site_builder.sandbox.fence import raise_fence

GRACE_S = 2.0
"""After which a process that does not react to the alarm, as in a call into numpy, is killed."""
PRELOADED = ("site_builder.sandbox.pool", "site_builder.cache.results", "simulations.registry")
"""Modules that most jobs import."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What one call may take."""

    seconds: float = 10.0
    """Seconds of computing: on a busy machine, the clock runs faster."""
    wall_seconds: float = 60.0
    """Limit by the clock, for code that sleeps or waits."""
    bytes: int = 4_000_000_000
    """Bytes of memory, beside what its process has at the start."""


class LimitError(RuntimeError):
    """The code took too long, or ended its process."""


@dataclass(slots=True)
class _Sandbox:
    limits: Limits
    pool: ProcessPool
    """It starts with the first job."""
    failures: dict[bytes, Exception]
    """Errors by job: what failed is not tried again, as it may take all its time again."""
    running: set[Future[Any]]


_active: _Sandbox | None = None


@contextmanager
def limited(limits: Limits | None) -> Iterator[None]:
    """Within, `run_limited` has these limits."""
    global _active
    before = _active
    _active = _Sandbox(limits, _make_pool(limits), {}, set()) if limits else None
    try:
        yield
    finally:
        ended, _active = _active, before
        if ended:
            for future in [*ended.running]:  # or its thread would never end
                future.cancel()
            ended.pool.stop()  # type: ignore[no-untyped-call]
            ended.pool.join()


def run_limited[T](job: Callable[[], T], wall_seconds: float = math.inf) -> T:
    """What ``job`` returns or raises, within ``wall_seconds`` if that is less than the limit; a job
    that cannot be pickled runs in this process. Raises `LimitError`."""
    if _active is None:
        return job()
    try:
        pickled = pickle.dumps(job)
    except (pickle.PicklingError, AttributeError, TypeError):
        return job()
    if pickled in _active.failures:
        raise _active.failures[pickled]
    try:
        limits = replace(
            _active.limits, wall_seconds=min(wall_seconds, _active.limits.wall_seconds)
        )
        return _result(pickled, limits, _active)  # type: ignore[no-any-return]
    except Exception as error:
        _active.failures[pickled] = error
        raise


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


def _result(pickled: bytes, limits: Limits, sandbox: _Sandbox) -> Any:
    future = sandbox.pool.schedule(
        _answer, args=(pickled, limits), timeout=limits.wall_seconds + GRACE_S
    )
    sandbox.running.add(future)
    try:
        good, value = future.result()
    except TimeoutError:
        raise LimitError(_too_long(limits.wall_seconds)) from None
    except ProcessExpired as error:
        raise LimitError(f"its process was ended by {_ender(error.exitcode)}") from None
    finally:
        sandbox.running.discard(future)
    if not good:
        raise value
    return value


def _make_pool(limits: Limits) -> ProcessPool:
    """A pool of fresh processes, which share no thread or lock with this one."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([*PRELOADED])
    return ProcessPool(_cores(), initializer=_fence, initargs=(limits.bytes,), context=context)


def _answer(pickled: bytes, limits: Limits) -> tuple[bool, Any]:
    """In the pool: whether the job succeeded, and its result or exception."""
    try:
        with (
            _alarm(signal.SIGPROF, signal.ITIMER_PROF, limits.seconds),
            _alarm(signal.SIGALRM, signal.ITIMER_REAL, limits.wall_seconds),
        ):
            answer = True, pickle.loads(pickled)()
        pickle.dumps(answer)
    except Exception as error:
        return False, _portable(error)
    except BaseException as error:  # or it would end the build without a word
        return False, _portable(_told(error))
    return answer


@contextmanager
def _alarm(number: signal.Signals, timer: int, seconds: float) -> Iterator[None]:
    """Raises `LimitError` at the line that is running when the time is over."""

    def ring(_signal: int, _frame: FrameType | None) -> Never:
        raise LimitError(_too_long(seconds))

    signal.signal(number, ring)
    signal.setitimer(timer, seconds)
    try:
        yield
    finally:
        signal.setitimer(timer, 0)


def _told(error: BaseException) -> Exception:
    """An exception that ends programs, as one that does not: ``SystemExit: 2``."""
    words = words_of(error)
    said = f"ends the program by {type(error).__name__}{words and f': {words}'}"
    return remember(LimitError(said), place_of(error), said)


def _portable(error: Exception) -> Exception:
    """The error as it can be pickled, which is without its traceback: its place, and the words that
    come from there, go with it."""
    place, words = place_of(error), words_of(error)
    bare = remember(error.with_traceback(None), place, words)
    bare.__cause__ = bare.__context__ = None
    try:
        pickle.loads(pickle.dumps(bare))
    except Exception:  # an error of a scene's own may need arguments to be made again
        said = f"{type(error).__name__}: {error}"
        return remember(RuntimeError(said), place, said)
    return bare


def _too_long(seconds: float) -> str:
    return f"takes more than {seconds:g} s"


def _ender(code: int | None) -> str:
    return signal.Signals(-code).name if code and code < 0 else f"its own code, as {code}"


def _fence(more_bytes: int) -> None:
    """In a process of the pool: its memory, files and network."""
    _limit_memory(more_bytes)
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
