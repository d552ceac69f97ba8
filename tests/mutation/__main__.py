"""How many plausible mistakes in the models do their tests notice: ``make mutants``.

A seeded sample of each module's mutants (``SAMPLE=all`` for every one) is run against the tests
of that module. Mutants that no test can notice are listed, with the reason, in
``equivalent.txt``, and left out of the score. The scores go into ``score.txt``.

Why not a ready-made tool: those rewrite the working copy or start pytest anew for each mutant,
and know nothing of axes, tolerances or trigonometry.
"""

import argparse
import random
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from mutation.mutants import Mutant, mutants
from mutation.trial import MODELS, survives, tests_of, used_s, warm_up

HERE = Path(__file__).parent
SCORES = HERE / "score.txt"
EQUIVALENT = HERE / "equivalent.txt"
SLOWDOWN = 10
"""A mutant may take this many times as long as the unchanged module, and 5 s more."""


@dataclass(frozen=True, slots=True)
class Score:
    """What became of the mutants of one module."""

    module: str
    """Name of the module in `simulations.models`."""
    mutants: int
    """How many there are."""
    equivalent: int
    """How many of those tried are listed as equivalent."""
    killed: int
    """How many of those tried a test has noticed."""
    survived: int
    """How many no test has noticed."""

    def line(self) -> str:
        tried = self.killed + self.survived
        share = f"{100 * self.killed / tried:.0f} %" if tried else "—"
        return (
            f"{self.module:22}{self.mutants:8}{self.equivalent + tried:8}{self.equivalent:12}"
            f"{self.killed:8}{self.survived:10}{share:>8}"
        )


HEADING = f"{'module':22}{'mutants':>8}{'sample':>8}{'equivalent':>12}{'killed':>8}{'survived':>10}"


def name(module: str, mutant: Mutant) -> str:
    return f"{module}.{mutant.place}: {mutant.after}"


def read_equivalent() -> set[str]:
    lines = EQUIVALENT.read_text("utf-8").splitlines() if EQUIVALENT.exists() else []
    return {line for line in lines if line and not line.startswith("#")}


def judge(module: str, sample: int | None, seed: int, equivalent: set[str]) -> Score | None:
    source = (MODELS / f"{module}.py").read_text("utf-8")
    everything, tests = list(mutants(source)), tests_of(module)
    chosen = everything
    if sample is not None and sample < len(everything):
        order = list(range(len(everything)))
        random.Random(f"{seed} {module}").shuffle(order)  # a larger sample holds the smaller one
        chosen = [everything[index] for index in sorted(order[:sample])]
    known = {name(module, mutant) for mutant in everything}
    for line in sorted(line for line in equivalent - known if line.startswith(f"{module}.")):
        print(f"equivalent.txt: no such mutant: {line}")
    warm_up(tests)
    before_s = used_s()
    if not tests or not survives(module, source, tests, 600):
        print(f"{module}: no test, or one that fails as it is: {[file.name for file in tests]}")
        return None
    limit_s = 5 + int(SLOWDOWN * (used_s() - before_s))
    counted = [mutant for mutant in chosen if name(module, mutant) not in equivalent]
    left = [mutant for mutant in counted if survives(module, mutant.source, tests, limit_s)]
    for mutant in left:
        print(f"\n  - {mutant.before}\n  + {name(module, mutant)}", flush=True)
    skipped, killed = len(chosen) - len(counted), len(counted) - len(left)
    return Score(module, len(everything), skipped, killed, len(left))


def write(lines: Iterable[str], how: str) -> None:
    """Scores of the modules just judged replace theirs; those of others stay."""
    old = SCORES.read_text("utf-8").splitlines() if SCORES.exists() else []
    found = {line.split()[0]: line for line in old if re.match(r"[a-z]\w+ +\d", line)}
    found |= {line.split()[0]: f"{line}   {how}" for line in lines}
    title = "Mistakes in simulations/models that the tests notice; written by `make mutants`."
    rows = [found[module] for module in sorted(found) if (MODELS / f"{module}.py").exists()]
    SCORES.write_text("\n".join([title, "", f"{HEADING}   score", *rows]) + "\n", "utf-8")


def main() -> int:
    modules = sorted(file.stem for file in MODELS.glob("[!_]*.py"))
    parser = argparse.ArgumentParser(prog="make mutants", description=__doc__)
    parser.add_argument("--sample", default="30", help="mutants per module, or: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--module", action="append", choices=modules, default=[])
    parser.add_argument("--dry", action="store_true", help="leave score.txt as it is")
    asked = parser.parse_args()
    sample = None if asked.sample == "all" else int(asked.sample)
    how = "all" if sample is None else f"seed {asked.seed}"
    equivalent, lines = read_equivalent(), []
    print(HEADING + "   score")
    for module in asked.module or modules:
        if not (score := judge(module, sample, asked.seed, equivalent)):
            continue
        lines.append(score.line())
        print(lines[-1], flush=True)
        if not asked.dry:
            write(lines, how)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
