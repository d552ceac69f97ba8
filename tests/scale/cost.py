"""What a command costs: processor, clock and memory; and how that grows."""

import math
import os
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

KIB = 1024
"""Bytes in a unit of ``ru_maxrss``, on Linux."""


@dataclass(frozen=True, slots=True)
class Cost:
    """Of one command, with the processes that it starts."""

    cpu_s: float
    wall_s: float
    peak_mb: float
    """Of the largest of its processes."""


def cost_of(command: Sequence[str], folder: Path, settings: Mapping[str, str]) -> Cost:
    """Run it in ``folder``. Raises `RuntimeError`, with what it printed, where it fails."""
    begin = time.perf_counter()
    output = folder / "output.txt"
    with output.open("wb") as told:
        process = subprocess.Popen(
            command, cwd=folder, env={**_environment(), **settings}, stdout=told, stderr=told
        )
        _, status, used = os.wait4(process.pid, 0)
    wall_s = time.perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"{' '.join(command)}\n{output.read_text(errors='replace')[-3000:]}")
    return Cost(used.ru_utime + used.ru_stime, wall_s, used.ru_maxrss * KIB / 1e6)


def _environment() -> dict[str, str]:
    """Compiled modules are kept: an installer compiles those of others, nobody those of ours."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}


def growth(sizes: Sequence[int], costs: Sequence[float]) -> float:
    """The power of the size with which a cost grows, by least squares; NaN of a single size."""
    if len(sizes) < 2:
        return math.nan
    x, y = [math.log(size) for size in sizes], [math.log(cost) for cost in costs]
    x_mean, y_mean = sum(x) / len(x), sum(y) / len(y)
    up = sum((a - x_mean) * (b - y_mean) for a, b in zip(x, y, strict=True))
    return up / sum((a - x_mean) ** 2 for a in x)
