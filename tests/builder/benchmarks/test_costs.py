"""Numbers of what pages cost, in running text."""

import json
from pathlib import Path

import pytest

from site_builder.benchmarks.costs import DATA, Cost, CostError, Costs, read_costs

COSTS = Costs({"start": {"cold": {"book_ms": 1234.5, "ratio": 0.41}}, "machine": {"cores": 2}})


def test_a_number_has_the_unit_that_its_name_ends_in() -> None:
    assert COSTS.find("start cold book_ms") == Cost(1234.5, "ms")


def test_a_ratio_and_a_count_have_none() -> None:
    assert COSTS.find("start cold ratio") == Cost(0.41, "")
    assert COSTS.find("machine cores") == Cost(2.0, "")


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("start cold book", "did you mean 'book_ms'"),
        ("starts", "did you mean 'start'"),
        ("start cold", "book_ms, ratio"),
        ("start cold ratio more", "unknown cost 'more'"),
    ],
)
def test_what_was_not_measured_is_refused_with_what_was(asked: str, told: str) -> None:
    with pytest.raises(CostError, match=told):
        COSTS.find(asked)


def test_a_book_that_measured_nothing_is_told_how(tmp_path: Path) -> None:
    with pytest.raises(CostError, match="run `make bench`"):
        read_costs(tmp_path)
    (tmp_path / DATA).parent.mkdir()
    (tmp_path / DATA).write_text(json.dumps({"a_kb": 3}), encoding="utf-8")
    assert read_costs(tmp_path).find("a_kb") == Cost(3.0, "KB")
