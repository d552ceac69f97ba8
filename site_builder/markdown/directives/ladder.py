"""``{ladder}``, ``{ladder-table}`` and ``{stage-costs}``: charts and tables of measurements."""

from dataclasses import dataclass

from site_builder.benchmarks.costs import StageCostError, StageCosts, read_stage_costs
from site_builder.benchmarks.measurements import MeasuredLadder, MeasurementError
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import CAPTION, NO_BODY
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.scenes import find_scene


@dataclass(frozen=True, slots=True)
class LadderFigure:
    """A measured ladder: chart, table, and buttons to measure it where the page is read."""

    measured: MeasuredLadder
    id: str
    """Element id: ``ladder-`` and the ladder's id, numbered where a page shows one twice."""
    caption: Passage
    default_reason: Passage
    """Why its default was chosen; nothing where another metric than the first judges."""
    open: bool
    """Whether chart and table are shown at first."""


def read_ladder(
    call: DirectiveCall, caption: Passage, context: ParseContext
) -> LadderFigure | None:
    try:
        measured = context.shared.measurements.find(call.argument, call.text("metric"))
    except MeasurementError as error:
        context.problem(call.line, str(error))
        return None
    name, default = context.placed[call.line].id, _read_default(call, measured, context)
    return LadderFigure(measured, name, caption, default, call.text("chart") == "open")


def _read_default(call: DirectiveCall, measured: MeasuredLadder, context: ParseContext) -> Passage:
    """Explained where the metric judges that chose the default, and there always."""
    ladder, given = measured.ladder, call.text("default")
    which, line = f"ladder {ladder.id!r} judged by {measured.metric.id!r}", call.line_of("default")
    chosen = measured.metric is ladder.metrics[0]
    if given and not chosen:
        expected = f"only where {ladder.metrics[0].id!r} judges"
        context.problem(line, f"{which} explains its default; legal: {expected}")
    if chosen and not given:
        expected = f"a line ':default: …', why its figures settle in {ladder.default_tier!r}"
        context.problem(line, f"{which} does not explain its default; legal: {expected}")
    return inline_passage(given, line, context) if given else Passage()


def _plain(figure: LadderFigure) -> Plain:
    ladder = figure.measured.ladder
    return Plain((ladder.title, ladder.workload, figure.caption), "figure")


LADDER = Directive(
    name="ladder",
    doc="a measured speed/accuracy ladder",
    argument=Argument("id", lacks="names no ladder"),
    options=(
        OptionLine("default", doc="why its default was chosen"),
        OptionLine("metric", doc="another of its metrics to judge by"),
        OptionLine("chart", doc="chart and table at first", expected=("folded", "open")),
    ),
    body=CAPTION,
    read=read_ladder,
    template="ladder",
    numbered=Numbered("Figure", lambda call: f"ladder-{call.argument}", again=True),
    plain=_plain,
)


@dataclass(frozen=True, slots=True)
class LadderTable:
    """All measured ladders, a line each."""

    rows: tuple[MeasuredLadder, ...]
    caption: Passage


def read_ladder_table(
    call: DirectiveCall, _body: None, context: ParseContext
) -> LadderTable | None:
    try:
        rows = context.shared.measurements.all()
    except MeasurementError as error:
        context.problem(call.line, str(error))
        return None
    return LadderTable(rows, inline_passage(call.argument, call.line, context))


LADDER_TABLE = Directive(
    name="ladder-table",
    doc="all measured ladders",
    argument=Argument("Caption", lacks="has no caption"),
    options=(LABEL,),
    body=NO_BODY,
    read=read_ladder_table,
    template="ladder-table",
    numbered=Numbered("Table", lambda _use: "table-ladders"),
)


@dataclass(frozen=True, slots=True)
class StageCostTable:
    """What each moved control costs of a whole frame of one scene."""

    costs: StageCosts
    caption: Passage


def read_stage_cost_table(
    call: DirectiveCall, caption: Passage, context: ParseContext
) -> StageCostTable | None:
    scene = find_scene(call.argument, call.line, context)
    if scene is None:
        return None
    try:
        return StageCostTable(read_stage_costs(context.shared.root, scene), caption)
    except StageCostError as error:
        context.problem(call.line, str(error))
        return None


STAGE_COSTS = Directive(
    name="stage-costs",
    doc="what each control of a scene costs",
    argument=Argument("scene-id", lacks="names no scene"),
    options=(LABEL,),
    body=CAPTION,
    read=read_stage_cost_table,
    template="stage-costs",
    numbered=Numbered("Table", lambda call: f"table-costs-{call.argument}"),
)
