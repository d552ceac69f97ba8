"""``{cost}`start cold book_ms```: what a page costs its reader, measured and never typed."""

from site_builder.markdown.reading import Reading
from site_builder.markdown.role import Role
from site_builder.measured.costs import Cost, CostError, read_costs
from site_builder.measured.quantities import milliseconds, quantity, with_unit


def _text(asked: str, reading: Reading) -> str:
    found = read_costs(reading.root).find(asked)
    if not isinstance(found, Cost):
        return found
    exact = found.unit in ("", "KB", "MB")
    number = quantity(found.value, 3 if exact and found.value >= 10 else 2)
    text = milliseconds(found.value) if found.unit == "ms" else number
    return with_unit(reading.words.numeral(text), found.unit)


COST = Role(
    name="cost",
    form="NAME … NAME",
    says="a number from the file that `make bench` writes",
    text=_text,
    refuses=CostError,
)
