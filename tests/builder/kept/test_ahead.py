"""What is made beside a build is what it would have made itself, whatever becomes of the maker."""

import os
import signal
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest

from site_builder.drawing.apart import LimitError, Limits, apart, limited
from site_builder.kept import ahead
from site_builder.kept.ahead import helpers, make_ahead
from site_builder.kept.keeper import Keeper, keeping, kept, kept_as
from site_builder.kept.store import Store

HERE = os.getpid()


@kept
def maker(_number: int) -> int:
    """The process that ran."""
    return os.getpid()


@kept
def refused(number: int) -> int:
    raise ValueError(f"{number} in {os.getpid()}")


@kept
def endless(log: Path) -> None:
    with log.open("a") as lines:
        lines.write("tried\n")
    apart(partial(time.sleep, 60))


@kept
def fatal_elsewhere(_number: int) -> int:
    if os.getpid() != HERE:
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


@pytest.fixture(autouse=True)
def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ahead, "cores", lambda: 2)


@pytest.fixture
def keeper() -> Iterator[Keeper]:
    found = Keeper()
    with keeping(found):
        yield found


@pytest.mark.usefixtures("keeper")
def test_what_was_made_ahead_is_not_made_again() -> None:
    make_ahead([partial(maker, number) for number in range(5)])
    assert HERE not in {maker(number) for number in range(5)}


@pytest.mark.usefixtures("keeper")
def test_of_more_than_a_pipe_can_count_all_are_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ahead, "MOST_TURNS", 2)
    make_ahead([partial(maker, number) for number in range(5)])
    assert HERE not in {maker(number) for number in range(5)}


@kept
def tens(number: int) -> tuple[int, int]:
    return 10 * number, os.getpid()


@pytest.mark.usefixtures("keeper")
def test_answers_come_in_the_order_of_what_was_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ahead, "TRIED_S", 0)
    monkeypatch.setattr(ahead, "WORTH_S", 0)
    tens(1)
    found = ahead.answers([partial(tens, number) for number in (3, 1, 2, 5, 4)], lambda at: at + 1)
    assert [value for value, _ in found] == [30, 10, 20, 50, 40]
    made_here = [process == HERE for _, process in found]
    assert made_here == [True, True, False, False, False]  # the lightest is tried


@pytest.mark.usefixtures("keeper")
def test_for_what_is_soon_done_no_process_is_begun() -> None:
    found = ahead.answers([partial(tens, number) for number in range(9)])
    assert {process for _, process in found} == {HERE}


def test_where_all_is_kept_no_process_is_begun(keeper: Keeper) -> None:
    asks = [partial(maker, number) for number in range(2)]
    make_ahead(asks)
    keeper.made.clear()
    make_ahead(asks)
    assert not keeper.made


@pytest.mark.usefixtures("keeper")
def test_a_mistake_made_ahead_is_met_by_who_asks() -> None:
    make_ahead([partial(refused, number) for number in range(2)])
    with pytest.raises(ValueError, match=f"1 in {HERE}"):
        refused(1)


def test_code_without_end_is_tried_once_in_a_build(tmp_path: Path) -> None:
    log, keeper = tmp_path / "log", Keeper()
    with keeping(keeper), limited(Limits(seconds=0.05)):
        make_ahead([partial(endless, log), partial(maker, 0)])
        for _ in range(2):
            with pytest.raises(LimitError, match="takes more than"):
                endless(log)
    assert log.read_text().count("tried") == 1
    with keeping(keeper), limited(Limits(seconds=0.05)), pytest.raises(LimitError):
        endless(log)
    assert log.read_text().count("tried") == 2


@pytest.mark.usefixtures("keeper")
def test_what_a_lost_process_did_not_make_is_made_here() -> None:
    make_ahead([partial(fatal_elsewhere, number) for number in range(2)])
    assert fatal_elsewhere(0) == HERE


@pytest.mark.usefixtures("keeper")
def test_a_build_that_ends_ends_its_helpers(tmp_path: Path) -> None:
    cleared = tmp_path / "cleared"

    def work() -> None:
        try:
            (tmp_path / "begun").touch()
            time.sleep(60)
        finally:
            cleared.touch()

    with helpers() as beside:
        beside.begin([partial(kept_as, "long", 0, work)])
        _wait_for(lambda: (tmp_path / "begun").is_file())
    assert cleared.is_file()


def test_a_helper_finds_what_is_stored(tmp_path: Path) -> None:
    store, keeper = Store(tmp_path), Keeper(Store(tmp_path))
    with keeping(Keeper(store)):
        maker(7)
    asks = [partial(kept_as, "asked", number, partial(maker, 7), __name__) for number in range(2)]
    with keeping(keeper):
        make_ahead(asks)
        assert [ask()[0] for ask in asks] == [HERE, HERE]
    assert len(keeper.made) == 2


def _wait_for(there: Callable[[], bool]) -> None:
    until = time.monotonic() + 20
    while not there():
        assert time.monotonic() < until
        time.sleep(0.01)
