"""Why a ladder's default stands where it does: its neighbours on the front, in numbers.

The front is the browser's, where the book runs, by the ladder's first metric.
"""

from dataclasses import dataclass

from site_builder.benchmarks.measurements import MeasuredLadder, MeasuredTier
from site_builder.benchmarks.quantities import (
    error_text,
    is_none,
    milliseconds,
    quantity,
    with_unit,
)
from site_builder.languages.words import ENGLISH, Words

SIDE = "browser"


@dataclass(frozen=True, slots=True)
class Neighbour:
    """The next tier along the front."""

    label: str
    times: str
    """How many times as long it takes as the default."""
    error: str
    """With its unit."""


@dataclass(frozen=True, slots=True)
class Choice:
    """The default and what it was chosen over."""

    label: str
    ms: str
    metric: str
    """What its error is called."""
    error: str
    cheaper: Neighbour | None
    """None where nothing on the front is quicker."""
    dearer: Neighbour | None
    """None where nothing that takes longer is clearly more accurate."""


def default_choice(measured: MeasuredLadder, words: Words = ENGLISH) -> Choice:
    """The default of a ladder that is judged by its first metric."""
    default = measured[measured.ladder.default_tier]
    # What only rounding puts on the front is no alternative.
    front = [item for item in measured.front(SIDE) if not measured.beaten_by(item, SIDE)]
    ms = default.times[SIDE].ms
    cheaper = [item for item in front if item.times[SIDE].ms < ms]
    dearer = [item for item in front if item.times[SIDE].ms > ms]
    return Choice(
        label=default.tier.label,
        ms=words.numeral(milliseconds(ms)),
        metric=_in_a_sentence(measured.metric.label, words),
        error=_error(measured, default, words),
        cheaper=_neighbour(measured, default, cheaper[-1], words) if cheaper else None,
        dearer=_neighbour(measured, default, dearer[0], words) if dearer else None,
    )


def off_the_front(measured: MeasuredLadder) -> str:
    """What keeps the default off the browser's front, or nothing where it is on it."""
    default = measured[measured.ladder.default_tier]
    ms, loss = default.times[SIDE].ms, measured.loss(default)
    winners = [
        item
        for item in measured.front(SIDE)
        if item.times[SIDE].ms <= ms and measured.loss(item) <= loss and item is not default
    ]
    if not winners or default in measured.front(SIDE):
        return ""
    named = ", ".join(f"{item.tier.id!r} ({_numbers(measured, item)})" for item in winners)
    return (
        f"{measured.ladder.id}: the default {default.tier.id!r} ({_numbers(measured, default)}) "
        f"is off the {SIDE}'s front, which has {named}"
    )


def _neighbour(
    measured: MeasuredLadder, default: MeasuredTier, item: MeasuredTier, words: Words
) -> Neighbour:
    ratio = item.times[SIDE].ms / default.times[SIDE].ms
    times = words.numeral(quantity(ratio))
    return Neighbour(item.tier.label, times, _error(measured, item, words))


def _in_a_sentence(label: str, words: Words) -> str:
    """A label without its capital, where nouns have none; abbreviations keep theirs."""
    kept = label[:2].isupper() or words("language.nouns") == "capital"
    return label if kept else label[:1].lower() + label[1:]


def _numbers(measured: MeasuredLadder, item: MeasuredTier) -> str:
    return f"{milliseconds(item.times[SIDE].ms)} ms, {_error(measured, item)}"


def _error(measured: MeasuredLadder, item: MeasuredTier, words: Words = ENGLISH) -> str:
    unit, value = measured.metric.unit, item.errors[measured.metric.id]
    if is_none(value, unit):
        return words("ladder.no_error")
    return with_unit(error_text(value, unit, words), unit)
