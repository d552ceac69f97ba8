"""Work in two steps comes out as if one process had done it, whatever becomes of those beside."""

import os
import signal
from collections.abc import Callable, Iterator
from functools import partial

import pytest

from site_builder.kept import two_steps
from site_builder.kept.keeper import Keeper, keeping, kept
from site_builder.kept.two_steps import Steps, in_two_steps

HERE = os.getpid()
made_before: dict[int, int] = {}
"""What the first step leaves for the second, and is not kept: who made it."""


@kept
def first(number: int) -> tuple[int, int]:
    made_before[number] = os.getpid()
    return 10 * number, os.getpid()


@kept
def second(number: int, message: str) -> tuple[str, int, int | None]:
    return message, os.getpid(), made_before.get(number)


def lost_at_first(number: int) -> tuple[int, int]:
    if os.getpid() != HERE and number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return first(number)


def lost_at_second(number: int, message: str) -> object:
    if os.getpid() != HERE and number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return second(number, message)


@kept
def refused(number: int) -> tuple[int, int]:
    raise ValueError(f"{number} in {os.getpid()}")


def work(
    count: int,
    one: Callable[[int], tuple[int, int]] = first,
    two: Callable[[int, str], object] = second,
) -> list[Steps[tuple[int, int], str]]:
    return [
        Steps(partial(one, number), partial(two, number), number + 1) for number in range(count)
    ]


@pytest.fixture(autouse=True)
def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    made_before.clear()
    monkeypatch.setattr(two_steps, "cores", lambda: 2)


@pytest.fixture(autouse=True)
def keeper() -> Iterator[Keeper]:
    found = Keeper()
    with keeping(found):
        yield found


@pytest.fixture
def worth_while(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(two_steps, "TRIED_S", 0)
    monkeypatch.setattr(two_steps, "WORTH_S", 0)


@pytest.mark.usefixtures("worth_while")
def test_the_second_step_is_done_where_the_first_was() -> None:
    with in_two_steps(work(6)) as both:
        assert [value for value, _ in both.first()] == [0, 10, 20, 30, 40, 50]
        both.second("told")
    beside = [second(number, "told") for number in range(6)]
    assert all(process not in (HERE, None) for _, process, _ in beside)
    # The lightest was tried here, to see how long it takes; processes begin with what that left.
    assert [before for _, _, before in beside] == [HERE, *(process for _, process, _ in beside[1:])]


def test_for_what_is_soon_done_no_process_is_begun() -> None:
    with in_two_steps(work(6)) as both:
        assert {process for _, process in both.first()} == {HERE}
        both.second("told")
    assert second(1, "told")[1] == HERE


@pytest.mark.usefixtures("worth_while")
def test_where_all_is_kept_no_process_is_begun(keeper: Keeper) -> None:
    for number in range(4):
        first(number)
    keeper.made.clear()
    with in_two_steps(work(4)) as both:
        both.first()
    assert keeper.made == []


@pytest.mark.usefixtures("worth_while")
@pytest.mark.parametrize(("one", "two"), [(lost_at_first, second), (first, lost_at_second)])
def test_what_a_lost_process_did_not_make_is_made_here(
    one: Callable[[int], tuple[int, int]], two: Callable[[int, str], object]
) -> None:
    with in_two_steps(work(6, one, two)) as both:
        assert [value for value, _ in both.first()] == [0, 10, 20, 30, 40, 50]
        both.second("told")
    assert [second(number, "told")[0] for number in range(6)] == ["told"] * 6
    assert second(3, "told")[1] == HERE


@pytest.mark.usefixtures("worth_while")
def test_a_mistake_made_beside_is_met_by_who_asks() -> None:
    first(0)
    mixed = [*work(1), *work(4, refused)[1:]]
    with (
        in_two_steps([*mixed, *work(6)[4:]]) as both,
        pytest.raises(ValueError, match=f"1 in {HERE}"),
    ):
        both.first()


@pytest.mark.usefixtures("worth_while")
def test_processes_that_wait_for_the_second_step_are_ended_with_the_work() -> None:
    with in_two_steps(work(6)) as both:
        processes = {process for _, process in both.first()} - {HERE}
    assert len(processes) == 2
    for process in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)
