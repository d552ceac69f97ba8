"""The ways to undo a lens stand in the order that theory gives them."""

from dataclasses import replace
from functools import cache

import cv2
import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders import inverse_strong
from simulations.ladders.inverse_distortion import LADDER, rms_px
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.undistortion import undistort_table

RUN = LadderRun(LADDER)


@cache
def errors_px() -> dict[str, float]:
    return RUN.measured(rms_px)


def test_the_reference_is_imaged_back_onto_the_pixels() -> None:
    image = distort(RUN.truth, RUN.work.lens)
    assert RUN.work.focal_px * np.abs(image - RUN.work.seen).max() < 1e-12


def test_the_reference_agrees_with_opencv() -> None:
    coefficients = np.array([-0.3, 0.1, 0.0, 0.0])
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-16)
    oracle = cv2.undistortPoints(RUN.work.seen[:, None], np.eye(3), coefficients, criteria=until)
    assert RUN.work.focal_px * np.abs(oracle[:, 0, :] - RUN.truth).max() < 1e-9


@pytest.mark.parametrize(
    ("better", "worse", "at_least"),
    [
        ("fixed-point-5", "first-order", 100),
        ("fixed-point-10", "fixed-point-5", 100),
        ("newton-3", "fixed-point-10", 1000),
        ("newton-4", "newton-3", 1000),
        ("newton-4", "fixed-point-10", 1000),
    ],
)
def test_more_steps_buy_orders_of_magnitude(better: str, worse: str, at_least: float) -> None:
    assert errors_px()[worse] > at_least * errors_px()[better]


def test_a_table_twice_as_long_errs_a_quarter_as_much() -> None:
    errors = [
        rms_px(undistort_table(RUN.work.seen, RUN.work.lens, entries), RUN.truth, RUN.work)
        for entries in (257, 513, 1025)
    ]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.1)


def test_the_metric_notices_another_lens() -> None:
    other = replace(RUN.work, lens=Distortion(k1=-0.3001, k2=0.1))
    moved = LADDER.tier("newton-4").run(other)
    assert rms_px(moved, RUN.truth, RUN.work) > 1e-3


STRONG_RUN = LadderRun(inverse_strong.LADDER)
METRICS = {metric.id: metric.measure for metric in inverse_strong.LADDER.metrics}


def strong_worst_px(tier: str, metric: str) -> float:
    run = inverse_strong.LADDER.tier(tier).run
    return METRICS[metric](run(STRONG_RUN.work), STRONG_RUN.truth, STRONG_RUN.work)


def test_the_reference_of_strong_lenses_is_imaged_back_onto_the_pixels() -> None:
    for part, truth in zip(STRONG_RUN.work, STRONG_RUN.truth, strict=True):
        assert part.focal_px * np.abs(distort(truth, part.lens) - part.seen).max() < 1e-12


def test_the_barrel_is_seen_nearly_out_to_its_fold_and_not_beyond() -> None:
    barrel = STRONG_RUN.work[inverse_strong.BARREL]
    share = np.hypot(*barrel.seen.T).max() / largest_distorted_radius(barrel.lens)
    assert 0.998 < share < 0.999
    ideal = np.hypot(*STRONG_RUN.truth[inverse_strong.BARREL].T)
    assert ideal.max() < fold_radius(barrel.lens)


def test_in_the_strong_pincushion_more_fixed_point_steps_make_it_worse() -> None:
    worst = [strong_worst_px(f"fixed-point-{steps}", "pincushion") for steps in (5, 20)]
    assert worst[1] > worst[0] > 100.0


def test_near_the_fold_newton_closes_in_by_halves_and_five_steps_are_too_few() -> None:
    worst = [strong_worst_px(f"newton-{steps}", "fold") for steps in (3, 4, 5)]
    assert worst[2] > 0.001
    assert strong_worst_px("lookup-table", "fold") > 0.001


@pytest.mark.parametrize("tier", ["closed-form", "checked-table", "newton-bracketed"])
@pytest.mark.parametrize("metric", ["rms", "pincushion", "fold"])
def test_on_strong_lenses_the_careful_tiers_lose_nothing(tier: str, metric: str) -> None:
    assert strong_worst_px(tier, metric) < 1e-11


def test_both_ladders_climb_the_same_tiers_but_for_the_formula_over_as_many_points() -> None:
    strong = [tier.id for tier in inverse_strong.LADDER.tiers]
    strong.remove("closed-form")
    assert strong == [tier.id for tier in LADDER.tiers]
    assert sum(len(part.seen) for part in STRONG_RUN.work) == len(RUN.work.seen) == 76_800
    assert np.abs(RUN.work.seen).max(axis=0) == pytest.approx([319.5 / 400, 239.5 / 400])
    for part, focal_px in zip(STRONG_RUN.work, (200.0, 569.0), strict=True):
        corner = np.array([319.5, 239.5]) / focal_px
        assert np.abs(part.seen).max(axis=0) == pytest.approx(corner, rel=0.01)


def test_the_metric_over_both_lenses_is_their_root_mean_square() -> None:
    moved = tuple(
        truth + np.array([3.0 / part.focal_px, 0.0])
        for truth, part in zip(STRONG_RUN.truth, STRONG_RUN.work, strict=True)
    )
    assert METRICS["rms"](moved, STRONG_RUN.truth, STRONG_RUN.work) == pytest.approx(3.0)
    half = (moved[0], STRONG_RUN.truth[1])
    assert METRICS["rms"](half, STRONG_RUN.truth, STRONG_RUN.work) == pytest.approx(
        3.0 / np.sqrt(2.0)
    )
    assert METRICS["fold"](half, STRONG_RUN.truth, STRONG_RUN.work) == 0.0
