"""The hard cases that the book prints: each is asked, and its answer judged."""

import pytest

from simulations.engine.extreme import ExtremeCase, ExtremeTable, answer, naive_answer, show
from simulations.extremes.tables import TABLES

CASES = [
    pytest.param(table, case, id=f"{table.id}-{case.id}")
    for table in TABLES
    for case in table.cases
]


@pytest.mark.parametrize(("table", "case"), CASES)
def test_model_answers_as_decided(table: ExtremeTable, case: ExtremeCase) -> None:
    got = answer(table, case)
    assert case.expected(got), f"{case.call} gave {show(got)}"


@pytest.mark.parametrize(("table", "case"), [item for item in CASES if item.values[1].naive])
def test_textbook_formula_can_be_shown_beside_it(table: ExtremeTable, case: ExtremeCase) -> None:
    """What it says is not what the model says: else the case would teach nothing."""
    assert show(naive_answer(table, case)) != show(answer(table, case))


def test_there_are_enough_cases_to_mean_something() -> None:
    assert len(CASES) >= 200
    assert all(len(table.cases) >= 8 for table in TABLES)
