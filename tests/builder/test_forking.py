"""A forked process is gone when it is asked to be, whatever it does and whatever it has heard."""

import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder.forking import CAN_FORK, clear_away_when_ended, end_process, forked

pytestmark = pytest.mark.skipif(not CAN_FORK, reason="this system cannot fork")


def test_one_that_is_done_is_not_told_to_end() -> None:
    child = forked(lambda: None)
    assert os.waitstatus_to_exitcode(end_process(child)) == 0


def test_one_that_fails_ends_with_1() -> None:
    def fail() -> None:
        os.close(2)  # what it would say
        raise ValueError

    assert os.waitstatus_to_exitcode(end_process(forked(fail))) == 1


def test_one_that_is_told_to_end_clears_away_what_is_half_done(tmp_path: Path) -> None:
    def work() -> None:
        clear_away_when_ended()
        try:
            (tmp_path / "begun").touch()
            time.sleep(60)
        finally:
            (tmp_path / "cleared").touch()

    child = forked(work)
    _wait_for((tmp_path / "begun").is_file)
    end_process(child)
    assert (tmp_path / "cleared").is_file()


def test_clearing_away_is_not_interrupted_when_it_is_told_again(tmp_path: Path) -> None:
    def work() -> None:
        clear_away_when_ended()
        try:
            (tmp_path / "begun").touch()
            time.sleep(60)
        finally:
            time.sleep(0.4)  # in which it is told several times
            (tmp_path / "cleared").touch()

    child = forked(work)
    _wait_for((tmp_path / "begun").is_file)
    end_process(child)
    assert (tmp_path / "cleared").is_file()


def test_one_that_did_not_hear_the_first_time_is_told_again(tmp_path: Path) -> None:
    """As one that was about to fall asleep."""

    def work() -> None:
        signal.signal(signal.SIGTERM, lambda *_: clear_away_when_ended())  # heard, and lost
        (tmp_path / "begun").touch()
        try:
            time.sleep(60)
        finally:
            (tmp_path / "cleared").touch()

    child = forked(work)
    _wait_for((tmp_path / "begun").is_file)
    begin = time.monotonic()
    end_process(child)
    assert (tmp_path / "cleared").is_file()
    assert time.monotonic() - begin < 30


def test_one_that_hears_nothing_is_killed(tmp_path: Path) -> None:
    def work() -> None:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        (tmp_path / "begun").touch()
        time.sleep(60)

    child = forked(work)
    _wait_for((tmp_path / "begun").is_file)
    status = end_process(child, grace_s=0.2)
    assert os.waitstatus_to_exitcode(status) == -signal.SIGKILL


def test_its_pipes_are_closed_so_that_it_waits_for_no_reader() -> None:
    reader, writer = os.pipe()

    def work() -> None:
        os.close(reader)
        os.write(writer, bytes(1 << 20))  # more than a pipe holds

    child = forked(work)
    os.close(writer)
    end_process(child, reader)
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.read(reader, 1)


def _wait_for(there: Callable[[], bool]) -> None:
    until = time.monotonic() + 20
    while not there():
        assert time.monotonic() < until
        time.sleep(0.01)
