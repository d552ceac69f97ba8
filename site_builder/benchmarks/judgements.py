"""Measured numbers as a reader wants them, and what follows from those of a ladder: alternatives to
its default, a verdict on each tier, and what a tier costs for a pixel or point, of a frame, and for
its noise.

The default and the costs are those of the browser, where the book runs.
"""

import math
from dataclasses import dataclass

from simulations.engine.frame import format_number, power_of_ten
from site_builder.benchmarks.measurements import SIDES, MeasuredLadder, MeasuredTier
from site_builder.languages.words import ENGLISH, Words

NARROW_SPACE = "\u202f"


def quantity(value: float, digits: int = 2) -> str:
    """A finite ``value`` to ``digits`` significant digits: 1400, 0.41, 6.2 × 10⁻⁵, −3."""
    if value == 0.0:
        return "0"
    mantissa, _, exponent = f"{abs(value):.{digits - 1}e}".partition("e")
    power = int(exponent)
    if -3 <= power < 5:
        text = f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - power, 0)}f}"
    else:
        text = f"{mantissa}{NARROW_SPACE}×{NARROW_SPACE}{power_of_ten(power)}"
    return f"−{text}" if value < 0 else text


def milliseconds(value: float) -> str:
    """A time without its unit: two digits, three from 100 on."""
    return quantity(value, 2 if value < 100 else 3)


def error_text(value: float | None, unit: str, words: Words = ENGLISH) -> str:
    """An error without its unit; ratios in decibels to a tenth; ``none`` where there is none."""
    if is_none(value, unit):
        return words("ladder.none")
    if value is None:
        return "∞"
    return words.numeral(format_number(value, 1) if unit == "dB" else quantity(value))


def range_text(spread: tuple[float, float] | None, unit: str, words: Words = ENGLISH) -> str:
    """Both ends of a spread without their unit; one number where they read alike, none for None."""
    if spread is None:
        return ""
    low, high = (error_text(None if math.isinf(end) else end, unit, words) for end in spread)
    return low if low == high else f"{low}–{high}"


def is_none(value: float | None, unit: str) -> bool:
    """Whether an error is none at all, which has no unit."""
    return unit != "dB" and not value


def with_unit(text: str, unit: str) -> str:
    """``16.0 px``, on one line; degrees stand close, and what has no unit stands alone."""
    space = "" if unit in ("", "°") else "\u00a0"
    return f"{text}{space}{unit}"


SIDE = "browser"
FRAME_MS = 1000 / 30
"""Time between two frames, at the rate at which a drag still looks smooth."""


@dataclass(frozen=True, slots=True)
class Neighbour:
    """The next tier along the front."""

    label: str
    times: str
    """How many times as long it takes as the default."""
    error: str
    """With its unit."""


@dataclass(frozen=True, slots=True, kw_only=True)
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
    default = measured.default
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
    """The tiers that beat the default in the browser; nothing where it is on the front."""
    default = measured.default
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
    """A label without its capital, where nouns have none and it is no abbreviation."""
    is_capital = label[:2].isupper() or words("language.nouns") == "capital"
    return label if is_capital else label[:1].lower() + label[1:]


def _numbers(measured: MeasuredLadder, item: MeasuredTier) -> str:
    return f"{milliseconds(item.times[SIDE].ms)} ms, {_error(measured, item)}"


def _error(measured: MeasuredLadder, item: MeasuredTier, words: Words = ENGLISH) -> str:
    unit, value = measured.metric.unit, item.errors[measured.metric.id]
    if is_none(value, unit):
        return words("ladder.no_error")
    return with_unit(error_text(value, unit, words), unit)


def verdict(measured: MeasuredLadder, item: MeasuredTier, words: Words = ENGLISH) -> str:
    """The verdict on a tier, in a few words."""
    native, browser = (measured.beaten_by(item, side) for side in SIDES)
    if native and browser:
        both = native.tier.id == browser.tier.id
        key = "verdict.beaten" if both else "verdict.beaten_twice"
        return words(key, tier=native.tier.label, other=browser.tier.label)
    if native:
        return words("verdict.beaten_native", tier=native.tier.label)
    if browser:
        return words("verdict.beaten_browser", tier=browser.tier.label)
    match [side for side in SIDES if item in measured.front(side)]:
        case [_, _]:
            return words("verdict.front")
        case ["native"]:
            return words("verdict.front_native")
        case ["browser"]:
            return words("verdict.front_browser")
        case _:
            return words("verdict.close")


def nanoseconds_each(measured: MeasuredLadder, item: MeasuredTier) -> float:
    """Time for one item of the workload. Raises `ZeroDivisionError` where these are not counted."""
    return item.times[SIDE].ms * 1e6 / measured.ladder.items


def frame_percent(item: MeasuredTier) -> float:
    """Share of a frame that the whole workload takes, in per cent."""
    return 100 * item.times[SIDE].ms / FRAME_MS


def efficiency(measured: MeasuredLadder, item: MeasuredTier) -> float | None:
    """1/(variance × time) in units of the ladder's first sampled tier: how much less time a tier
    takes for the same noise, since a sample's variance falls with the work (Pharr, Jakob and
    Humphreys, *Physically Based Rendering*, 4th ed., 2.2). None where a tier is not sampled."""
    if item.tier.id not in measured.ladder.sampled:
        return None
    unit = measured[measured.ladder.sampled[0]]
    return _cost_of_noise(measured, unit) / _cost_of_noise(measured, item)


def _cost_of_noise(measured: MeasuredLadder, item: MeasuredTier) -> float:
    metric = measured.ladder.metrics[0]
    error = item.errors[metric.id] or 0.0
    variance = 10 ** (-error / 10) if metric.unit == "dB" else error**2
    return float(variance * item.times[SIDE].ms)
