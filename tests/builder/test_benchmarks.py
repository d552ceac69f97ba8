"""Benchmark results: records, verdicts, default tiers, formatted numbers, charts and costs."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.ladders import timing as timed
from support.ladders import toy_data, toy_ladder, toy_measurements
from support.little_book import MakeBook

from simulations.engine.frame import Frame
from simulations.engine.ladder import TierResult
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from simulations.registry import LADDER_MODULES
from site_builder.benchmarks.charts import linear_axis, log_axis, pareto_chart
from site_builder.benchmarks.judgements import (
    Neighbour,
    default_choice,
    efficiency,
    frame_percent,
    nanoseconds_each,
    off_the_front,
    quantity,
    verdict,
)
from site_builder.benchmarks.measurements import MeasuredLadder, MeasurementError, Measurements
from site_builder.benchmarks.measuring import close, finite, merge, timing
from site_builder.benchmarks.quoted_numbers import DATA as COSTS
from site_builder.benchmarks.quoted_numbers import STAGE_DATA as DATA
from site_builder.benchmarks.quoted_numbers import read_cost, read_stage_costs
from site_builder.cache.hashing import book_hash

ABACUS, SLIDE_RULE = {"processor": "abacus"}, {"processor": "slide rule"}
TIERS = toy_data()["ladders"]["toy"]["tiers"]
ROUNDED = {"fine": {"errors": {"rms": 2e-16}}, "exact": {"errors": {"rms": 1e-16}}}
VALUES = st.lists(st.floats(1e-15, 1e6), min_size=1, max_size=9)


def toy_with(changes: Any, *metric: str) -> MeasuredLadder:
    """The measured toy ladder, with some results changed."""
    tiers = toy_data()["ladders"]["toy"]["tiers"]
    for tier, parts in changes.items():
        for part, numbers in parts.items():
            tiers[tier][part] |= numbers if part == "errors" else timed(numbers)
    return toy_measurements(tiers=tiers).find("toy", *metric)


def test_fastest_round_is_recorded() -> None:
    rounds = [
        TierResult(
            tier="only", milliseconds=ms, low_ms=0.9 * ms, high_ms=1.1 * ms, repeats=7, errors={}
        )
        for ms in (3.0, 2.0, 9.0)
    ]
    found = timing(rounds)
    assert found == {"ms": 2.0, "low": 1.8, "high": 2.2, "samples": 7}
    assert set(found) == set(TIERS["rough"]["native"])


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        (2.0, 2.01, True), (2.0, 2.1, False), (1e-5, 2.5e-5, True), (1e-5, 4e-5, False),
        (0.0, 3e-16, True), (0.0, 1e-6, False), (None, None, True), (None, 99.0, False),
        (-0.5, -0.5, True),
    ],
)  # fmt: skip
def test_errors_of_two_machines_agree_up_to_rounding(
    one: float | None, other: float | None, alike: bool
) -> None:
    assert close(one, other) is close(other, one) is alike


def test_recorded_errors_are_rounded_and_nan_is_refused() -> None:
    assert finite(float("inf")) is None
    assert finite(0.1234567) == 0.123457
    with pytest.raises(ValueError, match="NaN"):
        finite(float("nan"))


@pytest.mark.parametrize(
    ("machine", "new", "known", "ladders"),
    [
        (ABACUS, {"a": 9}, "ba+", {"a": 9, "b": 2}),
        (ABACUS, {"+": 9}, "ba+", {"a": 1, "b": 2, "+": 9}),
        (SLIDE_RULE, {"a": 7, "b": 9}, "ab", {"a": 7, "b": 9}),
        (SLIDE_RULE, {"b": 9}, "ab", None),
    ],
)
def test_new_results_are_merged_with_the_old_ones_of_the_same_machine(
    machine: Any, new: Any, known: str, ladders: Any, tmp_path: Path
) -> None:
    file = tmp_path / "measurements.json"
    old = {"machine": ABACUS, "ladders": {"a": 1, "b": 2, "gone": 3}}
    file.write_text(json.dumps(old), encoding="utf-8")
    if ladders is None:
        with pytest.raises(SystemExit, match="another machine"):
            merge(file, machine, new, known)
    else:
        merged = merge(file, machine, new, known)
        assert merged == {"machine": machine, "ladders": ladders}
        assert [*merged["ladders"]] == [*ladders]


def test_ladders_measured_with_other_sources_are_named() -> None:
    now = {name: {"sources": book_hash(module)} for name, module in LADDER_MODULES.items()}
    first, second, *_ = now
    entries: Any = {**now, first: {"sources": now[second]["sources"]}, second: {}, "gone": now}
    assert [*Measurements(ladders=entries).changed()] == [first]


def test_beaten_tier_names_the_tier_that_beats_it() -> None:
    toy = toy_with({})
    winners = [toy.beaten_by(item, "native") for item in toy.tiers]
    assert [winner and winner.tier.id for winner in winners] == [None, None, "fine", None]
    rounded = toy_with(ROUNDED)
    winner = rounded.beaten_by(rounded["exact"], "native")
    assert winner is not None
    assert winner.tier.id == "fine"


@pytest.mark.parametrize(
    ("tier", "changes", "words"),
    [
        ("exact", {}, "on the front"),
        ("waste", {}, "beaten by Fine"),
        ("waste", {"native": 2.2}, "beaten by Fine in the browser only"),
        ("waste", {"native": 9.0, "browser": 1.0}, "beaten by Fine in CPython only"),
        ("waste", {"native": 0.5, "browser": 27.0}, "beaten by Fine in the browser only"),
        ("waste", {"native": 1.95, "browser": 6.1}, "on the front in CPython only"),
        ("waste", {"native": 2.1, "browser": 5.9}, "on the front in the browser only"),
        ("waste", {"native": 2.1, "browser": 6.1}, "close behind the front"),
    ],
)
def test_verdict_compares_a_tier_with_the_front(tier: str, changes: Any, words: str) -> None:
    """*Fine* takes 2 ms natively and 6 ms in the browser; with two changes *waste* errs as much."""
    same = {"errors": TIERS["fine"]["errors"]} if len(changes) == 2 else {}
    toy = toy_with({tier: {**changes, **same}})
    assert verdict(toy, toy[tier]) == words


def test_each_metric_has_its_own_front() -> None:
    toy = toy_with({"waste": {"errors": {"psnr": 55.0}}}, "psnr")
    assert toy.beaten_by(toy["waste"], "native") is None
    assert [item.tier.id for item in toy.front("native")] == ["rough", "fine", "waste", "exact"]


EXACT = Neighbour("Exact", "4.5", "no error")
FREE = {"fine": {"errors": {"rms": 0.0}}, "rough": {"browser": 7.0}}
TWO_CHEAPER = {"waste": {"browser": 4.0}}
TWO_DEARER = {"rough": {"errors": {"rms": 0.005}, "browser": 12.0}}


@pytest.mark.parametrize(
    ("changes", "cheaper", "dearer"),
    [
        ({}, Neighbour("Rough", "0.25", "3.0\u00a0px"), EXACT),
        (FREE, None, None),
        (TWO_CHEAPER, Neighbour("Waste", "0.67", "0.50\u00a0px"), EXACT),
        (TWO_DEARER, None, Neighbour("Rough", "2.0", "0.0050\u00a0px")),
        (ROUNDED, Neighbour("Rough", "0.25", "3.0\u00a0px"), None),
    ],
)
def test_default_tier_is_shown_with_its_neighbours_on_the_front(
    changes: Any, cheaper: object, dearer: object
) -> None:
    choice = default_choice(toy_with(changes))
    assert (choice.label, choice.ms) == ("Fine", "6.0")
    assert (choice.cheaper, choice.dearer) == (cheaper, dearer)


def test_default_off_the_front_is_reported() -> None:
    assert off_the_front(toy_with({"exact": {"browser": 5.0}})) == (
        "toy: the default 'fine' (6.0 ms, 0.020\u00a0px) is off the browser's front, "
        "which has 'exact' (5.0 ms, no error)"
    )
    equal = {"errors": TIERS["fine"]["errors"], "native": 2.0, "browser": 6.0}
    assert off_the_front(toy_with({"waste": equal})) == ""


def test_costs_are_computed_per_item_and_per_frame() -> None:
    toy = replace(toy_with({}), ladder=replace(toy_ladder(), items=1000, item="point"))
    assert nanoseconds_each(toy, toy["fine"]) == pytest.approx(6000)
    assert frame_percent(toy["fine"]) == pytest.approx(18)


def test_half_the_noise_in_the_same_time_is_four_times_as_efficient() -> None:
    toy = toy_with({"fine": {"errors": {"rms": 1.5}, "browser": 1.5}})
    toy = replace(toy, ladder=replace(toy.ladder, sampled=("rough", "fine")))
    assert efficiency(toy, toy["fine"]) == pytest.approx(4)
    assert efficiency(toy, toy["exact"]) is None


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"), (1234.0, "1200"), (123456.0, "1.2\u202f×\u202f10⁵"), (9.96, "10"),
        (0.00996, "0.010"), (6.23e-5, "6.2\u202f×\u202f10⁻⁵"), (-3.04, "−3.0"),
    ],
)  # fmt: skip
def test_quantities_have_two_digits(value: float, text: str) -> None:
    assert quantity(value) == text


@given(VALUES, st.lists(st.floats(-60.0, 120.0), min_size=1, max_size=9))
def test_axes_contain_their_values_and_two_to_ten_ticks(
    values: Sequence[float], decibels: Sequence[float]
) -> None:
    time, error = log_axis(values, 50.0, 446.0), linear_axis(decibels, 50.0, 446.0)
    for axis, shown in ((time, values), (error, decibels)):
        places = [axis.position(value) for value in sorted(shown)]
        assert places == sorted(places)
        assert all(50.0 < place < 446.0 for place in places)
        ticks = [axis.position(value) for value, _ in axis.ticks()]
        assert 2 <= len(ticks) <= 10
        assert all(50.0 <= place <= 446.0 for place in ticks)
        assert len({label for _, label in axis.ticks()}) == len(ticks)


def test_chart_joins_the_front_and_sets_beaten_and_exact_tiers_apart() -> None:
    chart = pareto_chart(toy_measurements().find("toy"))
    lines = re.findall(r'<polyline class="image faint(?: dashed)?" points="([^"]*)"', chart.marks)
    assert [len(points.split()) for points in lines] == [3, 3]
    assert chart.marks.count("muted solid") == chart.marks.count("muted hollow") == 1
    assert chart.error.none is not None
    assert chart.error.position(0.0) == chart.error.none > chart.error.position(0.02) + 10.0


@pytest.mark.parametrize(
    ("path", "found"),
    [
        ("start cold book_ms", (1234.5, "ms")),
        ("start cold ratio", (0.41, "")),
        ("machine cores", (2.0, "")),
        ("start cold book", "did you mean 'book_ms'"),
        ("starts", "did you mean 'start'"),
        ("start cold", "book_ms, ratio"),
        ("start cold ratio more", "unknown cost 'more'"),
    ],
)
def test_cost_is_found_by_its_path_or_refused_with_a_suggestion(
    path: str, found: tuple[float, str] | str, tmp_path: Path
) -> None:
    with pytest.raises(MeasurementError, match="run `make bench`"):
        read_cost(tmp_path, "start")
    file = tmp_path / COSTS
    file.parent.mkdir()
    start = {"cold": {"book_ms": 1234.5, "ratio": 0.41}}
    file.write_text(json.dumps({"start": start, "machine": {"cores": 2}}), encoding="utf-8")
    if isinstance(found, str):
        with pytest.raises(MeasurementError, match=found):
            read_cost(tmp_path, path)
    else:
        cost = read_cost(tmp_path, path)
        assert not isinstance(cost, str)
        assert (cost.value, cost.unit) == found


@dataclass(frozen=True, slots=True)
class Settings:
    number: float = slider("Number", 2, 0, 9, 1)
    gain: float = slider("Gain", 3, 0, 9, 1)
    offset: float = slider("Offset", 0, 0, 9, 1)


def lifted(value: float, offset: float) -> float:
    return value + offset


def draw(_settings: Settings, outputs: Outputs) -> Frame:
    return Frame((), (), f"{outputs['lifted']:g} in all.")


SUMS = Scene(
    "sums", "Sums", Settings, draw,
    stages=(
        Stage("tens", lambda number: 10 * number),
        Stage("gained", lambda tens, gain: gain * tens, ("tens",)),
        Stage("lifted", lifted, ("gained",), neutral=lambda offset: "" if offset else "no offset"),
    ),
)  # fmt: skip
MOVE = {"to": 1, "ms": 1.0, "whole_ms": 2.0, "share": 0.5}


@pytest.mark.parametrize(
    ("start", "control", "again", "reused", "skipped"),
    [
        ({}, "offset", ("lifted",), 2, 0),
        ({}, "number", ("tens", "gained"), 0, 1),
        ({"offset": 4}, "number", ("tens", "gained", "lifted"), 0, 0),
    ],
)
def test_recorded_move_reruns_the_stages_that_depend_on_it(
    start: object, control: str, again: object, reused: int, skipped: int, tmp_path: Path
) -> None:
    (tmp_path / DATA).parent.mkdir()
    recorded = {"sums": {"start": start, "moves": {control: MOVE}}}
    (tmp_path / DATA).write_text(json.dumps(recorded), encoding="utf-8")
    costs = read_stage_costs(tmp_path, SUMS)
    (move,) = costs.moves
    assert (move.again, move.reused, move.skipped, costs.stages) == (again, reused, skipped, 3)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "has no scene 'demo'"),
        ({"other": {}}, "has no scene 'demo'"),
        ([], "has no scene 'demo'"),
        ({"demo": {"start": {}}}, "KeyError: 'moves'"),
        ({"demo": {"start": {}, "moves": {}}}, "no median for empty data"),
        ({"demo": {"start": {}, "moves": {"zoom": MOVE}}}, "unknown parameter 'zoom'"),
    ],
)
def test_stale_costs_of_stages_are_refused(
    make_book: MakeBook, content: object, message: str
) -> None:
    options = make_book(files={str(DATA): None if content is None else json.dumps(content)})
    with pytest.raises(MeasurementError, match=f"(?s){message}.*bench.stage_costs"):
        read_stage_costs(options.root, options.load_scene("demo"))
