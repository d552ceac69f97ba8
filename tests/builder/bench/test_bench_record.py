"""What ``bench`` keeps of its results."""

import json
from pathlib import Path

import pytest
from support.places import ROOT
from support.toy_ladder import toy_data

from simulations.engine.ladder import TierResult
from site_builder.bench.record import close, finite, merge, timing, write

MACHINE = {"processor": "abacus"}


def result(ms: float) -> TierResult:
    return TierResult("only", ms, 0.9 * ms, 1.1 * ms, 7, {})


def test_the_quietest_round_is_kept_with_its_own_quartiles() -> None:
    rounds = [result(3.0), result(2.0), result(9.0)]
    assert timing(rounds) == {"ms": 2.0, "low": 1.8, "high": 2.2, "samples": 7}


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        (2.0, 2.01, True),
        (2.0, 2.1, False),
        (1e-5, 2.5e-5, True),
        (1e-5, 4e-5, False),
        (0.0, 3e-16, True),
        (0.0, 1e-6, False),
        (None, None, True),
        (None, 99.0, False),
        (-0.5, -0.5, True),
    ],
)
def test_errors_of_two_machines_agree_but_for_rounding(
    one: float | None, other: float | None, alike: bool
) -> None:
    assert close(one, other) is alike
    assert close(other, one) is alike


def test_no_error_at_all_is_null_and_nan_is_refused() -> None:
    assert finite(float("inf")) is None
    assert finite(0.1234567) == 0.123457
    with pytest.raises(ValueError, match="NaN"):
        finite(float("nan"))


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "measurements.json"
    old = {"machine": MACHINE, "ladders": {"a": 1, "b": 2, "gone": 3}}
    path.write_text(json.dumps(old), encoding="utf-8")
    return path


def test_one_ladder_measured_anew_leaves_the_others_and_their_places(file: Path) -> None:
    merged = merge(file, MACHINE, {"a": 9}, ["b", "a", "new"])
    assert list(merged["ladders"].items()) == [("a", 9), ("b", 2)]
    merged = merge(file, MACHINE, {"new": 9}, ["b", "a", "new"])
    assert list(merged["ladders"].items()) == [("a", 1), ("b", 2), ("new", 9)]


def test_one_ladder_from_another_machine_is_refused(file: Path) -> None:
    with pytest.raises(SystemExit, match="another machine"):
        merge(file, {"processor": "slide rule"}, {"b": 9}, ["a", "b"])


def test_all_ladders_from_another_machine_replace_the_file(file: Path) -> None:
    merged = merge(file, {"processor": "slide rule"}, {"a": 7, "b": 9}, ["a", "b"])
    assert merged == {"machine": {"processor": "slide rule"}, "ladders": {"a": 7, "b": 9}}


def test_what_the_tests_of_the_builder_read_is_of_the_same_form() -> None:
    (tier, *_) = toy_data()["ladders"]["toy"]["tiers"].values()
    assert set(tier["native"]) == set(timing([result(1.0)]))


@pytest.mark.parametrize("name", ["measurements", "costs", "stage-costs"])
def test_a_recorded_file_is_as_its_writer_lays_it_out(name: str, tmp_path: Path) -> None:
    recorded = (ROOT / "content" / f"{name}.json").read_text(encoding="utf-8")
    write(json.loads(recorded), tmp_path / "again.json")
    assert (tmp_path / "again.json").read_text(encoding="utf-8") == recorded
