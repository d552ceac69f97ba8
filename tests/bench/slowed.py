"""Run a program at a fraction of its speed: ``python slowed.py TIMES PROGRAM ARGUMENTS...``.

All its threads are stopped again and again, so that the work of the busiest one takes ``TIMES`` as
long. Time in which it waits for a processor counts too, so that other work on the machine has
little effect. Chromium's own throttle (``Emulation.setCPUThrottlingRate``) slows the page but not
its workers. Needs Linux.
"""

import os
import signal
import sys
import time
from pathlib import Path

RUN_S = 0.002
"""How long the program runs between two stops."""


def slowed_down(times: float) -> list[str]:
    """Arguments with which Chromium's pages and workers take ``times`` as long."""
    if times == 1:
        return []
    return [f"--renderer-cmd-prefix={sys.executable} {Path(__file__).resolve()} {times:g}"]


def main() -> None:
    times, program = float(sys.argv[1]), sys.argv[2:]
    slowed = os.getpid()
    if os.fork():
        os.execv(program[0], program)
    os.closerange(0, 1024)  # its pipes, which are to close when it ends
    last = run_s(slowed)
    while os.getppid() == slowed:
        begun = time.perf_counter()
        os.kill(slowed, signal.SIGCONT)
        time.sleep(RUN_S)
        os.kill(slowed, signal.SIGSTOP)
        now = run_s(slowed)
        ran = max((now[thread] - last.get(thread, 0.0) for thread in now), default=0.0)
        last = now
        time.sleep(max(begun + times * ran - time.perf_counter(), 0.0))


def run_s(process: int) -> dict[str, float]:
    """The running time of each thread in seconds, by thread."""
    found = {}
    for task in Path(f"/proc/{process}/task").glob("*/schedstat"):
        try:
            found[task.parent.name] = int(task.read_text().split()[0]) / 1e9
        except OSError:
            continue  # it has ended
    return found


if __name__ == "__main__":
    main()
