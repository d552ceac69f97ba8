"""``{measured}`srgb exact native```: a measured number in running text, never typed.

LADDER TIER native, browser     time with its unit
LADDER TIER METRIC              error with its unit
LADDER TIER each                time in the browser for one pixel or point
LADDER TIER frame               the same time as a share of a thirtieth of a second
LADDER TIER efficiency          1/(variance × time) beside the ladder's first tier
LADDER TIER METRIC bare         a number without its unit
LADDER TIER METRIC range        what nine of ten draws of the workload lie between, with its unit
LADDER TIER over TIER METRIC    how many times as much the first is as the second
tiers, beaten                   how many there are of all ladders
processor, python, numpy, …     what it was measured on
"""

from simulations.engine.expressions import ExpressionError
from site_builder.benchmarks.judgements import (
    efficiency,
    error_text,
    frame_percent,
    is_none,
    milliseconds,
    nanoseconds_each,
    quantity,
    range_text,
    with_unit,
)
from site_builder.benchmarks.measurements import (
    SIDES,
    MeasuredLadder,
    MeasurementError,
    Measurements,
)
from site_builder.benchmarks.quoted_numbers import Cost, ReadoutError, read_cost
from site_builder.diagnostics.diagnostic import unknown
from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.calculation import number_text
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Role

COUNTS = ("tiers", "beaten")
UNIT_COSTS = ("each", "frame", "efficiency")
COLUMN = "native|browser|each|frame|efficiency|METRIC"
LEGAL = f"legal: 'LADDER TIER {COLUMN}', or 'LADDER TIER over TIER …'"


def measured_text(query: str, measurements: Measurements, words: Words = ENGLISH) -> str:
    """The text for ``query``. Raises `MeasurementError`."""
    match query.split():
        case [name]:
            return _machine_value_or_count(name, measurements)
        case [ladder, tier, column]:
            return _one(measurements.find(ladder), tier, column, words)
        case [ladder, tier, column, "bare"]:
            measured = measurements.find(ladder)
            return error_text(*_value(measured, tier, column), words)
        case [ladder, tier, column, "range"]:
            measured = measurements.find(ladder)
            _, unit = _value(measured, tier, column)
            return with_unit(range_text(measured[tier].spread(column), unit, words), unit)
        case [ladder, tier, "over", other, column]:
            return words.numeral(_ratio(measurements.find(ladder), tier, other, column))
    raise MeasurementError(f"{{measured}} {query!r}; {LEGAL}")


def _machine_value_or_count(name: str, measurements: Measurements) -> str:
    if name in measurements.machine:
        return str(measurements.machine[name])
    if name not in COUNTS:
        expected = (*COUNTS, *measurements.machine)
        raise MeasurementError(unknown("measured thing", name, expected))
    tiers = [(ladder, item) for ladder in measurements.all() for item in ladder.tiers]
    beaten = [item for ladder, item in tiers if ladder.beaten_by(item, "browser")]
    return str(len(beaten if name == "beaten" else tiers))


def _one(measured: MeasuredLadder, tier: str, column: str, words: Words) -> str:
    _check_tier(measured, tier)
    if column in SIDES:
        return with_unit(words.numeral(milliseconds(measured[tier].times[column].ms)), "ms")
    if column in UNIT_COSTS:
        return _unit_cost(measured, tier, column, words)
    value, unit = _value(measured, tier, column)
    text = error_text(value, unit, words)
    return text if is_none(value, unit) else with_unit(text, unit)


def _unit_cost(measured: MeasuredLadder, tier: str, column: str, words: Words) -> str:
    item, ladder = measured[tier], measured.ladder
    if column == "frame":
        return with_unit(words.numeral(quantity(frame_percent(item))), "%")
    if column == "each" and ladder.items:
        each = quantity(nanoseconds_each(measured, item))
        return f"{with_unit(words.numeral(each), 'ns')} per {ladder.item}"
    if column == "efficiency" and (ratio := efficiency(measured, item)) is not None:
        return words.numeral(quantity(ratio))
    raise MeasurementError(f"ladder {ladder.id!r} states no {column!r} of {tier!r}")


def _ratio(measured: MeasuredLadder, tier: str, other: str, column: str) -> str:
    (one, _), (two, _) = (_value(measured, name, column) for name in (tier, other))
    if one is None or not two:
        raise MeasurementError(f"{column} of {tier!r} over {other!r}: the second has no error")
    return quantity(one / two)


def _check_tier(measured: MeasuredLadder, tier: str) -> None:
    expected = [item.tier.id for item in measured.tiers]
    if tier not in expected:
        raise MeasurementError(unknown(f"tier of {measured.ladder.id}", tier, expected))


def _value(measured: MeasuredLadder, tier: str, column: str) -> tuple[float | None, str]:
    _check_tier(measured, tier)
    ladder, item = measured.ladder, measured[tier]
    if column in SIDES:
        return item.times[column].ms, "ms"
    units = {metric.id: metric.unit for metric in ladder.metrics}
    if column not in units:
        expected = (*SIDES, *UNIT_COSTS, *units)
        raise MeasurementError(unknown(f"number of {ladder.id}", column, expected))
    return item.errors[column], units[column]


def _text(words: str, context: ParseContext) -> str:
    return measured_text(words, context.shared.measurements, context.shared.words)


MEASURED = Role(
    name="measured",
    form=f"LADDER TIER [over TIER] {COLUMN} [bare]",
    doc="a number from the file that `python -m site_builder bench` writes",
    text=_text,
)


CALC = Role(
    name="calc",
    form="EXPRESSION` or `EXPRESSION:FORMAT",
    doc=(
        "the number that an expression comes to, in Python's format (`:.2f`); in formulae "
        r"`\calc{EXPRESSION:FORMAT}`. A code block `calc`, which is not shown, imports functions "
        "of the models, names values for the expressions below it, and checks what the text claims "
        "by `assert CONDITION`"
    ),
    text=number_text,
    refuses=ExpressionError,
)


def _cost(query: str, context: ParseContext) -> str:
    found = read_cost(context.shared.root, query)
    if not isinstance(found, Cost):
        return found
    exact = found.unit in ("", "KB", "MB")
    number = quantity(found.value, 3 if exact and found.value >= 10 else 2)
    text = milliseconds(found.value) if found.unit == "ms" else number
    return with_unit(context.shared.words.numeral(text), found.unit)


COST = Role(
    name="cost",
    form="NAME … NAME",
    doc="a number from the file that `make bench` writes",
    text=_cost,
)


FORM = "SCENE READOUT [CONTROL=VALUE …] [tier=ID] [bare]"


def readout_text(words: str, context: ParseContext) -> str:
    """What stands in the text for ``words``. Raises `ReadoutError`."""
    scene_id, _, rest = words.partition(" ")
    name, *pairs = rest.split() or [""]
    bare = pairs[-1:] == ["bare"]
    settings = dict(pair.split("=", 1) for pair in pairs[: len(pairs) - bare] if "=" in pair)
    if not name or "=" in name or len(settings) + bare < len(pairs):
        raise ReadoutError(f"{{readout}} {words!r}; legal: '{FORM}', each control once")
    shown = context.readouts.text(scene_id, name, settings, bare=bare)
    return context.shared.words.numeral(shown)


READOUT = Role(
    name="readout", form=FORM, doc="a number that a figure shows at that setting", text=readout_text
)
