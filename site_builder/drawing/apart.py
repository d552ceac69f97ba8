"""The authors' own code run in a process of its own, which may take so long and so much memory.

A scene that never ends, or fills the memory, is then a mistake like any other. Without `limited`,
as in tests, the code simply runs. To begin a process takes longer than most drawings: one does all
that can be told to it, until something fails there; what cannot be told has a process of its own.
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
from struct import Struct
from types import FrameType
from typing import Any, Never

from site_builder.blame import place_of, remember_place
from site_builder.forking import CAN_FORK, forked
from site_builder.kept.packing import packed, unpacked
from site_builder.raised import remember_words, words_of

GRACE_S = 2.0
"""How long the code may ignore that its time is over, as a call into numpy does, until it is
killed."""
PATIENCE = 4.0
"""How much longer it may take by the clock than of the processor, which it shares with others."""
CHUNK = 1 << 20
LENGTH = Struct("=Q")
"""Stands before a job, and before an answer."""


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
        _end_drawer()


def apart[T](job: Callable[[], T]) -> T:
    """What ``job`` returns, or raises, in a process that is gone when the limits are. Raises
    `LimitError`."""
    limits = _limits.get()
    if limits is None or not CAN_FORK:
        return job()
    try:
        told = packed(job)
    except (pickle.PicklingError, AttributeError, TypeError):
        answer, status = _once(job, limits)
    else:
        answer, status = _drawer_for(limits).do(told)
    if not answer:
        ended = f"its process was ended by {_signal_name(status)}"
        raise remember_place(LimitError(_too_long(limits) if answer is None else ended), "")
    good, value = pickle.loads(answer)
    if not good:
        _end_drawer()  # whatever the failure has left behind there
        raise value
    return value  # type: ignore[no-any-return]


def _once(job: Callable[[], object], limits: Limits) -> tuple[bytes | None, int]:
    """The answer of a process that does nothing else: empty where it ended without one, None where
    it took too long; and the status that it ended with."""
    reader, writer = os.pipe()

    def life() -> None:
        os.close(reader)
        _limit_memory(limits.bytes)
        _write(_answer(job), writer)

    child = forked(life)
    os.close(writer)
    try:
        answer = _read(reader, _latest(limits))
    finally:
        os.close(reader)
        status = _ended(child)
    return answer, status


@dataclass(slots=True)
class _Drawer:
    """A process that does one job after the other, for the one that has begun it."""

    limits: Limits
    owner: int
    process: int
    jobs: int
    """The end of the pipe that jobs are written to."""
    answers: int

    def do(self, told: bytes) -> tuple[bytes | None, int]:
        """As `_once`; one that ends, or takes too long, is gone."""
        until = _latest(self.limits)
        answer: bytes | None = b""
        try:
            with suppress(BrokenPipeError):
                _write(LENGTH.pack(len(told)) + told, self.jobs)
            answer = _read(self.answers, until, LENGTH.size)
            if answer:
                answer = _read(self.answers, until, *LENGTH.unpack(answer))
        except BaseException:
            _end_drawer()
            raise
        return answer, 0 if answer else _end_drawer()


_drawer: _Drawer | None = None


def _drawer_for(limits: Limits) -> _Drawer:
    """That of this process and of these limits."""
    global _drawer
    if _drawer is None or (_drawer.owner, _drawer.limits) != (os.getpid(), limits):
        _end_drawer()
        _drawer = _begin_drawer(limits)
    return _drawer


def _begin_drawer(limits: Limits) -> _Drawer:
    (wanted, jobs), (answers, found) = os.pipe(), os.pipe()

    def life() -> None:
        os.close(jobs)
        os.close(answers)
        _limit_memory(limits.bytes)
        while length := _read(wanted, None, LENGTH.size):
            told = _read(wanted, None, *LENGTH.unpack(length)) or b""
            answer = _answer(lambda told=told: unpacked(told)())  # type: ignore[misc]
            _write(LENGTH.pack(len(answer)) + answer, found)

    child = forked(life)
    os.close(wanted)
    os.close(found)
    return _Drawer(limits, os.getpid(), child, jobs, answers)


def _end_drawer() -> int:
    """Let go of it, whatever it does; the status that it ended with. In a process that was forked,
    of what it has of another's."""
    global _drawer
    gone, _drawer = _drawer, None
    if gone is None:
        return 0
    os.close(gone.jobs)
    os.close(gone.answers)
    return _ended(gone.process) if gone.owner == os.getpid() else 0


def _ended(child: int) -> int:
    """The status of a process that is made to end, if it has not yet done so."""
    with suppress(ProcessLookupError):
        os.kill(child, signal.SIGKILL)
    return os.waitpid(child, 0)[1]


def _latest(limits: Limits) -> float:
    return time.monotonic() + PATIENCE * limits.seconds + GRACE_S


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


def _answer(job: Callable[[], Any]) -> bytes:
    """What comes of it, to be sent."""
    try:
        with in_time():
            answer = (True, job())
        return pickle.dumps(answer)
    except Exception as error:
        return _failure(error)


def _write(data: bytes, writer: int) -> None:
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


def _read(reader: int, until: float | None, size: int | None = None) -> bytes | None:
    """So many bytes, or everything up to the end; nothing where that comes before ``size`` bytes;
    None where it does not come in time."""
    pieces: list[bytes] = []
    left = size
    while left != 0:
        wait = None if until is None else max(0.0, until - time.monotonic())
        ready, _, _ = select.select([reader], [], [], wait)
        if not ready:
            return None
        piece = os.read(reader, CHUNK if left is None else min(left, CHUNK))
        if not piece:
            return b"".join(pieces) if left is None else b""
        pieces.append(piece)
        left = None if left is None else left - len(piece)
    return b"".join(pieces)


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
