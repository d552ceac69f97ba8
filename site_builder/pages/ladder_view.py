"""A measured ladder as its template needs it: drawn, formatted, nothing left to work out."""

from dataclasses import asdict, dataclass

from simulations.engine.ladder import Metric
from site_builder.charts.pareto import Chart, pareto_chart
from site_builder.markdown.directives.ladder import LadderFigure
from site_builder.measured.ladder_choice import Choice, default_choice
from site_builder.measured.measurements import SIDES, MeasuredLadder, MeasuredTier
from site_builder.measured.quantities import error_text, milliseconds, quantity, with_unit
from site_builder.measured.verdicts import verdict
from site_builder.pages.embedding import json_for_html


@dataclass(frozen=True, slots=True)
class TierRow:
    """One line of a ladder's table."""

    id: str
    label: str
    cost: str
    default: bool
    errors: tuple[str, ...]
    native_ms: str
    browser_ms: str
    verdict: str
    beaten: bool
    """Whether the verdict is that another tier should be taken."""


@dataclass(frozen=True, slots=True)
class LadderView:
    """A ladder's figure, ready for ``blocks/ladder.html``."""

    chart: Chart
    metrics: tuple[tuple[str, str], ...]
    """Label and unit, the one in the chart first."""
    choice: Choice | None
    """The default and its neighbours, where the chart is the one that decided."""
    outcome: str
    """What the chart shows, in a sentence."""
    rows: tuple[TierRow, ...]
    data: str
    """JSON for the page's script, safe inside a script element."""


def view_ladder(figure: LadderFigure) -> LadderView:
    measured = figure.measured
    chart = pareto_chart(measured)
    metrics = _metrics(measured)
    choice = default_choice(measured) if figure.default_html else None
    return LadderView(
        chart=chart,
        metrics=tuple((metric.label, metric.unit) for metric in metrics),
        choice=choice,
        outcome=_chosen(measured, choice) if choice else _nearest(measured),
        rows=tuple(_row(measured, item) for item in measured.tiers),
        data=json_for_html(
            {
                "ladder": measured.ladder.id,
                "metrics": [
                    {"id": m.id, "label": m.label, "unit": m.unit, "higher": m.higher_is_better}
                    for m in metrics
                ],
                "tiers": [{"id": i.tier.id, "label": i.tier.label} for i in measured.tiers],
                "time": asdict(chart.time),
                "error": asdict(chart.error),
            }
        ),
    )


def _chosen(measured: MeasuredLadder, choice: Choice) -> str:
    beaten = sum(bool(measured.beaten_by(item, "browser")) for item in measured.tiers)
    return (
        f"{choice.label}: {choice.ms} ms in the browser; {choice.metric}: {choice.error}. "
        f"Of {len(measured.tiers)} tiers {beaten or 'none'} "
        f"{'is' if beaten < 2 else 'are'} clearly beaten."
    )


def _nearest(measured: MeasuredLadder) -> str:
    best, metric = min(measured.tiers, key=measured.loss), measured.metric
    error = with_unit(error_text(best.errors[metric.id], metric.unit), metric.unit)
    return f"{metric.label}: at best {error}, by {best.tier.label}."


def _metrics(measured: MeasuredLadder) -> tuple[Metric, ...]:
    others = (metric for metric in measured.ladder.metrics if metric is not measured.metric)
    return (measured.metric, *others)


def _row(measured: MeasuredLadder, item: MeasuredTier) -> TierRow:
    winners = [measured.beaten_by(item, side) for side in SIDES]
    return TierRow(
        id=item.tier.id,
        label=item.tier.label,
        cost=item.tier.cost,
        default=item.tier.id == measured.ladder.default_tier,
        errors=tuple(error_text(item.errors[m.id], m.unit) for m in _metrics(measured)),
        native_ms=milliseconds(item.times["native"].ms),
        browser_ms=milliseconds(item.times["browser"].ms),
        verdict=verdict(measured, item),
        beaten=any(winners),
    )


@dataclass(frozen=True, slots=True)
class SummaryRow:
    """One line of the table of all ladders."""

    id: str
    title: str
    tiers: int
    span: str
    """How many times as long the slowest tier takes as the quickest, in the browser."""
    default: str
    default_ms: str
    default_error: str
    beaten: str


def summary_row(measured: MeasuredLadder) -> SummaryRow:
    default = measured[measured.ladder.default_tier]
    times = [item.times["browser"].ms for item in measured.tiers]
    unit = measured.metric.unit
    error = error_text(default.errors[measured.metric.id], unit)
    beaten = [i.tier.label for i in measured.tiers if measured.beaten_by(i, "browser")]
    return SummaryRow(
        id=measured.ladder.id,
        title=measured.ladder.title,
        tiers=len(measured.tiers),
        span=f"{quantity(max(times) / min(times))}×",
        default=default.tier.label,
        default_ms=milliseconds(default.times["browser"].ms),
        default_error=error if error == "none" else f"{error}{'' if unit == '°' else ' '}{unit}",
        beaten="; ".join(beaten) or "none",
    )
