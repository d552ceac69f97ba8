"""What leaving out each effect costs and saves in the photographs of `world.camera_budget`,
its best choice, and the errors of known plans: ``PYTHONPATH=tests python -m bench.omissions``.

Times are of processor time, the fastest of `ROUNDS`. The best choice is the best of all whose
picture, which is taken, stays within the tolerance. The results go into
``simulations/world/budget_costs.py``, since the reader's browser needs them.
"""

import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Self

from simulations.engine.stages import StageCache
from simulations.world import camera_budget
from simulations.world.budget_costs import Row
from simulations.world.camera_budget import (
    COUNT,
    PLANS,
    drawn_photo,
    in_order,
    time_saved,
    tolerance_of,
)
from simulations.world.omissions import (
    EFFECTS,
    Complete,
    Photo,
    complete_model,
    error_without,
    run_without,
    savings,
)
from site_builder.benchmarks.measuring import significant
from site_builder.files.folders import replace_file

DATA = Path(camera_budget.__file__).with_name("budget_costs.py")
ROUNDS = 25
HEAD = '''"""Costs in codes and savings in milliseconds of each effect, by photograph; the best
choice; and errors of pictures without several effects: written by `make bench`."""
# ruff: noqa: E501
# fmt: off

type Row = tuple[
    tuple[float, ...], tuple[float, ...], tuple[str, ...], dict[tuple[str, ...], float]
]

FOUND: tuple[Row, ...] = (
'''


@dataclass(frozen=True, slots=True)
class Pictures:
    """A photograph and its pictures without some effects."""

    photo: Photo
    complete: Complete
    cache: StageCache

    @classmethod
    def of(cls, photo: Photo) -> Self:
        cache = StageCache(depth=64)
        return cls(photo, complete_model(photo, cache), cache)

    def error_without(self, names: Collection[str]) -> float:
        """RMS in codes."""
        light = run_without(self.photo, names, self.cache)["falloff"]
        return error_without(names, light, self.complete.mean, self.complete.costs["poisson"])

    def best(self, saved: Mapping[str, float], tolerance: float) -> tuple[str, ...]:
        """Of all choices whose picture stays within the tolerance, the one that saves most."""
        choices = [names for count in range(8) for names in combinations(EFFECTS, count)]
        in_turn = sorted(choices, key=lambda names: -time_saved(saved, names))
        return next(names for names in in_turn if self.error_without(names) <= tolerance)


def row(pictures: Pictures, saved: Mapping[str, float], tolerance: float) -> Row:
    """What is recorded of a photograph."""
    costs = {name: significant(cost, 4) for name, cost in pictures.complete.costs.items()}
    best = pictures.best(saved, tolerance)
    plans = (plan(costs, saved, tolerance) for plan in PLANS.values())
    choices = {best, *(in_order(names) for names in plans)}
    errors = {names: significant(pictures.error_without(names), 4) for names in sorted(choices)}
    return tuple(costs.values()), tuple(saved.values()), best, errors


def main() -> None:
    rows = []
    for seed in range(COUNT):
        *_, measured = savings(drawn_photo(seed), time.process_time, ROUNDS)
        saved = {name: significant(ms, 3) for name, ms in measured.items()}
        rows.append(row(Pictures.of(drawn_photo(seed)), saved, tolerance_of(seed)))
        print(seed, *rows[-1], flush=True)
    lines = "".join(f"    {each!r},\n" for each in rows)
    replace_file(DATA, f"{HEAD}{lines})\n".encode())


if __name__ == "__main__":
    main()
