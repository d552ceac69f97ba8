"""``{cost}`start cold book_ms```: what a page costs its reader, measured and never typed."""

from site_builder.benchmarks.costs import Cost, CostError, read_costs
from site_builder.benchmarks.quantities import milliseconds, quantity, with_unit
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Role


def _text(asked: str, context: ParseContext) -> str:
    found = read_costs(context.shared.root).find(asked)
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
    text=_text,
    refuses=CostError,
)
