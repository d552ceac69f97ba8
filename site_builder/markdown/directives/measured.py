"""``{ladder}``, ``{ladder-table}`` and ``{stage-costs}``: charts and tables of measurements;
``{extremes}``: a table of a model's hard cases, computed while the book is built; and
``{data-sheet}``: what the instruments of the page measured."""

from dataclasses import dataclass
from functools import partial

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    answer,
    naive_answer,
    read_table,
    show,
)
from simulations.registry import hard_case_tables
from site_builder.benchmarks.measurements import MeasuredLadder
from site_builder.benchmarks.quoted_numbers import StageCosts, read_stage_costs
from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import cause
from site_builder.document.blocks import Prose
from site_builder.document.places import Passage, Plain
from site_builder.markdown.annotation import inline_passage
from site_builder.markdown.block_tree import CAPTION, NO_BODY
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.pool.loading import loaded
from site_builder.pool.processes import run_in_pool


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


def read_ladder(call: DirectiveCall, caption: Passage, context: ParseContext) -> LadderFigure:
    measured = context.shared.measurements.find(call.argument, call.text("metric"))
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
        OptionLine(name="default", doc="why its default was chosen"),
        OptionLine(name="metric", doc="another of its metrics to judge by"),
        OptionLine(name="chart", doc="chart and table at first", expected=("folded", "open")),
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


def read_ladder_table(call: DirectiveCall, _body: None, context: ParseContext) -> LadderTable:
    rows = context.shared.measurements.all()
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
) -> StageCostTable:
    scene = loaded("simulation", call.argument, context.shared.load_scene, CodeError)
    return StageCostTable(read_stage_costs(context.shared.root, scene), caption)


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


FILES = hard_case_tables()


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCaseRow:
    """A line of a table: a hard case with every answer computed and put into words."""

    id: str
    call: str
    answer: str
    why: str
    returns: str
    naive: str
    naive_answer: str
    library: str
    library_answer: str


@dataclass(frozen=True, slots=True)
class HardCaseTable:
    """What a model answers at the edge of what it is made for."""

    id: str
    """Element id: ``extremes-`` and the model's."""
    title: str
    rows: tuple[HardCaseRow, ...]


def read_hard_cases(call: DirectiveCall, _body: None, context: ParseContext) -> HardCaseTable:
    name = context.placed[call.line].id
    try:
        text = FILES[call.argument].read_text(encoding="utf-8")
        title, rows = run_in_pool(partial(_computed, call.argument, text))
        return HardCaseTable(name, title, rows)
    except Exception as error:  # whatever its code may raise is the author's to see
        message = f"hard cases {call.argument!r} cannot be computed: {cause(error)}"
        raise CodeError(message) from error


def _computed(table_id: str, text: str) -> tuple[str, tuple[HardCaseRow, ...]]:
    """Title and rows of a table."""
    table = read_table(table_id, text)
    return table.title, tuple(_row(table, case) for case in table.cases)


def _row(table: HardCases, case: HardCase) -> HardCaseRow:
    return HardCaseRow(
        id=case.id,
        call=case.call,
        answer=show(answer(table, case.call)),
        why=case.why,
        returns=case.returns,
        naive=case.naive,
        naive_answer=show(naive_answer(table, case.naive)) if case.naive else "",
        library=case.library,
        library_answer=case.library_answer,
    )


EXTREMES = Directive(
    name="extremes",
    doc="the hard cases of a model",
    argument=Argument("model", "names no table", FILES, "table of extremes"),
    body=NO_BODY,
    read=read_hard_cases,
    template="extremes",
    numbered=Numbered("Table", lambda call: f"extremes-{call.argument}"),
)
DATA_SHEET = Directive(
    name="data-sheet",
    doc="the results of the instruments of a page",
    argument=None,
    body=CAPTION,
    read=lambda _call, words, _context: Prose(words),
    template="data-sheet",
    plain=lambda sheet: Plain((sheet.words,)),
)
