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
from support.little_book import PACKAGE, small_package

from simulations.engine.frame import Readout
from simulations.engine.settings import values_of
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.sandbox.data import Code, packed, real, unpacked
from site_builder.sandbox.loading import held
from site_builder.sandbox.pool import (
    LimitError,
    Limits,
    limited,
    printed,
    run_limited,
    side_by_side,
)

QUICK = Limits(seconds=0.3, bytes=300_000_000)
HERE = Path(__file__)


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


class SilentError(AwkwardError):
    """Cannot be put into words."""

    def __str__(self) -> str:
        sys.exit("no words")


def fail_silently() -> None:
    raise SilentError(1, 2)


def interrupt() -> None:
    raise KeyboardInterrupt


def run_a_program() -> None:
    subprocess.run(["true"], check=True)


def look_for_a_server() -> None:
    socket.create_connection(("127.0.0.1", 9))


def write_a_file() -> None:
    Path("written").write_text("")


def print_a_lot() -> int:
    for number in range(100_000):
        print("line", number)
    os.write(1, b"past Python")
    return 1


def take_away_the_output() -> int:
    sys.stdout = sys.stderr = None
    return 2


FAILURES: list[tuple[Callable[[], object], type[Exception], str]] = [
    (loop, LimitError, "takes more than 0.3 s"),
    (ignore_the_alarm, LimitError, "takes more than 0.3 s"),
    (partial(time.sleep, 60), LimitError, "waits for more than 0.3 s"),
    (partial(np.ones, 1_000_000_000), MemoryError, "allocate"),
    (be_killed, LimitError, "ended by SIGKILL"),
    (partial(signal.raise_signal, 35), LimitError, "ended by signal 35"),
    *((partial(os._exit, n), LimitError, rf"ends the program by os._exit\({n}\)") for n in (0, 3)),
    (partial(sys.exit, 2), LimitError, "ends the program by SystemExit: 2"),
    (interrupt, LimitError, "ends the program by KeyboardInterrupt"),
    (Path("/etc/hostname").read_text, PermissionError, "reads '/etc/hostname'; legal"),
    (Path("content/book.toml").read_text, PermissionError, "reads '.*book.toml'; legal"),
    (write_a_file, PermissionError, "writes '.*written'; legal"),
    (partial(os.truncate, HERE, 0), PermissionError, "shortens a file: .*; legal"),
    (partial(os.rename, HERE, "a"), PermissionError, "renames a file: .*; legal"),
    (partial(os.mkdir, "made"), PermissionError, "makes a folder: 'made'; legal"),
    (partial(os.link, HERE, "a"), PermissionError, "makes a link: .*; legal"),
    (partial(os.symlink, HERE, "a"), PermissionError, "makes a link: .*; legal"),
    (partial(os.chmod, HERE, 0o600), PermissionError, "changes a file: .*; legal"),
    (partial(os.utime, HERE), PermissionError, "changes a file: .*; legal"),
    (partial(os.rename, "__pycache__/a", "a"), PermissionError, "renames a file: .*; legal"),
    (os.fork, PermissionError, "starts a process; legal"),
    (run_a_program, PermissionError, "starts a program: 'true'; legal"),
    (look_for_a_server, PermissionError, "address: '127.0.0.1'; legal"),
    (partial(divmod, 1, 0), ZeroDivisionError, "zero"),
    (fail_awkwardly, RuntimeError, "AwkwardError: 1 and 2"),
    (fail_silently, RuntimeError, r"SilentError: <exception str\(\) failed>"),
    (partial(Readout, "a", None, "1"), TypeError, "label None of a Readout; legal"),  # type: ignore[arg-type]
    (partial(Readout, "a", "A\ud800", "1"), TypeError, r"label 'A\\ud800' of a Readout; legal"),
    (lambda: 1, TypeError, "legal: data and functions of modules"),
]


@pytest.mark.parametrize(("job", "error", "words"), FAILURES)
def test_a_failure_is_reported_and_the_next_job_runs(
    job: Callable[[], object], error: type[Exception], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("site_builder.sandbox.pool.GRACE_S", 0.5)
    with pytest.raises(error, match=words):
        run_limited(job)
    assert run_limited(partial(divmod, 7, 4)) == (1, 3)


SCENE = """
from dataclasses import dataclass
from simulations.engine.scene import Scene
from simulations.engine.settings import slider

@dataclass(frozen=True, slots=True)
class Settings:
    depth: float = slider("Depth", 5.0, 0, 10, 0.5)

print("imported", "\\x1b[31m")
SCENE = Scene("scene", "A scene", Settings, lambda settings, outputs: 1 / 0)
"""


def test_output_is_cut_and_kept_with_its_line_and_reaches_nobody(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with limited(Limits()), small_package(tmp_path, {"scene": SCENE}):
        assert [run_limited(job) for job in (print_a_lot, take_away_the_output)] == [1, 2]
        scene = held(f"{PACKAGE}.scene", partial(real, Code(f"{PACKAGE}.scene", "SCENE")))
        kept = {(path, line): text for path, line, text in printed()}
        assert f"{PACKAGE}.scene" not in sys.modules
    assert scene.check({"depth": 2.5}).depth == 2.5
    assert len(kept["simulations", 1]) < 1000
    assert kept["simulations/small/scene.py", 10].startswith("imported")
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_a_copy_of_a_scene_has_what_the_builder_reads(scene_id: str) -> None:
    scene = load_scene(scene_id)
    copy = unpacked(packed(scene))
    assert copy.controls == scene.controls
    assert values_of(copy.check({})) == values_of(scene.check({}))
    assert copy.title == scene.title
    for name in ("names", "default", "ladder"):
        assert getattr(copy.accuracy, name) == getattr(scene.accuracy, name)
    for name in ("photograph", "measures_photographs"):
        assert getattr(copy.instrument, name) == getattr(scene.instrument, name)
    assert [each.drives for each in copy.handles] == [each.drives for each in scene.handles]


def fail_at_this_moment() -> None:
    raise ValueError(time.monotonic_ns())


def test_a_job_that_failed_is_not_tried_again() -> None:
    moments = []
    for _ in range(2):
        with pytest.raises(ValueError, match=r"\d") as raised:
            run_limited(fail_at_this_moment)
        moments.append(str(raised.value))
    assert moments[0] == moments[1]


def test_a_scene_that_ran_out_of_time_is_not_drawn_again() -> None:
    for job in (partial(time.sleep, 61), os.getpid):
        with pytest.raises(LimitError, match="waits for more"):
            run_limited(job, "scene")


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
