"""Costs of pages: ``content/costs.json`` has a section for each tool of this folder, and
``budgets.toml`` has the limits. ``python -m bench.costs`` lists the costs beyond their budgets;
only a tool that cannot measure fails."""

import json
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from support.places import ROOT

from site_builder.benchmarks.measuring import write
from site_builder.benchmarks.quoted_numbers import DATA

SITE = ROOT / "build" / "site"
"""The built book, which all tools of this folder measure."""
BUDGETS = Path(__file__).with_name("budgets.toml")


def store_section(section: str, found: Mapping[str, Any], file: Path = ROOT / DATA) -> None:
    """Replace a section of the file by ``found``, nested objects of numbers."""
    known = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    write(dict(sorted({**known, section: found}.items())), file)


def over_budget(costs: Mapping[str, Any], budgets: Mapping[str, Any]) -> Iterator[str]:
    """A line for each number beyond its budget, and for each that was not measured."""
    for path, most in _leaves(budgets):
        at: Any = costs
        for name in path:
            at = at.get(name) if isinstance(at, Mapping) else None
        if not isinstance(at, int | float):
            yield f"{' '.join(path)}: not measured"
        elif not at <= most:
            excess = f"{at / most - 1:.0%} " if most else ""
            yield f"{' '.join(path)}: {at:g}, {excess}beyond its budget of {most:g}"


def _leaves(budgets: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[Any, float]]:
    for name, value in budgets.items():
        if isinstance(value, Mapping):
            yield from _leaves(value, (*path, name))
        else:
            yield (*path, name), value


def main() -> None:
    costs = json.loads((ROOT / DATA).read_text(encoding="utf-8"))
    over = [*over_budget(costs, tomllib.loads(BUDGETS.read_text(encoding="utf-8")))]
    print("\n".join(over) or "every cost is within its budget")


if __name__ == "__main__":
    main()
