"""Limits of time for waits: longer on a machine that is slow, or busy with other work, just now."""

import os
import time

QUIET_S = 0.011
"""What `_work` takes on a quiet machine of two cores."""
FRESH_S = 5.0
"""How long a measurement is taken for the present."""
SLOWEST = 6.0
LIMIT_S = 30.0
"""Longest wait on a quiet machine, for anything: a wait ends with its event."""

_measured = (-FRESH_S, 1.0)


def slowness() -> float:
    """How many times as long as on a quiet machine work takes now: 1 to `SLOWEST`."""
    global _measured
    at, found = _measured
    if time.monotonic() - at > FRESH_S:
        begun = time.perf_counter()
        _work()
        took = (time.perf_counter() - begun) / QUIET_S
        load = os.getloadavg()[0] / (os.cpu_count() or 1)
        found = min(max(1.0, took, load), SLOWEST)
        _measured = (time.monotonic(), found)
    return found


def limit_s() -> float:
    return LIMIT_S * slowness()


def limit_ms() -> float:
    """The same in milliseconds, as browsers take it."""
    return 1000 * limit_s()


def _work() -> int:
    return sum(number % 7 for number in range(200_000))
