"""Time limits for waits, longer while the machine is slow or busy with other work."""

import os
import time

QUIET_S = 0.011
"""Duration of `_work` on a quiet machine with two cores."""
FRESH_S = 5.0
"""How long a measurement stays valid."""
SLOWEST = 6.0
LIMIT_S = 30.0
"""The longest wait on a quiet machine; a wait ends as soon as its event occurs."""
LONGEST_S = LIMIT_S * SLOWEST
"""The longest wait, for limits that are set once."""

_measured = (-FRESH_S, 1.0)


def slowness() -> float:
    """The ratio of the present duration of work to its duration on a quiet machine, from 1 to
    `SLOWEST`."""
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
    """The limit in milliseconds, for browsers."""
    return 1000 * limit_s()


def _work() -> int:
    return sum(number % 7 for number in range(200_000))
