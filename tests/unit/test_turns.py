"""The order of the tests: each worker begins with long ones, and ends with quick ones."""

import pytest
from support.turns import Turn, deal

LONG = {f"build {n}": Turn("build", long=True) for n in range(2)}
BROWSER = {f"{file} {n}": Turn(file, browser=True) for file in ("page", "quiz") for n in range(4)}
LONG_BROWSER = {f"visit {n}": Turn("visit", long=True, browser=True) for n in range(3)}
QUICK = {f"lens {n}": Turn("lens") for n in range(40)}
TURNS = QUICK | BROWSER | LONG | LONG_BROWSER


def hands(tests: list[str], count: int) -> list[list[str]]:
    """As xdist's ``worksteal`` gives them out."""
    dealt = []
    for left in range(count, 0, -1):
        size = len(tests) // left
        dealt.append(tests[:size])
        tests = tests[size:]
    return dealt


def test_each_test_has_one_turn() -> None:
    assert sorted(deal([*TURNS], 3, TURNS.__getitem__)) == sorted(TURNS)


def test_one_worker_begins_with_the_long_ones_and_then_the_browser() -> None:
    assert deal([*TURNS], 1, TURNS.__getitem__) == [*LONG, *LONG_BROWSER, *BROWSER, *QUICK]


@pytest.mark.parametrize("count", [2, 3])
def test_each_worker_ends_with_quick_tests_and_has_its_share_of_the_others(count: int) -> None:
    for hand in hands(deal([*TURNS], count, TURNS.__getitem__), count):
        assert hand[-1] in QUICK
        assert len(LONG_BROWSER.keys() & {*hand}) >= len(LONG_BROWSER) // count


def test_only_the_first_worker_asks_for_the_site_at_once() -> None:
    first, *others = hands(deal([*TURNS], 3, TURNS.__getitem__), 3)
    assert TURNS[first[1]].browser
    for hand in others:
        assert not any(TURNS[test].browser for test in hand[:2])


def test_tests_of_a_file_stay_with_one_worker() -> None:
    dealt = hands(deal([*TURNS], 3, TURNS.__getitem__), 3)
    for file in ("page", "quiz"):
        mine = {test for test in BROWSER if TURNS[test].file == file}
        assert sum(bool(mine & {*hand}) for hand in dealt) == 1


def test_few_tests_are_dealt_too() -> None:
    for count in range(1, 5):
        assert sorted(deal([*BROWSER], count, TURNS.__getitem__)) == sorted(BROWSER)
