"""``{ladder} id``: a measured ladder. ``{ladder-table} Caption``: all of them, a line each."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.book import LadderFigure, LadderTable
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.directive import Directive
from site_builder.markdown.reading import Reading
from site_builder.measurements import MeasurementError


def read_ladder(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> LadderFigure | None:
    """Option ``:metric:`` judges the ladder by another of its metrics."""
    check_options(directive, ("metric",), reading)
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
    return LadderFigure(measured, name, caption_html)


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
