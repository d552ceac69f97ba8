"""What ``make bench`` holds against the budgets of pages."""

import json
from pathlib import Path

from bench.costs import beyond, keep

BUDGETS = {"start": {"cold": {"ratio": 0.45}}}


def test_a_cost_within_its_budget_is_not_spoken_of() -> None:
    assert not [*beyond({"start": {"cold": {"ratio": 0.45, "book_ms": 9e9}}}, BUDGETS)]


def test_a_cost_beyond_its_budget_is_named_with_how_far() -> None:
    (said,) = beyond({"start": {"cold": {"ratio": 0.54}}}, BUDGETS)
    assert said == "start cold ratio: 0.54, 20% beyond its budget of 0.45"


def test_a_budget_of_what_was_not_measured_fails_too() -> None:
    assert [*beyond({"start": {}}, BUDGETS)] == ["start cold ratio: not measured"]
    assert [*beyond({"start": {"cold": {"ratio": None}}}, BUDGETS)]


def test_a_cost_that_is_no_number_is_beyond_every_budget() -> None:
    assert [*beyond({"start": {"cold": {"ratio": float("nan")}}}, BUDGETS)]


def test_one_section_is_kept_while_the_others_stay(tmp_path: Path) -> None:
    file = tmp_path / "costs.json"
    keep("start", {"cold": {"ratio": 0.4}}, file)
    keep("bytes", {"paint_kb": 99}, file)
    keep("start", {"cold": {"ratio": 0.3}}, file)
    assert json.loads(file.read_text(encoding="utf-8")) == {
        "bytes": {"paint_kb": 99},
        "start": {"cold": {"ratio": 0.3}},
    }
