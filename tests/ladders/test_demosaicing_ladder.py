"""Which demosaicing method wins depends on whether the colours have edges in common."""

import warnings
from itertools import pairwise

import numpy as np
import pytest

from simulations.engine.ladder import pareto_front
from simulations.ladders.demosaicing import LADDER, ROOM, prepare, reference

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # the oracle warns that it cannot plot
    import colour_demosaicing as oracle

WORK = prepare()
TRUTH = reference(WORK)
RESULTS = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
METHODS = ("nearest", "bilinear", "malvar", "menon")


def psnr(metric: str) -> dict[str, float]:
    (chosen,) = (each for each in LADDER.metrics if each.id == metric)
    return {method: chosen.measure(RESULTS[method], TRUTH, WORK) for method in METHODS}


def test_the_tiers_stand_in_order_of_their_work() -> None:
    assert tuple(tier.id for tier in LADDER.tiers) == METHODS


def test_each_step_is_worth_decibels_where_the_colours_share_their_edges() -> None:
    room = psnr("psnr-room")
    assert all(room[b] > room[a] + 2 for a, b in pairwise(METHODS))


def test_the_order_is_reversed_where_the_colours_have_nothing_in_common() -> None:
    soft = psnr("psnr-soft")
    assert soft["bilinear"] > soft["malvar"] + 3 > soft["menon"] + 6


def test_bilinear_errs_on_a_wave_by_what_its_mean_of_neighbours_leaves() -> None:
    """Midway between two samples of a wave the mean is the wave times cos(its phase step)."""
    rows, columns = 96, 120  # a red pixel; its right neighbour lacks red
    measured = RESULTS["bilinear"][2][rows, columns + 1, 0] - 0.5
    step = 2 * np.pi * np.cos(0.2) / 12.0
    assert measured == pytest.approx(
        (TRUTH[2][rows, columns + 1, 0] - 0.5) * np.cos(step), abs=1e-6
    )


def test_detail_too_fine_for_any_mosaic_wins_the_dearest_method_nothing() -> None:
    balloon = psnr("psnr-balloon")
    assert balloon["menon"] < balloon["malvar"] + 0.5


@pytest.mark.parametrize(
    ("method", "theirs"),
    [
        ("bilinear", oracle.demosaicing_CFA_Bayer_bilinear),
        ("malvar", oracle.demosaicing_CFA_Bayer_Malvar2004),
        ("menon", oracle.demosaicing_CFA_Bayer_Menon2007),
    ],
)
def test_an_independent_implementation_reaches_the_same_figure(method, theirs) -> None:
    metric = LADDER.metrics[ROOM]
    picture = np.clip(theirs(WORK.mosaics[ROOM], "RGGB"), 0, 1)
    expected = metric.measure((picture,), TRUTH, WORK)
    assert metric.measure(RESULTS[method], TRUTH, WORK) == pytest.approx(expected, abs=0.05)


def test_the_metric_notices_a_picture_that_has_moved_by_a_pixel() -> None:
    moved = tuple(np.roll(picture, 1, axis=1) for picture in TRUTH)
    assert all(metric.measure(moved, TRUTH, WORK) < 40 for metric in LADDER.metrics)
    assert LADDER.metrics[0].measure(TRUTH, TRUTH, WORK) == np.inf


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    room = psnr("psnr-room")
    front = pareto_front([(rank, -room[method]) for rank, method in enumerate(METHODS)])
    assert front[METHODS.index(LADDER.default_tier)]
