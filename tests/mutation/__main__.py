"""How many plausible mistakes in the models do their tests notice: ``make mutants``.

A seeded sample of each module's mutants (``SAMPLE=all`` for every one) is run against the tests
of that module. The score of all mutants goes into ``score.txt``; that of a sample is only printed,
but for one that was drawn to be held out (``--held-out``). Who survived all tests is listed in
``build/survivors.txt``; once there are better tests, ``SAMPLE=survivors`` tries those mutants
alone: what one test notices, more tests notice too.

Why not a ready-made tool: those rewrite the working copy or start pytest anew for each mutant,
and know nothing of axes, tolerances or trigonometry.
"""

import argparse
import random
from dataclasses import replace
from pathlib import Path

from mutation.mutants import Mutant, mutants
from mutation.scores import Row, Score, read_table, write_table
from mutation.trial import ROOT, file_of, modules, survives, tests_of, used_s, warm_up

HERE = Path(__file__).parent
SCORES = HERE / "score.txt"
SURVIVORS = ROOT / "build" / "survivors.txt"
SLOWDOWN = 10
"""A mutant may take this many times as long as the unchanged module, and 5 s more."""


def name(module: str, mutant: Mutant) -> str:
    return f"{module}.{mutant.place}: {mutant.after}"


def read_names(file: Path) -> set[str]:
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    return {line for line in lines if line and not line.startswith("#")}


def chosen_of(module: str, everything: list[Mutant], sample: str, seed: int) -> list[Mutant]:
    """Those asked for, in their order; a larger sample of a seed holds the smaller one."""
    if sample == "survivors":
        left = read_names(SURVIVORS)
        return [mutant for mutant in everything if name(module, mutant) in left]
    order = list(range(len(everything)))
    random.Random(f"{seed} {module}").shuffle(order)
    return [
        everything[index] for index in sorted(order[: None if sample == "all" else int(sample)])
    ]


def prepare(module: str, source: str) -> tuple[list[Path], int]:
    """The tests of a module and a mutant's limit in seconds; no tests if they fail as they are."""
    warm_up(tests := tests_of(module))
    before_s = used_s()
    if not tests or not survives(module, source, tests, 600):
        print(f"{module}: no test, or one that fails as it is: {[file.name for file in tests]}")
        return [], 0
    return tests, 5 + int(SLOWDOWN * (used_s() - before_s))


def judge(module: str, sample: str, seed: int) -> Score | None:
    """Try the mutants of a module; None where there is no score."""
    source = file_of(module).read_text("utf-8")
    tests, limit_s = prepare(module, source)
    if not tests:
        return None
    everything = list(mutants(source))
    chosen = chosen_of(module, everything, sample, seed)
    left = [mutant for mutant in chosen if survives(module, mutant.source, tests, limit_s)]
    for mutant in left:
        print(f"\n  - {mutant.before}\n  + {name(module, mutant)}", flush=True)
    if sample in ("all", "survivors"):  # of the others it is known that a test notices them
        write_survivors(module, [name(module, mutant) for mutant in left])
        return Score(len(everything), len(left))
    return Score(len(chosen), len(left))


def write_survivors(module: str, names: list[str]) -> None:
    """Those of one module replace its old ones."""
    old = {line for line in read_names(SURVIVORS) if not line.startswith(f"{module}.")}
    SURVIVORS.parent.mkdir(exist_ok=True)
    SURVIVORS.write_text("\n".join(sorted(old | set(names))) + "\n", "utf-8")


def record(module: str, score: Score, held_out: bool) -> None:
    """Put one score into its half of the table; all others stay."""
    rows = read_table(SCORES)
    rows = {name: row for name, row in rows.items() if file_of(name).exists()}
    half = {"held_out": score} if held_out else {"all": score}
    rows[module] = replace(rows.get(module, Row()), **half)
    write_table(SCORES, rows)


def main() -> int:
    parser = argparse.ArgumentParser(prog="make mutants", description=__doc__)
    parser.add_argument("--sample", default="30", help="number a module, all, survivors")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--module", action="append", choices=modules(), default=[])
    parser.add_argument("--held-out", action="store_true", help="record this sample in score.txt")
    asked = parser.parse_args()
    for module in asked.module or modules():
        if not (score := judge(module, asked.sample, asked.seed)):
            continue
        print(
            f"{module:38}{score.mutants:5} mutants"
            f"{score.noticed:5} noticed{score.survived:4} survived{score.share:>8}",
            flush=True,
        )
        if asked.sample in ("all", "survivors") or asked.held_out:
            record(module, score, asked.held_out)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
