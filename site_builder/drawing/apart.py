"""The authors' own code run in a process of its own, which may take so long and so much memory.

A scene that never ends, or fills the memory, is then a mistake like any other. Without `limited`,
as in tests, the code simply runs.
"""

import os
import pickle
import select
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any, Never

from site_builder.blame import place_of, remember_place
from site_builder.forking import CAN_FORK, forked
from site_builder.raised import remember_words, words_of

GRACE_S = 2.0
"""How long the code may ignore that its time is over, as a call into numpy does, until it is
killed."""
PATIENCE = 4.0
"""How much longer it may take by the clock than of the processor, which it shares with others."""
CHUNK = 1 << 20


@dataclass(frozen=True, slots=True)
class Limits:
    """What one drawing may take."""

    seconds: float = 15.0
    """Of the processor's time."""
    bytes: int = 4_000_000_000
    """Of memory, beside what the builder has."""


class LimitError(RuntimeError):
    """The code took too long, or ended its process."""


_limits: ContextVar[Limits | None] = ContextVar("limits", default=None)


@contextmanager
def limited(limits: Limits | None) -> Iterator[None]:
    before = _limits.set(limits)
    try:
        yield
    finally:
        _limits.reset(before)


def apart[T](job: Callable[[], T]) -> T:
    """What ``job`` returns, or raises, in a process of its own that is gone afterwards. Raises
    `LimitError`."""
    limits = _limits.get()
    if limits is None or not CAN_FORK:
        return job()
    reader, writer = os.pipe()

    def life() -> None:
        os.close(reader)
        _answer(job, writer, limits)

    child = forked(life)
    os.close(writer)
    try:
        answer = _read_all(reader, time.monotonic() + PATIENCE * limits.seconds + GRACE_S)
    finally:
        os.close(reader)
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        status = os.waitpid(child, 0)[1]
    if not answer:
        ended = f"its process was ended by {_signal_name(status)}"
        raise remember_place(LimitError(_too_long(limits) if answer is None else ended), "")
    good, value = pickle.loads(answer)
    if not good:
        raise value
    return value  # type: ignore[no-any-return]


@contextmanager
def in_time() -> Iterator[None]:
    """For what must run here, as imports: raises `LimitError` in it where it takes too long."""
    limits = _limits.get()
    aside = threading.current_thread() is not threading.main_thread()
    if limits is None or aside or not hasattr(signal, "setitimer"):
        yield
        return
    alarm = _alarm(limits)
    before = {ring: signal.signal(ring, alarm) for ring in (signal.SIGPROF, signal.SIGALRM)}
    signal.setitimer(signal.ITIMER_PROF, limits.seconds)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE * limits.seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        for ring, handler in before.items():
            signal.signal(ring, handler)


def _answer(job: Callable[[], Any], writer: int, limits: Limits) -> None:
    """The child's whole life."""
    _limit_memory(limits.bytes)
    try:
        with in_time():
            answer = (True, job())
        data = pickle.dumps(answer)
    except Exception as error:
        data = _failure(error)
    view = memoryview(data)
    while view:
        view = view[os.write(writer, view[:CHUNK]) :]


def _failure(error: Exception) -> bytes:
    """The error as it can be sent, which is without its traceback: its place goes with it, and what
    its words take from there."""
    place, words = place_of(error), words_of(error)
    bare = remember_words(remember_place(error.with_traceback(None), place), words)
    bare.__cause__ = bare.__context__ = None
    try:
        data = pickle.dumps((False, bare))
        pickle.loads(data)
    except Exception:  # an error of a scene's own may need arguments to be made again
        told = RuntimeError(f"{type(error).__name__}: {error}")
        return pickle.dumps((False, remember_place(told, place)))
    return data


def _read_all(reader: int, until: float) -> bytes | None:
    """Everything up to the end; None where it does not come in time."""
    pieces: list[bytes] = []
    while True:
        ready, _, _ = select.select([reader], [], [], max(0.0, until - time.monotonic()))
        if not ready:
            return None
        piece = os.read(reader, CHUNK)
        if not piece:
            return b"".join(pieces)
        pieces.append(piece)


def _alarm(limits: Limits) -> Callable[[int, FrameType | None], Never]:
    def ring(_signal: int, _frame: FrameType | None) -> Never:
        raise LimitError(_too_long(limits))

    return ring


def _too_long(limits: Limits) -> str:
    return f"takes more than {limits.seconds:g} s"


def _signal_name(status: int) -> str:
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    return signal.Signals(number).name if number else "its own code"


def _limit_memory(more: int) -> None:
    """So many bytes beside what the process has now; where the system tells and keeps it."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    wanted = pages * resource.getpagesize() + more
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    if most == resource.RLIM_INFINITY or wanted < most:
        resource.setrlimit(resource.RLIMIT_AS, (wanted, most))
