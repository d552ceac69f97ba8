"""What is measured or computed while the book is built, as tables."""

from collections.abc import Iterable, Iterator

from simulations.engine.frame import Panel
from site_builder.benchmarks.judgements import milliseconds, quantity
from site_builder.document.blocks import Block
from site_builder.editions.notebooks.cells import ChapterPage, Part, Text, folded, named
from site_builder.markdown.directives.measured import (
    HardCaseRow,
    HardCaseTable,
    LadderFigure,
    LadderTable,
    StageCostTable,
)
from site_builder.pages.views.ladder import (
    LadderView,
    TierRow,
    default_error,
    slowest_to_quickest,
    view_ladder,
)
from site_builder.render.markdown import LEFT, RIGHT, code, escaped, table


def extremes(shown: HardCaseTable, block: Block, page: ChapterPage) -> Iterator[Part]:
    words, name = page.words, block.target.name if block.target else ""
    summary = words("extremes.summary", table=name, title=shown.title, count=len(shown.rows))
    head = [words(f"extremes.{key}") for key in ("asked", "this_book", "others")]
    rows = [
        (
            _lines(code(row.call), escaped(row.why)),
            _lines(code(row.answer), escaped(row.returns)),
            _others(row, page),
        )
        for row in shown.rows
    ]
    yield Text(folded(summary, table(head, rows)))


def _others(row: HardCaseRow, page: ChapterPage) -> str:
    naive = (page.words("extremes.formula"), row.naive, row.naive_answer)
    library = (page.words("extremes.library"), row.library, row.library_answer)
    asked = [each for each in (naive, library) if each[1]]
    return _lines(*(_lines(f"{who} {code(call)}", code(said)) for who, call, said in asked))


def ladder(figure: LadderFigure, block: Block, page: ChapterPage) -> Iterator[Part]:
    """Chart, choice and table; then the caption."""
    view, measured, words = view_ladder(figure, page.words), figure.measured, page.words
    chart, ladder = view.chart, measured.ladder
    drawing = Panel("chart", "", chart.width, chart.height, overlay=chart.marks + chart.names)
    against = words("ladder.errors_against", reference=ladder.reference_label)
    parts = (
        f"**{escaped(ladder.title)}** {escaped(view.outcome)}",
        escaped(f"{ladder.workload[:1].upper()}{ladder.workload[1:]}. {against}"),
        f"![{escaped(chart.description)}](attachment:{figure.id}.png)",
        _choice(figure, view, page),
        _tiers(figure, view, page),
        f"{named(block.target)}{page.markdown(figure.caption)}",
    )
    pictures = {f"{figure.id}.png": page.picture([drawing])}
    yield Text("\n\n".join(filter(None, parts)), pictures)


def _choice(figure: LadderFigure, view: LadderView, page: ChapterPage) -> str:
    words, choice = page.words, view.choice
    if choice is None:
        return ""
    costs = {"ms": choice.ms, "metric": choice.metric, "error": choice.error}
    said = [
        f"**{escaped(words('ladder.default', tier=choice.label))}** "
        f"{escaped(words('ladder.default_costs', **costs))}.",
        page.markdown(figure.default_reason),
    ]
    for key, other, nothing in (
        ("ladder.quicker", choice.cheaper, "ladder.none_quicker"),
        ("ladder.slower", choice.dearer, "ladder.none_better"),
    ):
        given = {"tier": other.label, "times": other.times, "error": other.error} if other else {}
        said.append(escaped(words(key, **given) if other else words(nothing)))
    return " ".join(said)


def _tiers(figure: LadderFigure, view: LadderView, page: ChapterPage) -> str:
    words, metrics = page.words, view.metrics
    head = [
        *(words(f"ladder.{key}") for key in ("tier", "work")),
        *(" ".join(filter(None, (metric.label, metric.unit))) for metric in metrics),
        *(f"{side}, ms" for side in ("CPython", words("ladder.browser"))),
        words("ladder.verdict"),
    ]
    rows = [
        _tier(row, row.measured.tier.id == figure.measured.ladder.default_tier, page)
        for row in view.rows
    ]
    return table(_escaped(head), rows, [LEFT, LEFT, *[RIGHT] * (len(metrics) + 2), LEFT])


def _tier(row: TierRow, default: bool, page: ChapterPage) -> list[str]:
    tier, times = row.measured.tier, row.measured.times
    label = f"**{escaped(tier.label)}**" if default else escaped(tier.label)
    took = (page.words.numeral(milliseconds(times[side].ms)) for side in ("native", "browser"))
    work = _lines(*_escaped((tier.cost, row.unit_cost)))
    errors = (_lines(*_escaped(parts)) for parts in row.errors)
    return [label, work, *errors, *_escaped((*took, row.verdict))]


def ladder_table(shown: LadderTable, block: Block, page: ChapterPage) -> Iterator[Part]:
    words = page.words
    keys = ("ladder", "tiers", "span", "default", "time", "error", "beaten")
    rows = [
        _escaped(
            (
                row.ladder.title,
                str(len(row.tiers)),
                f"{words.numeral(quantity(slowest_to_quickest(row)))}×",
                row.default.tier.label,
                words.numeral(milliseconds(row.default.times["browser"].ms)),
                default_error(row, words),
                "; ".join(item.tier.label for item in row.beaten("browser"))
                or words("ladder.none"),
            )
        )
        for row in shown.rows
    ]
    rules = [LEFT, RIGHT, RIGHT, LEFT, RIGHT, RIGHT, LEFT]
    head = [words(f"ladders.{key}") for key in keys]
    caption = f"{named(block.target)}{page.markdown(shown.caption)}"
    yield Text(f"{caption}\n\n{table(head, rows, rules)}")


def stage_costs(shown: StageCostTable, block: Block, page: ChapterPage) -> Iterator[Part]:
    words, costs = page.words, shown.costs
    head = [words(f"costs.{key}") for key in ("moved", "again", "stages", "time", "share")]
    moves = sorted(costs.moves, key=lambda move: move.share)
    rows = [
        (
            move.label,
            ", ".join(move.again),
            words("costs.of", count=len(move.again), all=costs.stages),
            words.numeral(f"{move.milliseconds:.1f}"),
            f"{100 * move.share:.0f} %",
        )
        for move in moves
    ]
    every = words("costs.of", count=costs.stages - costs.moves[0].skipped, all=costs.stages)
    whole = words.numeral(f"{costs.whole_ms:.1f}")
    rows.append((words("costs.nothing"), words("costs.every"), every, whole, "100 %"))
    caption = f"{named(block.target)}{page.markdown(shown.caption)}"
    yield Text(
        f"{caption}\n\n{table(head, map(_escaped, rows), [LEFT, LEFT, RIGHT, RIGHT, RIGHT])}"
    )


def _escaped(texts: Iterable[str]) -> list[str]:
    return [escaped(text) for text in texts]


def _lines(*parts: str) -> str:
    return "<br>".join(filter(None, parts))
