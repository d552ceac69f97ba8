"""Processes that are forked from this one, do one thing, and are gone."""

import os
import warnings
from collections.abc import Callable

CAN_FORK = hasattr(os, "fork")


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


def cores() -> int:
    """How many processes can be at work at once."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
