"""The table of what a moved control costs: measured shares, stages found anew at every build."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from support.html_outline import read_html

from simulations.registry import load_scene
from site_builder.build import Options, render_site
from site_builder.drawing.frames import reports_at
from site_builder.measured.stage_costs import (
    DATA,
    StageCostError,
    StageCosts,
    read_stage_costs,
)
from site_builder.output.assets import content_bytes

ROOT = Path(__file__).resolve().parents[3]
MOVE = {"to": 1, "ms": 1.0, "whole_ms": 2.0, "share": 0.5}


@pytest.fixture(scope="module")
def costs() -> StageCosts:
    """What is recorded of the camera."""
    return read_stage_costs(ROOT, load_scene("camera"))


def test_the_recorded_shares_are_what_the_book_promises(costs: StageCosts) -> None:
    """Times of another machine are not tested; that the recorded ones bear the claim is."""
    share = {move.label: move.share for move in costs.moves}
    assert max(share["Read noise σ"], share["Exposure"]) <= 0.10
    late = max(share["Aperture"], share["Light angle"], share["Distortion k₁"])
    assert late <= 0.50
    # What moves the rays is followed by nearly everything.
    assert min(share["Focus distance"], share["Focal length"]) > late
    assert all(0 < each <= 1 for each in share.values())


def test_a_move_far_upstream_runs_every_stage_that_would_change_something(
    costs: StageCosts,
) -> None:
    by_label = {move.label: move for move in costs.moves}
    assert by_label["Read noise σ"].again == ("read noise", "quantisation", "sRGB")
    for moved in (by_label["Focal length"], by_label["Focus distance"]):
        assert "grain" not in moved.again
        assert moved.reused == 1  # the grain, which follows from nothing but the picture's number
        assert len(moved.again) + moved.skipped == costs.stages - 1


def test_nothing_moved_from_nothing_computes_all_but_the_neutral() -> None:
    statuses = {stage.status for stage in reports_at(load_scene("camera"), {}, {})}
    assert statuses == {"computed", "skipped"}


def test_a_page_lists_every_move_and_a_frame_with_nothing_at_hand(
    make_book: Callable[..., Options],
) -> None:
    recorded = {"demo": {"start": {}, "moves": {"k1": {**MOVE, "to": 0.5}}}}
    options = make_book(":::{stage-costs} demo\nMoves.\n:::\n", {str(DATA): json.dumps(recorded)})
    page = content_bytes(render_site(options)["first/index.html"])
    table = read_html(page).all("figure", "stage-costs")
    assert len(table) == 1
    assert "Distortion" in page.decode()
    assert "Nothing at hand" in page.decode()


def test_a_table_of_an_unmeasured_scene_is_reported(mistakes: Callable[..., list[str]]) -> None:
    assert mistakes(":::{stage-costs} demo\n:::\n") == [
        "content/00-first.md:5: content/stage-costs.json has no scene 'demo'; "
        "run `PYTHONPATH=tests python -m bench.stage_costs`"
    ]


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
    ids=[
        "no file",
        "another scene",
        "a list",
        "no moves",
        "empty moves",
        "a control that has gone",
    ],
)
def test_stale_data_say_how_to_measure_again(
    make_book: Callable[..., Options], content: object, said: str
) -> None:
    options = make_book(files={str(DATA): None if content is None else json.dumps(content)})
    with pytest.raises(StageCostError, match=said) as raised:
        read_stage_costs(options.root, options.load_scene("demo"))
    assert "bench.stage_costs" in str(raised.value)
