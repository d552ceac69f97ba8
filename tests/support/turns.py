"""In which order tests run, so that all workers end together."""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import islice

AHEAD = 0.2
"""Share of its quick tests that a worker begins with while another builds the site."""


@dataclass(frozen=True, slots=True)
class Turn:
    """What the order asks of a test."""

    file: str
    long: bool = False
    browser: bool = False


def deal[T](tests: Sequence[T], hands: int, turn: Callable[[T], Turn]) -> list[T]:
    """The same tests: first the hand of one worker, then that of the next, equal in number.

    So pytest-xdist gives them out, and a worker that is done takes from the end of the longest
    hand: there stand quick tests. Long ones stand at the beginning, and tests in a browser before
    the others; those of a file stay together, since they share pages. The first hand begins with
    the browser, for which its worker builds the site.
    """
    turns = [(test, turn(test)) for test in tests]
    long = [test for test, of in turns if of.long and not of.browser]
    in_browser = _in_browser([(test, of) for test, of in turns if of.browser], hands)
    quick = iter([test for test, of in turns if not (of.long or of.browser)])
    dealt: list[T] = []
    for number, browser in enumerate(in_browser):
        slow = [*long[number::hands], *browser]
        size = (len(tests) - len(dealt)) // (hands - number)
        rest = [*islice(quick, max(size - len(slow), 0))] if number + 1 < hands else [*quick]
        ahead = round(AHEAD * len(rest)) if number and browser else 0
        dealt += [*long[number::hands], *rest[:ahead], *browser, *rest[ahead:]]
    return dealt


def _in_browser[T](turns: Sequence[tuple[T, Turn]], hands: int) -> list[list[T]]:
    """Long ones one by one, then the other files, the largest first, each to the smallest hand."""
    long = [test for test, of in turns if of.long]
    dealt = [long[hand::hands] for hand in range(hands)]
    files = defaultdict[str, list[T]](list)
    for test, of in turns:
        if not of.long:
            files[of.file].append(test)
    for tests in sorted(files.values(), key=len, reverse=True):
        min(dealt, key=len).extend(tests)
    return dealt
