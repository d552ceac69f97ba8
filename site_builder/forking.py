"""Processes that are forked from this one, do one thing, and are gone."""

import os
import signal
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from types import FrameType

CAN_FORK = hasattr(os, "fork")
BRIEF_S = 0.02
"""What a process that has said everything takes to be gone."""
GRACE_S = 2.0
"""How long one that was told to end may clear away what is half done, until it is killed."""
AGAIN_S = 0.1
"""A signal that comes just as a process falls asleep wakes it no more; the next one does."""
LOOK_S = 0.002


def forked(life: Callable[[], object]) -> int:
    """The number of a new process that does ``life`` and ends; with 1 where that raises."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of threads: the child starts none
        child = os.fork()
    if child:
        return child
    code = 1
    try:
        life()
        code = 0
    finally:
        os._exit(code)


def clear_away_when_ended() -> None:
    """For a process's life: told to end, it raises `KeyboardInterrupt` where it is, as the terminal
    does it, so that what is half done is cleared away. Only once: what clears away is not
    interrupted."""

    def heard(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        signal.default_int_handler(number, frame)

    signal.signal(signal.SIGTERM, heard)


def end_process(child: int, *pipes: int, grace_s: float = GRACE_S) -> int:
    """Wait until a forked process is gone, and see to it that it goes: our ends of its ``pipes``
    are closed, then it is told to end, again and again for ``grace_s``, then it is killed. Returns
    the status that it ended with."""
    for pipe in pipes:
        os.close(pipe)
    status = _status(child, BRIEF_S)
    until = time.monotonic() + grace_s
    while status is None and time.monotonic() < until:
        _send(child, signal.SIGTERM)
        status = _status(child, AGAIN_S)
    if status is None:
        _send(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
    return status


def _status(child: int, wait_s: float) -> int | None:
    """What it ended with, if it does so within that time."""
    until = time.monotonic() + wait_s
    while True:
        process, status = os.waitpid(child, os.WNOHANG)
        if process:
            return status
        if time.monotonic() > until:
            return None
        time.sleep(LOOK_S)


def _send(child: int, number: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(child, number)


def cores() -> int:
    """How many processes can be at work at once."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
