"""A measured ladder as its template needs it: drawn, formatted, nothing left to work out."""

from dataclasses import asdict, dataclass

from simulations.engine.ladder import Metric
from site_builder.benchmarks.charts import Chart, pareto_chart
from site_builder.benchmarks.judgements import (
    Choice,
    default_choice,
    efficiency,
    error_text,
    frame_percent,
    is_none,
    nanoseconds_each,
    quantity,
    range_text,
    verdict,
    with_unit,
)
from site_builder.benchmarks.measurements import SIDES, MeasuredLadder, MeasuredTier
from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.directives.measured import LadderFigure
from site_builder.pages.policy import json_for_html


@dataclass(frozen=True, slots=True)
class TierRow:
    """One line of a ladder's table."""

    measured: MeasuredTier
    errors: tuple[tuple[str, str], ...]
    """By metric: the error, and what nine of ten draws lie between."""
    unit_cost: str
    """Time for a pixel or point, share of a frame, and efficiency, in the browser."""
    verdict: str
    beaten: bool
    """Whether the verdict is that another tier should be taken."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LadderView:
    """A ladder's figure, ready for ``blocks/ladder.html``."""

    chart: Chart
    metrics: tuple[Metric, ...]
    """The one in the chart first."""
    choice: Choice | None
    """The default and its neighbours, where the chart is the one that decided."""
    outcome: str
    """What the chart shows, in a sentence."""
    rows: tuple[TierRow, ...]
    data: str
    """JSON for the page's script, safe inside a script element."""


@dataclass(frozen=True, slots=True)
class ChartView:
    """The chart alone, as exercises show it."""

    chart: Chart
    data: str
    """JSON for the page's script, safe inside a script element."""


def view_chart(measured: MeasuredLadder, words: Words = ENGLISH) -> ChartView:
    chart = pareto_chart(measured, words)
    data = {
        "ladder": measured.ladder.id,
        "metrics": [
            {"id": m.id, "label": m.label, "unit": m.unit, "higher": m.higher_is_better}
            for m in _metrics(measured)
        ],
        "tiers": [{"id": i.tier.id, "label": i.tier.label} for i in measured.tiers],
        "time": asdict(chart.time),
        "error": asdict(chart.error),
    }
    return ChartView(chart, json_for_html(data))


def view_ladder(figure: LadderFigure, words: Words = ENGLISH) -> LadderView:
    measured = figure.measured
    drawn = view_chart(measured, words)
    metrics = _metrics(measured)
    choice = default_choice(measured, words) if figure.default_reason else None
    return LadderView(
        chart=drawn.chart,
        metrics=metrics,
        choice=choice,
        outcome=_chosen(measured, choice, words) if choice else _nearest(measured, words),
        rows=tuple(_row(measured, item, words) for item in measured.tiers),
        data=drawn.data,
    )


def _chosen(measured: MeasuredLadder, choice: Choice, words: Words) -> str:
    beaten = len(measured.beaten("browser"))
    costs = {"ms": choice.ms, "metric": choice.metric, "error": choice.error}
    chosen = words("ladder.chosen", tier=choice.label, **costs)
    key = "ladder.beaten" if beaten else "ladder.none_beaten"
    return f"{chosen} {words(key, count=beaten, tiers=len(measured.tiers))}"


def _nearest(measured: MeasuredLadder, words: Words) -> str:
    best, metric = min(measured.tiers, key=measured.loss), measured.metric
    error = with_unit(error_text(best.errors[metric.id], metric.unit, words), metric.unit)
    return words("ladder.nearest", metric=metric.label, error=error, tier=best.tier.label)


def _metrics(measured: MeasuredLadder) -> tuple[Metric, ...]:
    others = (metric for metric in measured.ladder.metrics if metric is not measured.metric)
    return (measured.metric, *others)


def _row(measured: MeasuredLadder, item: MeasuredTier, words: Words) -> TierRow:
    return TierRow(
        measured=item,
        errors=tuple(
            (
                error_text(item.errors[m.id], m.unit, words),
                range_text(item.spread(m.id), m.unit, words),
            )
            for m in _metrics(measured)
        ),
        unit_cost=_unit_cost(measured, item, words),
        verdict=verdict(measured, item, words),
        beaten=any(measured.beaten_by(item, side) for side in SIDES),
    )


def _unit_cost(measured: MeasuredLadder, item: MeasuredTier, words: Words) -> str:
    if not measured.ladder.items:
        return ""
    each = words.numeral(quantity(nanoseconds_each(measured, item)))
    share = words.numeral(quantity(frame_percent(item)))
    text = words("ladder.unit_cost", ns=each, item=measured.ladder.item, percent=share)
    ratio = efficiency(measured, item)
    if ratio is None:
        return text
    return f"{text}; {words('ladder.efficiency', ratio=words.numeral(quantity(ratio)))}"


def default_error(measured: MeasuredLadder, words: Words) -> str:
    """Error of the default tier, with its unit where it has an error."""
    unit, value = measured.metric.unit, measured.default.errors[measured.metric.id]
    text = error_text(value, unit, words)
    return text if is_none(value, unit) else f"{text}{'' if unit == '°' else ' '}{unit}"


def slowest_to_quickest(measured: MeasuredLadder) -> float:
    """How many times as long the slowest tier takes as the quickest, in the browser."""
    times = [item.times["browser"].ms for item in measured.tiers]
    return max(times) / min(times)
