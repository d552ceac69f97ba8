"""Code of authors runs within limits, and its errors come back as they were."""

import os
import signal
import time
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from support.small_package import PACKAGE, small_package

from site_builder.blame import place_of
from site_builder.drawing.apart import LimitError, Limits, apart, in_time, limited

QUICK = Limits(seconds=0.3)


def test_what_the_code_returns_comes_back() -> None:
    with limited(Limits()):
        assert apart(lambda: (os.getpid(), np.arange(3).sum()))[1] == 3
        assert apart(os.getpid) != os.getpid()


def test_without_limits_it_simply_runs() -> None:
    assert apart(os.getpid) == os.getpid()


def forever() -> None:
    while True:
        pass


def deaf() -> None:
    """Ignores that its time is over, as a call into a library does."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGPROF, signal.SIGALRM])
    forever()


@pytest.mark.parametrize("endless", [forever, deaf])
def test_code_that_never_ends_is_ended(endless: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("site_builder.drawing.apart.GRACE_S", 0.5)
    with limited(QUICK), pytest.raises(LimitError, match=r"takes more than 0\.3 s"):
        apart(endless)  # type: ignore[arg-type]


def test_code_that_sleeps_is_ended() -> None:
    with limited(QUICK), pytest.raises(LimitError, match=r"takes more than 0\.3 s"):
        apart(lambda: time.sleep(60))


def test_an_import_that_never_ends_is_ended() -> None:
    with limited(QUICK), pytest.raises(LimitError, match="takes more than"), in_time():
        forever()


def test_code_that_fills_the_memory_is_told_so() -> None:
    with limited(Limits(bytes=200_000_000)), pytest.raises(MemoryError):
        apart(lambda: np.ones(1_000_000_000))


def test_code_that_ends_its_process_is_told_by_which_signal() -> None:
    with limited(Limits()), pytest.raises(LimitError, match="ended by SIGTERM"):
        apart(lambda: os.kill(os.getpid(), signal.SIGTERM))


class AwkwardError(Exception):
    """Cannot be made again from what it says."""

    def __init__(self, one: int, two: int) -> None:
        super().__init__(f"{one} and {two}")


def test_an_error_comes_back_as_it_was() -> None:
    with limited(Limits()), pytest.raises(ZeroDivisionError, match="division by zero"):
        apart(lambda: 1 / 0)


def test_an_error_that_cannot_be_sent_is_told_in_words() -> None:
    def fail() -> None:
        raise AwkwardError(1, 2)

    with limited(Limits()), pytest.raises(RuntimeError, match="AwkwardError: 1 and 2"):
        apart(fail)


def test_the_place_of_an_error_comes_back_with_it(tmp_path: Path) -> None:
    optics = "def focus():\n    raise ValueError('no image')\n"
    with small_package(tmp_path, {"optics": optics}):
        focus = import_module(f"{PACKAGE}.optics").focus
        with limited(Limits()), pytest.raises(ValueError, match="no image") as raised:
            apart(focus)
    assert place_of(raised.value).endswith("small/optics.py:2")


def test_nothing_is_left_running() -> None:
    with limited(Limits()):
        process = apart(os.getpid)
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


def test_what_can_be_told_is_done_by_one_process() -> None:
    with limited(Limits()):
        assert len({apart(os.getpid) for _ in range(3)}) == 1
        assert apart(lambda: os.getpid()) != apart(os.getpid)


def fail() -> None:
    raise ValueError(os.getpid())


def leave() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize(("job", "error"), [(fail, ValueError), (leave, LimitError)])
def test_after_a_failure_another_process_goes_on(job: object, error: type[Exception]) -> None:
    with limited(Limits()):
        before = apart(os.getpid)
        with pytest.raises(error):
            apart(job)  # type: ignore[arg-type]
        assert apart(os.getpid) not in (before, os.getpid())


def test_a_forked_process_has_one_of_its_own() -> None:
    with limited(Limits()):
        before = apart(os.getpid)
        assert apart(lambda: apart(os.getpid)) != before
        assert apart(os.getpid) == before


def test_much_is_told_and_comes_back() -> None:
    with limited(Limits()):
        many = np.arange(1_000_000)
        assert (apart(partial(np.flip, many)) == many[::-1]).all()
