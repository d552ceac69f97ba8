"""``{ladder} id``: a measured ladder. ``{ladder-table} Caption``: all of them, a line each."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.book import LadderFigure, LadderTable
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading
from site_builder.measured.measurements import MeasuredLadder, MeasurementError


def read_ladder(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> LadderFigure | None:
    """Option ``:default:`` says why its default was chosen; ``:metric:`` judges the ladder by
    another of its metrics, where no default was chosen and none is explained."""
    check_options(directive, ("metric", "default"), reading)
    caption_html = read_html(directive, body, reading)
    metric = directive.options.get("metric")
    if not directive.argument:
        reading.problem(directive.line, "{ladder} names no ladder; legal: ':::{ladder} id'")
        return None
    try:
        measured = reading.measurements.find(directive.argument, metric.text if metric else "")
    except MeasurementError as error:
        reading.problem(directive.line, str(error))
        return None
    name = reading.free_id(f"ladder-{measured.ladder.id}", directive.line)
    return LadderFigure(measured, name, caption_html, _read_default(directive, measured, reading))


def _read_default(directive: Directive, measured: MeasuredLadder, reading: Reading) -> str:
    ladder, option = measured.ladder, directive.options.get("default")
    if (measured.metric is ladder.metrics[0]) != bool(option and option.text):
        which = f"ladder {ladder.id!r} judged by {measured.metric.id!r}"
        legal = f"a line ':default: …', why its figures settle in {ladder.default_tier!r}"
        reading.problem(
            option.line if option else directive.line,
            f"{which} explains its default; legal: only where {ladder.metrics[0].id!r} judges"
            if option and option.text
            else f"{which} does not explain its default; legal: {legal}",
        )
    return reading.inline_html(option.text, option.line) if option else ""


def read_ladder_table(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> LadderTable | None:
    check_options(directive, (), reading)
    if body:
        reading.problem(directive.line, "{ladder-table} has a body; legal: a caption, no more")
    if not directive.argument:
        reading.problem(directive.line, "{ladder-table} has no caption; legal: some text after it")
    try:
        rows = reading.measurements.all()
    except MeasurementError as error:
        reading.problem(directive.line, str(error))
        return None
    return LadderTable(rows, reading.inline_html(directive.argument, directive.line))
