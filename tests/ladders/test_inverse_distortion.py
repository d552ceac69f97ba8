"""The ways to undo a lens stand in the order that theory gives them."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from simulations.engine.ladder import pareto_front
from simulations.ladders import inverse_pincushion
from simulations.ladders.inverse_distortion import LADDER, prepare, reference, rms_px, worst_px
from simulations.models.distortion import Distortion, distort
from simulations.models.undistortion import undistort_table

WORK = prepare()
TRUTH = reference(WORK)
RMS_PX = {tier.id: rms_px(tier.run(WORK), TRUTH, WORK) for tier in LADDER.tiers}


def test_the_reference_is_imaged_back_onto_the_pixels() -> None:
    image = distort(TRUTH, WORK.lens)
    assert WORK.focal_px * np.abs(image - WORK.seen).max() < 1e-12


def test_the_reference_agrees_with_opencv() -> None:
    coefficients = np.array([-0.3, 0.1, 0.0, 0.0])
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-16)
    oracle = cv2.undistortPoints(WORK.seen[:, None], np.eye(3), coefficients, criteria=until)
    assert WORK.focal_px * np.abs(oracle[:, 0, :] - TRUTH).max() < 1e-9


@pytest.mark.parametrize(
    ("better", "worse", "at_least"),
    [
        ("fixed-point-5", "first-order", 100),
        ("fixed-point-10", "fixed-point-5", 100),
        ("newton-4", "newton-3", 1000),
        ("newton-4", "fixed-point-10", 1000),
    ],
)
def test_more_steps_buy_orders_of_magnitude(better: str, worse: str, at_least: float) -> None:
    assert RMS_PX[worse] > at_least * RMS_PX[better]


def test_a_table_twice_as_long_errs_a_quarter_as_much() -> None:
    errors = [
        rms_px(undistort_table(WORK.seen, WORK.lens, entries), TRUTH, WORK)
        for entries in (257, 513, 1025)
    ]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.1)


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    polynomials = {"first-order": 1, "lookup-table": 1, "newton-3": 6, "newton-4": 8}
    polynomials |= {f"fixed-point-{steps}": steps for steps in (5, 10, 20)}
    polynomials |= {"checked-table": 4}  # two roots as dear as one each, a quartic as two
    polynomials |= {"newton-bracketed": 10}  # 7, and choices in three steps as dear as one each
    points = [(polynomials[tier.id], RMS_PX[tier.id]) for tier in LADDER.tiers]
    front = dict(zip(RMS_PX, pareto_front(points), strict=True))
    assert front[LADDER.default_tier]


def test_the_metric_notices_another_lens() -> None:
    other = replace(WORK, lens=Distortion(k1=-0.3001, k2=0.1))
    moved = LADDER.tier("newton-4").run(other)
    assert rms_px(moved, TRUTH, WORK) > 1e-3


STRONG = inverse_pincushion.prepare()
STRONG_TRUTH = reference(STRONG)


def strong_worst_px(tier: str) -> float:
    run = inverse_pincushion.LADDER.tier(tier).run
    return worst_px(run(STRONG), STRONG_TRUTH, STRONG)


def test_the_reference_of_the_pincushion_is_imaged_back_onto_the_pixels() -> None:
    assert STRONG.focal_px * np.abs(distort(STRONG_TRUTH, STRONG.lens) - STRONG.seen).max() < 1e-12


def test_in_the_strong_pincushion_more_fixed_point_steps_make_it_worse() -> None:
    assert strong_worst_px("fixed-point-20") > strong_worst_px("fixed-point-5") > 100.0


@pytest.mark.parametrize("tier", ["checked-table", "newton-bracketed"])
def test_in_the_strong_pincushion_the_careful_tiers_lose_nothing(tier: str) -> None:
    assert strong_worst_px(tier) < 1e-11


def test_both_ladders_climb_the_same_tiers_over_as_many_points() -> None:
    assert inverse_pincushion.LADDER.tiers == LADDER.tiers
    assert STRONG.seen.shape == WORK.seen.shape == (76_800, 2)
    assert np.abs(WORK.seen).max(axis=0) == pytest.approx([319.5 / 400, 239.5 / 400])
    assert np.abs(STRONG.seen).max(axis=0) == pytest.approx([319.5 / 200, 239.5 / 200])
