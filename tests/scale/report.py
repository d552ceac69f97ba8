"""What was measured, as tables in Markdown."""

from collections.abc import Sequence
from dataclasses import dataclass

from scale.cost import Cost, growth

REFERENCE = "MkDocs"
HEAD = (
    "| Chapters | Builder | Cold: processor | clock | memory | × MkDocs "
    "| One line edited: processor | clock | × MkDocs |\n"
    "|---|---|---|---|---|---|---|---|---|\n"
)


@dataclass(frozen=True, slots=True)
class Run:
    """One builder at one size."""

    builder: str
    chapters: int
    cold: Cost
    edited: Cost


def report(runs: Sequence[Run]) -> str:
    """Costs at each size, then how each builder's grow."""
    reference = {run.chapters: run for run in runs if run.builder == REFERENCE}
    rows = "".join(_row(run, reference[run.chapters]) for run in runs)
    names = dict.fromkeys(run.builder for run in runs)
    powers = "".join(_growth(name, [run for run in runs if run.builder == name]) for name in names)
    return (
        f"{HEAD}{rows}\nTime is as the number of chapters to the power of, by least squares:\n\n"
        f"| Builder | Cold | One line edited | Memory |\n|---|---|---|---|\n{powers}"
    )


def _row(run: Run, reference: Run) -> str:
    cold, edited = run.cold, run.edited
    return (
        f"| {run.chapters} | {run.builder} | {cold.cpu_s:.2f} s | {cold.wall_s:.2f} s "
        f"| {cold.peak_mb:.0f} MB | {cold.cpu_s / reference.cold.cpu_s:.2f} "
        f"| {edited.cpu_s:.2f} s | {edited.wall_s:.2f} s "
        f"| {edited.cpu_s / reference.edited.cpu_s:.2f} |\n"
    )


def _growth(name: str, runs: Sequence[Run]) -> str:
    sizes = [run.chapters for run in runs]
    powers = (
        growth(sizes, [run.cold.cpu_s for run in runs]),
        growth(sizes, [run.edited.cpu_s for run in runs]),
        growth(sizes, [run.cold.peak_mb for run in runs]),
    )
    return f"| {name} | {' | '.join(f'{power:.2f}' for power in powers)} |\n"
