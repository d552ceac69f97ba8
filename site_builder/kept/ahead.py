"""Results that are made before they are asked for, in processes beside this one.

Of what such a process does, only what it keeps comes back (`Keeper.parcel`). Whoever asks then
finds it, in the order and with the mistakes of a build that does one thing after the other; so a
book comes out the same whatever the number of processes, and one that is lost costs only time.
"""

import os
import selectors
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from struct import Struct

from site_builder.forking import CAN_FORK, clear_away_when_ended, cores, end_process, forked
from site_builder.kept.keeper import Keeper, MissingError, UnkeepableError, keeper_at_work

NUMBER = Struct("=H")
MOST_TURNS = 1000
"""Numbers that wait in a pipe, which must hold them all."""
CHUNK = 1 << 20
TRIED_S = 0.005
"""After which it is seen how long things take."""
WORTH_S = 0.3
"""Of work: to begin processes, and to hand over what they have made, takes half of that."""

type Ask = Callable[[], object]


@dataclass(frozen=True, slots=True)
class Helper:
    """A process that makes what it was asked for."""

    process: int
    reader: int
    """The end of the pipe that what it has kept comes through."""


@dataclass(slots=True)
class Helpers:
    """Those that are at work."""

    _keeper: Keeper | None
    _at_work: list[Helper] = field(default_factory=list)
    _asked: list[Ask] = field(default_factory=list)

    def begin(self, asks: Sequence[Ask], least: int = 1) -> None:
        """Begin to make those that are missing, each core one at a time, the first of them first.
        Each asks for what is kept; without a keeper, or of fewer than ``least``, nothing is
        begun."""
        keeper = self._keeper
        missing = [ask for ask in asks if keeper.lacks(ask)] if keeper else []
        if not keeper or len(missing) < least:
            return
        self._asked += missing
        turns = _turns(len(missing))
        try:
            for _ in range(min(cores(), len(missing))):
                self._at_work.append(_begin(missing, turns, keeper))
        finally:
            os.close(turns)

    def join(self) -> None:
        """Wait for all of them, and take in what they have kept."""
        pieces: dict[int, list[bytes]] = {helper.reader: [] for helper in self._at_work}
        with selectors.DefaultSelector() as selector:
            for reader in pieces:
                selector.register(reader, selectors.EVENT_READ)
            while selector.get_map():
                for key, _ in selector.select():
                    piece = os.read(key.fd, CHUNK)
                    if piece:
                        pieces[key.fd].append(piece)
                    else:
                        selector.unregister(key.fd)
        if self._keeper:
            for parts in filter(None, pieces.values()):
                self._keeper.take_in(b"".join(parts))
            while self._asked:
                self._keeper.lacks(self._asked.pop())  # from here on it is in memory
        self.end()

    def end(self) -> None:
        """Let go of them, whatever they do."""
        while self._at_work:
            helper = self._at_work.pop()
            end_process(helper.process, helper.reader)


@contextmanager
def helpers() -> Iterator[Helpers]:
    """Within, results can be made ahead; what is not joined then is ended."""
    found = Helpers(keeper_at_work() if CAN_FORK else None)
    try:
        yield found
    finally:
        found.end()


def make_ahead(asks: Sequence[Ask]) -> None:
    """Make those that are missing on all cores, where there is more than one of either: to begin
    a process takes longer than to read one chapter after an edit."""
    if cores() > 1 and len(asks) > 1:
        with helpers() as found:
            found.begin(asks, least=2)
            found.join()


def answers[T](
    asks: Sequence[Callable[[], T]], weigh: Callable[[int], float] = lambda _place: 1
) -> list[T]:
    """What each of them gives. Of those that are missing the lightest are made here, until it is
    known whether the others take so long that processes are worth their while; then those are made
    ahead, the heaviest first. ``weigh`` tells how long one takes beside another."""
    given: dict[int, T] = {}
    if keeper := keeper_at_work():
        for place, ask in enumerate(asks):
            with suppress(MissingError, UnkeepableError):
                given[place] = keeper.found(ask)
    missing = sorted((place for place in range(len(asks)) if place not in given), key=weigh)
    left, made = sum(map(weigh, missing)), 0.0
    begin = time.perf_counter()
    while missing:
        spent = time.perf_counter() - begin
        if made and spent > TRIED_S and spent / made * left > WORTH_S:
            make_ahead([asks[place] for place in reversed(missing)])
            break
        place = missing.pop(0)
        given[place] = asks[place]()
        left, made = left - weigh(place), made + weigh(place)
    return [given[place] if place in given else ask() for place, ask in enumerate(asks)]


def _begin(asks: Sequence[Ask], turns: int, keeper: Keeper) -> Helper:
    reader, writer = os.pipe()

    def life() -> None:
        os.close(reader)
        clear_away_when_ended()
        keeper.begin_parcel()
        while number := os.read(turns, NUMBER.size):
            (first,) = NUMBER.unpack(number)
            for ask in asks[first::MOST_TURNS]:
                with suppress(Exception):  # who asks again meets it again
                    ask()
        with os.fdopen(writer, "wb") as stream:
            stream.write(keeper.parcel())

    try:
        return Helper(forked(life), reader)
    finally:
        os.close(writer)


def _turns(count: int) -> int:
    """A pipe from which each process takes the number of what it does next."""
    reader, writer = os.pipe()
    with os.fdopen(writer, "wb") as stream:
        stream.write(b"".join(NUMBER.pack(n) for n in range(min(count, MOST_TURNS))))
    return reader
