"""What leaving out each effect costs and saves in the photographs of `world.camera_budget`,
and what its best choice saves: ``PYTHONPATH=tests python -m bench.omissions``.

Times are of processor time, the fastest of `ROUNDS`. The best choice is the best of all whose
picture, which is taken, stays within the tolerance. The results go into
``simulations/world/budget_costs.py``, since the reader's browser needs them.
"""

import time
from collections.abc import Mapping
from itertools import combinations
from pathlib import Path

from simulations.engine.stages import StageCache
from simulations.world import camera_budget
from simulations.world.camera_budget import COUNT, drawn_photo, tolerance_of
from simulations.world.omissions import (
    EFFECTS,
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
HEAD = '''"""Costs in codes and savings in milliseconds of each effect, by photograph, and what its
best choice saves: written by `make bench`."""

type Row = tuple[tuple[float, ...], tuple[float, ...], float]

FOUND: tuple[Row, ...] = (
'''


def most_saved(
    photo: Photo, costs: Mapping[str, float], saved: Mapping[str, float], tolerance: float
) -> float:
    """Milliseconds that the best of all choices saves whose picture stays within the tolerance."""
    cache = StageCache(depth=64)
    truth = complete_model(photo, cache).mean
    choices = [names for count in range(8) for names in combinations(EFFECTS, count)]
    for names in sorted(choices, key=lambda names: -sum(saved[name] for name in names)):
        light = run_without(photo, names, cache)["falloff"]
        if error_without(names, light, truth, costs["poisson"]) <= tolerance:
            return sum(saved[name] for name in names)
    raise AssertionError("without leaving anything out there is no error")


def main() -> None:
    rows = []
    for seed in range(COUNT):
        photo = drawn_photo(seed)
        costs = {n: significant(c, 4) for n, c in complete_model(photo).costs.items()}
        *_, measured = savings(photo, time.process_time, ROUNDS)
        saved = {name: significant(ms, 3) for name, ms in measured.items()}
        most = significant(most_saved(photo, costs, saved, tolerance_of(seed)), 4)
        print(seed, costs, saved, most, flush=True)
        rows.append((tuple(costs.values()), tuple(saved.values()), most))
    lines = "".join(
        f"    (\n        {c},\n        {s},\n        {most},\n    ),\n" for c, s, most in rows
    )
    replace_file(DATA, f"{HEAD}{lines})\n".encode())


if __name__ == "__main__":
    main()
