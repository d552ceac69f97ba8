"""What is recorded of the camera's moves bears the claims that the book makes of them."""

from pathlib import Path

import pytest

from simulations.registry import load_scene
from site_builder.benchmarks.stage_costs import StageCosts, read_stage_costs
from site_builder.figures.frames import reports_at

ROOT = Path(__file__).resolve().parents[2]


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
