"""``{ladder} id``: a measured ladder: chart, table, and buttons to measure it in the browser."""

from dataclasses import dataclass

from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import Argument, Directive, Numbered, OptionLine, Use
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading
from site_builder.measured.measurements import MeasuredLadder, MeasurementError


@dataclass(frozen=True, slots=True)
class LadderFigure:
    """A measured ladder: chart, table, and buttons to measure it where the page is read."""

    measured: MeasuredLadder
    id: str
    """Element id: ``ladder-`` and the ladder's id, numbered where a page shows one twice."""
    caption_html: str
    default_html: str
    """Why its default was chosen; nothing where another metric than the first judges."""
    open: bool
    """Whether chart and table are shown before they are asked for."""


def read_ladder(use: Use, caption_html: str, reading: Reading) -> LadderFigure | None:
    try:
        measured = reading.measurements.find(use.argument, use.text("metric"))
    except MeasurementError as error:
        reading.problem(use.line, str(error))
        return None
    name = reading.placed[use.line].id
    return LadderFigure(
        measured,
        name,
        caption_html,
        _read_default(use, measured, reading),
        use.text("chart") == "open",
    )


def _read_default(use: Use, measured: MeasuredLadder, reading: Reading) -> str:
    """Explained where the metric judges that chose the default, and there always."""
    ladder, option = measured.ladder, use.options.get("default")
    chosen, explained = measured.metric is ladder.metrics[0], bool(use.text("default"))
    which = f"ladder {ladder.id!r} judged by {measured.metric.id!r}"
    line = option.line if option else use.line
    if explained and not chosen:
        legal = f"only where {ladder.metrics[0].id!r} judges"
        reading.problem(line, f"{which} explains its default; legal: {legal}")
    if chosen and not explained:
        legal = f"a line ':default: …', why its figures settle in {ladder.default_tier!r}"
        reading.problem(line, f"{which} does not explain its default; legal: {legal}")
    return inline_html(option.text, option.line, reading) if option else ""


LADDER = Directive(
    name="ladder",
    says="a measured speed/accuracy ladder",
    argument=Argument("id", lacks="names no ladder"),
    options=(
        OptionLine("default", says="why its default was chosen"),
        OptionLine("metric", says="another of its metrics to judge by"),
        OptionLine("chart", says="chart and table at first", legal=("folded", "open")),
    ),
    body=CAPTION,
    read=read_ladder,
    template="ladder",
    numbered=Numbered("Figure", lambda use: f"ladder-{use.argument}", again=True),
)
