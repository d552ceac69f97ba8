"""``score.txt``: what became of the mutants of each module, held out and all of them."""

from dataclasses import dataclass
from pathlib import Path

TITLE = """\
Mistakes in simulations/models that the tests notice; written by `make mutants`.

Held out: a sample drawn after the tests were written, as first found, and not judged again since.
All: every mutant, after tests were added for those that had survived. What still survives are
mistakes that change nothing anyone can see; 100% is not to be had.
A row is of when its module was last tried; modules without a row never were.
"""
HEADING = f"{'':38}{'held out':>26}{'all':>32}"
COLUMNS = (
    f"{'module':38}{'tried':>10}{'noticed':>8}{'score':>8}"
    f"{'mutants':>10}{'noticed':>8}{'survived':>9}{'score':>8}"
)


@dataclass(frozen=True, slots=True)
class Score:
    """What became of some mutants of one module."""

    mutants: int
    """How many were chosen."""
    survived: int
    """How many of those no test has noticed."""

    @property
    def noticed(self) -> int:
        return self.mutants - self.survived

    @property
    def share(self) -> str:
        return f"{100 * self.noticed / self.mutants:.1f}%" if self.mutants else "—"

    def __add__(self, other: "Score") -> "Score":
        return Score(self.mutants + other.mutants, self.survived + other.survived)


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the table; a half of it may not have been measured yet."""

    held_out: Score | None = None
    """Of the sample."""
    all: Score | None = None
    """Of all mutants."""

    def line(self, module: str) -> str:
        left = right = ""
        if held := self.held_out:
            left = f"{held.mutants:10}{held.noticed:8}{held.share:>8}"
        if a := self.all:
            right = f"{a.mutants:10}{a.noticed:8}{a.survived:9}{a.share:>8}"
        return f"{module:38}{left or '—':>26}{right or '—':>35}"


def read_table(file: Path) -> dict[str, Row]:
    """Rows by module; none where there is no file."""
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    start = lines.index(COLUMNS) + 1 if COLUMNS in lines else len(lines)
    rows = (line.split() for line in lines[start:])
    return {row[0]: _row(row[1:]) for row in rows if row and row[0] != "total"}


def _row(cells: list[str]) -> Row:
    """Inverse of `Row.line`: a half that was not measured is one dash."""
    held = everything = None
    if cells[0] != "—":
        held = Score(int(cells[0]), int(cells[0]) - int(cells[1]))
    right = cells[3 if held else 1 :]
    if right[0] != "—":
        everything = Score(int(right[0]), int(right[2]))
    return Row(held, everything)


def write_table(file: Path, rows: dict[str, Row]) -> None:
    """Modules by name, and their sum."""
    lines = [rows[module].line(module) for module in sorted(rows)]
    held = [row.held_out for row in rows.values() if row.held_out]
    everything = [row.all for row in rows.values() if row.all]
    none = Score(0, 0)
    total = Row(sum(held, none) if held else None, sum(everything, none) if everything else None)
    text = [TITLE, HEADING, COLUMNS, *lines, total.line("total")]
    file.write_text("\n".join(text) + "\n", "utf-8")
