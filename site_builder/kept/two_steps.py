"""Work in two steps, of which the second needs what the first steps of all have given.

Where it is worth their while, processes beside this one do both steps of their share: what the
first step has made for the second, such as a parsed chapter, stays where it is. Only what they keep
comes back, as from other helpers (`ahead.py`), and one that is lost costs only time.
"""

import os
import pickle
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from struct import Struct
from typing import BinaryIO

from site_builder.forking import CAN_FORK, clear_away_when_ended, cores, end_process, forked
from site_builder.kept.ahead import TRIED_S
from site_builder.kept.keeper import Keeper, keeper_at_work

SIZE = Struct("=Q")
WORTH_S = 0.1
"""Of first steps: to begin processes, and to hand over what they have made, takes half of what both
steps take then."""


@dataclass(frozen=True, slots=True)
class Steps[S, M]:
    """What is done with one thing; both steps ask for what is kept."""

    first: Callable[[], S]
    second: Callable[[M], object]
    """Of the message that follows from all first steps."""
    weight: float
    """How long it takes beside another."""


@dataclass(frozen=True, slots=True)
class _Helper:
    process: int
    to: BinaryIO
    back: BinaryIO


@dataclass(slots=True)
class TwoSteps[S, M]:
    """The work, and who does it."""

    _all: Sequence[Steps[S, M]]
    _keeper: Keeper | None
    _at_work: list[_Helper] = field(default_factory=list)

    def first(self) -> list[S]:
        """What the first steps give, in their order."""
        if self._keeper:
            self._begin_if_worth(self._keeper)
            self._take_in(self._keeper)
        return [steps.first() for steps in self._all]

    def second(self, message: M) -> None:
        """Have the second steps done where the first were done beside; the others are left to
        whoever asks."""
        if not (self._keeper and self._at_work):
            return
        packed = pickle.dumps(message)
        for helper in self._at_work:
            with suppress(BrokenPipeError):
                _send(helper.to, packed)
        self._take_in(self._keeper)
        self.end()

    def end(self) -> None:
        """Let go of the processes, whatever they do."""
        while self._at_work:
            helper = self._at_work.pop()
            with suppress(BrokenPipeError):
                helper.to.close()
            helper.back.close()
            end_process(helper.process)

    def _begin_if_worth(self, keeper: Keeper) -> None:
        """The lightest are done here, until it is known whether the others take so long that
        processes are worth their while."""
        missing = sorted(
            (steps for steps in self._all if keeper.lacks(steps.first)),
            key=lambda steps: steps.weight,
        )
        left, done, begun = sum(steps.weight for steps in missing), 0.0, time.perf_counter()
        for steps in missing[: None if cores() > 1 else 0]:
            spent = time.perf_counter() - begun
            if done and spent > TRIED_S and spent / done * left > WORTH_S:
                self._begin(keeper)
                return
            steps.first()
            left, done = left - steps.weight, done + steps.weight

    def _begin(self, keeper: Keeper) -> None:
        heaviest = sorted(self._all, key=lambda steps: -steps.weight)
        for number in range(cores()):
            self._at_work.append(_begin(heaviest[number :: cores()], keeper, self._at_work))

    def _take_in(self, keeper: Keeper) -> None:
        for helper in self._at_work:
            with suppress(EOFError):
                keeper.take_in(_received(helper.back))


@contextmanager
def in_two_steps[S, M](work: Sequence[Steps[S, M]]) -> Iterator[TwoSteps[S, M]]:
    """Within, both steps can be done; processes that are at work then are ended."""
    found = TwoSteps(work, keeper_at_work() if CAN_FORK else None)
    try:
        yield found
    finally:
        found.end()


def _begin[S, M](
    share: Sequence[Steps[S, M]], keeper: Keeper, others: Sequence[_Helper]
) -> _Helper:
    told, teller = os.pipe()
    reader, writer = os.pipe()

    def life() -> None:
        os.close(teller)
        os.close(reader)
        for other in others:  # or they would never see that theirs is closed
            os.close(other.to.fileno())
        clear_away_when_ended()
        with os.fdopen(told, "rb") as messages, os.fdopen(writer, "wb") as back:
            keeper.begin_parcel()
            for steps in share:
                _try(steps.first)
            _send(back, keeper.parcel())
            message = pickle.loads(_received(messages))
            keeper.begin_parcel()
            for steps in share:
                _try(partial(steps.second, message))
            _send(back, keeper.parcel())

    try:
        return _Helper(forked(life), os.fdopen(teller, "wb"), os.fdopen(reader, "rb"))
    finally:
        os.close(told)
        os.close(writer)


def _try(ask: Callable[[], object]) -> None:
    with suppress(Exception):  # who asks again meets it again
        ask()


def _send(stream: BinaryIO, content: bytes) -> None:
    stream.write(SIZE.pack(len(content)) + content)
    stream.flush()


def _received(stream: BinaryIO) -> bytes:
    """Raises `EOFError` where the other process is gone."""
    (size,) = SIZE.unpack(_read(stream, SIZE.size))
    return _read(stream, size)


def _read(stream: BinaryIO, size: int) -> bytes:
    content = stream.read(size)
    if len(content) < size:
        raise EOFError
    return content
