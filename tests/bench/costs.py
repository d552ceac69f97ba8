"""What pages cost, kept: ``content/costs.json`` has a section for each tool of this folder that
measures one thing, and ``budgets.toml`` says how much each may be. ``python -m bench.costs``
reports what is beyond its budget; only a tool that cannot measure fails."""

import json
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from support.places import ROOT

from site_builder.benchmarks.measuring import write
from site_builder.benchmarks.readouts import DATA

SITE = ROOT / "build" / "site"
"""The built book, which all these tools measure."""
BUDGETS = Path(__file__).with_name("budgets.toml")


def keep(section: str, found: Mapping[str, Any], file: Path = ROOT / DATA) -> None:
    """Put ``found``, objects within objects down to numbers, in the place of the section."""
    known = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    write(dict(sorted({**known, section: found}.items())), file)


def beyond(costs: Mapping[str, Any], budgets: Mapping[str, Any]) -> Iterator[str]:
    """A line for each number that is more than its budget, and for each that was not measured."""
    for path, most in _leaves(budgets):
        at: Any = costs
        for name in path:
            at = at.get(name) if isinstance(at, Mapping) else None
        if not isinstance(at, int | float):
            yield f"{' '.join(path)}: not measured"
        elif not at <= most:
            yield f"{' '.join(path)}: {at:g}, {at / most - 1:.0%} beyond its budget of {most:g}"


def _leaves(budgets: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[Any, float]]:
    for name, value in budgets.items():
        if isinstance(value, Mapping):
            yield from _leaves(value, (*path, name))
        else:
            yield (*path, name), value


def main() -> None:
    costs = json.loads((ROOT / DATA).read_text(encoding="utf-8"))
    complaints = [*beyond(costs, tomllib.loads(BUDGETS.read_text(encoding="utf-8")))]
    print("\n".join(complaints) or "every cost is within its budget")


if __name__ == "__main__":
    main()
