"""Authors' code runs within limits, and its errors come back as they were."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from site_builder.sandbox.pool import LimitError, Limits, limited, run_limited, side_by_side

QUICK = Limits(seconds=0.3, wall_seconds=60.0, bytes=300_000_000)
"""The clock runs faster than the processor's time, on a busy machine many times as fast."""
WAITING_S = 0.5
"""Limit by the clock of jobs that end by no other."""


@pytest.fixture(scope="module", autouse=True)
def sandbox() -> Iterator[None]:
    with limited(QUICK):
        yield


def test_code_runs_in_another_process() -> None:
    assert run_limited(os.getpid) != os.getpid()


def test_without_limits_code_runs_here() -> None:
    with limited(None):
        assert run_limited(os.getpid) == os.getpid()


def test_nothing_is_left_running() -> None:
    with limited(Limits()):
        process = run_limited(os.getpid)
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


def loop() -> None:
    while True:
        pass


def ignore_the_alarm() -> None:
    """Block the signals, as a call into a library does."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGALRM, signal.SIGPROF])
    loop()


def be_killed() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


class AwkwardError(Exception):
    """Cannot be made again from its message."""

    def __init__(self, one: int, two: int) -> None:
        super().__init__(f"{one} and {two}")


def fail_awkwardly() -> None:
    raise AwkwardError(1, 2)


def exit_at_once() -> None:
    os._exit(3)


def interrupt() -> None:
    raise KeyboardInterrupt


def run_a_program() -> None:
    subprocess.run(["true"], check=True)


def look_for_a_server() -> None:
    socket.create_connection(("127.0.0.1", 9))


def write_a_file() -> None:
    Path("written").write_text("")


WAITING: list[Callable[[], object]] = [ignore_the_alarm, partial(time.sleep, 60)]
FAILURES: list[tuple[Callable[[], object], type[Exception], str]] = [
    (loop, LimitError, "takes more than 0.3 s"),
    *((job, LimitError, "takes more than 0.5 s") for job in WAITING),
    (partial(np.ones, 1_000_000_000), MemoryError, "allocate"),
    (be_killed, LimitError, "ended by SIGKILL"),
    (exit_at_once, LimitError, "ended by its own code, as 3"),
    (partial(sys.exit, 2), LimitError, "ends the program by SystemExit: 2"),
    (interrupt, LimitError, "ends the program by KeyboardInterrupt"),
    (Path("/etc/hostname").read_text, PermissionError, "reads '/etc/hostname'; legal"),
    (write_a_file, PermissionError, "writes '.*written'; legal"),
    (run_a_program, PermissionError, "starts a program: 'true'; legal"),
    (look_for_a_server, PermissionError, "address: '127.0.0.1'; legal"),
    (partial(divmod, 1, 0), ZeroDivisionError, "zero"),
    (fail_awkwardly, RuntimeError, "AwkwardError: 1 and 2"),
]


@pytest.mark.parametrize(("job", "error", "words"), FAILURES)
def test_a_failure_is_reported_and_the_next_job_runs(
    job: Callable[[], object], error: type[Exception], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("site_builder.sandbox.pool.GRACE_S", 0.5)
    with pytest.raises(error, match=words):
        run_limited(job, WAITING_S if job in WAITING else QUICK.wall_seconds)
    assert run_limited(partial(divmod, 7, 4)) == (1, 3)


def fail_at_this_moment() -> None:
    raise ValueError(time.monotonic_ns())


def test_a_job_that_failed_is_not_tried_again() -> None:
    moments = []
    for _ in range(2):
        with pytest.raises(ValueError, match=r"\d") as raised:
            run_limited(fail_at_this_moment)
        moments.append(str(raised.value))
    assert moments[0] == moments[1]


def test_jobs_side_by_side_give_their_results_in_order() -> None:
    jobs = [partial(run_limited, partial(divmod, number, 4)) for number in range(9)]
    assert [done.result() for done in side_by_side(jobs)] == [divmod(n, 4) for n in range(9)]


def test_jobs_that_run_when_their_limits_end_are_cancelled() -> None:
    threads = ThreadPoolExecutor(1)
    with limited(Limits()):
        waiting = threads.submit(run_limited, partial(time.sleep, 60))
        run_limited(os.getpid)  # by when the other job has begun, too
    with pytest.raises((CancelledError, LimitError)):
        waiting.result(timeout=50)
    threads.shutdown()
