"""The recorded measurements of the book's own ladders: of all of them, and still true."""

import re
from pathlib import Path

import pytest

from simulations.registry import LADDER_MODULES, load_ladder
from site_builder.benchmarks.judgements import off_the_front
from site_builder.benchmarks.measurements import Measurements, read_measurements
from site_builder.benchmarks.record import close, finite
from site_builder.diagnostics.diagnostic import Diagnostics

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def real() -> Measurements:
    problems = Diagnostics()
    found = read_measurements(ROOT, problems)
    assert not problems, problems.found
    return found


def test_every_registered_ladder_is_measured(real: Measurements) -> None:
    assert set(LADDER_MODULES) <= set(real.ladders), "run `make bench`"


@pytest.mark.parametrize("ladder_id", LADDER_MODULES)
def test_the_recorded_errors_are_those_of_the_code(ladder_id: str, real: Measurements) -> None:
    measured, ladder = real.find(ladder_id), load_ladder(ladder_id)
    workload = ladder.prepare()
    reference = ladder.reference(workload)
    for item in measured.tiers:
        result = item.tier.run(workload)
        for metric in ladder.metrics:
            now = finite(metric.measure(result, reference, workload))
            then = item.errors[metric.id]
            assert close(now, then), f"{ladder_id} {item.tier.id} {metric.id}: {now}, was {then}"


def test_every_registered_ladder_is_shown_in_the_book() -> None:
    chapters = "".join(file.read_text(encoding="utf-8") for file in (ROOT / "content").glob("*.md"))
    shown = set(re.findall(r"^:{3,}\{ladder\} (\S+)", chapters, re.MULTILINE))
    assert shown == set(LADDER_MODULES)


def test_the_file_says_nothing_of_whose_machine_it_was(real: Measurements) -> None:
    assert set(real.machine) == {
        "processor", "cores", "system", "python", "numpy", "browser", "pyodide",
    }  # fmt: skip


@pytest.mark.parametrize("ladder_id", LADDER_MODULES)
def test_a_ladder_s_default_is_on_the_front_where_the_book_runs(
    ladder_id: str, real: Measurements
) -> None:
    assert off_the_front(real.find(ladder_id)) == ""
