"""Filling in colour: what is best for plain means is not what is best after rounding."""

import cv2
import numpy as np
import pytest

from simulations.engine.ladder import pareto_front
from simulations.ladders.chroma_upsampling import LADDER, prepare, reference
from simulations.models.compression.chroma_upsampling import METHODS

WORK = prepare()
TRUTH = reference(WORK)
RESULTS = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
RMS = {
    metric.id: {name: metric.measure(result, TRUTH, WORK) for name, result in RESULTS.items()}
    for metric in LADDER.metrics
}


def test_the_tiers_are_all_methods_of_the_model_in_order_of_their_work() -> None:
    assert tuple(tier.id for tier in LADDER.tiers) == METHODS


@pytest.mark.parametrize("metric", RMS)
def test_repetition_is_the_worst_and_luma_the_best_guide(metric: str) -> None:
    assert max(RMS[metric], key=RMS[metric].__getitem__) == "repeated"
    assert min(RMS[metric], key=RMS[metric].__getitem__) == "guided"


@pytest.mark.parametrize("metric", ["room-means", "balloon-means"])
def test_plain_means_are_best_undone_by_what_keeps_them(metric: str) -> None:
    """Three taps of the parabola do better than four of the cubic, and far better than two."""
    means = RMS[metric]
    assert means["parabola"] < 0.99 * means["cubic"]
    assert means["parabola"] < 0.9 * means["triangle"]
    assert means["guided"] < 0.7 * means["parabola"]


def test_after_rounding_the_triangle_is_better_than_the_parabola() -> None:
    """It averages the noise of rounding, which the parabola sharpens."""
    assert RMS["room"]["triangle"] < 0.97 * RMS["room"]["parabola"]
    assert RMS["balloon"]["triangle"] < 0.99 * RMS["balloon"]["parabola"]


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    room = [RMS["room"][name] for name in METHODS]
    assert pareto_front(list(enumerate(room)))[METHODS.index(LADDER.default_tier)]


def test_opencv_reaches_the_same_figure() -> None:
    _, blue, red = WORK.decoded[0]
    full = np.stack(
        [cv2.resize(p, (240, 192), interpolation=cv2.INTER_LINEAR) for p in (blue, red)]
    )
    expected = float(np.sqrt(np.mean((full - TRUTH[0]) ** 2)))
    assert RMS["room"]["triangle"] == pytest.approx(expected, abs=1e-9)


def test_the_metrics_notice_colour_that_has_moved_by_a_pixel() -> None:
    moved = tuple(np.roll(planes, 1, axis=2) for planes in TRUTH)
    for metric in LADDER.metrics:
        assert metric.measure(TRUTH, TRUTH, WORK) == 0
        assert metric.measure(moved, TRUTH, WORK) > 1
