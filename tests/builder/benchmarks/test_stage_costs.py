"""The table of what a moved control costs: measured shares, stages found anew at every build."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from support.html_outline import read_html
from support.little_book import rendered

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from site_builder.benchmarks.stage_costs import (
    DATA,
    StageCostError,
    StageCosts,
    read_stage_costs,
)
from site_builder.build import Options
from site_builder.figures.frames import reports_at

MOVE = {"to": 1, "ms": 1.0, "whole_ms": 2.0, "share": 0.5}


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


def moved(control: str, to: float, start: dict[str, float], folder: Path) -> StageCosts:
    """Of one measured move of the scene of sums."""
    recorded = {"sums": {"start": start, "moves": {control: {**MOVE, "to": to}}}}
    (folder / DATA).parent.mkdir()
    (folder / DATA).write_text(json.dumps(recorded), encoding="utf-8")
    return read_stage_costs(folder, SUMS)


def test_a_move_at_the_end_leaves_what_comes_before_it(tmp_path: Path) -> None:
    (move,) = moved("offset", 1, {}, tmp_path).moves
    assert (move.again, move.reused, move.skipped) == (("lifted",), 2, 0)


def test_a_move_far_upstream_runs_every_stage_that_would_change_something(tmp_path: Path) -> None:
    costs = moved("number", 1, {}, tmp_path)
    (move,) = costs.moves
    assert (move.again, move.reused, move.skipped) == (("tens", "gained"), 0, 1)
    assert costs.stages == 3


def test_a_move_begins_at_the_start_that_was_measured(tmp_path: Path) -> None:
    (move,) = moved("number", 1, {"offset": 4}, tmp_path).moves
    assert move.again == ("tens", "gained", "lifted")


def test_nothing_moved_from_nothing_computes_all_but_the_neutral() -> None:
    reports = {stage.name: stage.status for stage in reports_at(SUMS, {}, {})}
    assert reports == {"tens": "computed", "gained": "computed", "lifted": "skipped"}


def test_a_page_lists_every_move_and_a_frame_with_nothing_at_hand(
    make_book: Callable[..., Options],
) -> None:
    recorded = {"demo": {"start": {}, "moves": {"k1": {**MOVE, "to": 0.5}}}}
    options = make_book(":::{stage-costs} demo\nMoves.\n:::\n", {str(DATA): json.dumps(recorded)})
    page = rendered(options)["first/index.html"]
    table = read_html(page).all("figure", "stage-costs")
    assert len(table) == 1
    assert "Distortion" in page.decode()
    assert "Nothing cached" in page.decode()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (None, "has no scene 'demo'"),
        ({"other": {}}, "has no scene 'demo'"),
        ([], "has no scene 'demo'"),
        ({"demo": {"start": {}}}, "KeyError: 'moves'"),
        ({"demo": {"start": {}, "moves": {}}}, "no median for empty data"),
        ({"demo": {"start": {}, "moves": {"zoom": MOVE}}}, "unknown parameter 'zoom'"),
    ],
)
def test_stale_data_say_how_to_measure_again(
    make_book: Callable[..., Options], content: object, said: str
) -> None:
    options = make_book(files={str(DATA): None if content is None else json.dumps(content)})
    with pytest.raises(StageCostError, match=said) as raised:
        read_stage_costs(options.root, options.load_scene("demo"))
    assert "bench.stage_costs" in str(raised.value)
