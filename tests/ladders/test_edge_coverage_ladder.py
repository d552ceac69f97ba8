"""Coverage by counting and by formula, against exact areas."""

import numpy as np
import pytest
from scipy.integrate import quad

from simulations.engine.ladder import pareto_front
from simulations.ladders.edge_coverage import LADDER, RADIUS_PX, prepare, reference

WORK = prepare()
TRUTH = reference(WORK)
RESULTS = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
MEASURED = {
    metric.id: {tier: metric.measure(result, TRUTH, WORK) for tier, result in RESULTS.items()}
    for metric in LADDER.metrics
}
RMS = MEASURED["rms"]


def test_the_reference_adds_up_to_the_area_of_the_disc() -> None:
    assert TRUTH.sum() == pytest.approx(np.pi * RADIUS_PX**2, rel=1e-13)
    assert TRUTH.min() >= -1e-12
    assert TRUTH.max() <= 1 + 1e-12


def test_the_reference_agrees_with_adaptive_quadrature() -> None:
    rows, columns = np.nonzero((TRUTH > 0.05) & (TRUTH < 0.95))
    for row, column in list(zip(rows, columns, strict=True))[::40]:
        x, y = WORK.x[column], WORK.y[row]

        def covered(at: float, y: float = y) -> float:
            half = np.sqrt(max(RADIUS_PX**2 - at**2, 0.0))
            return max(min(half, y + 0.5) - max(-half, y - 0.5), 0.0)

        area, _ = quad(covered, x - 0.5, x + 0.5, limit=200)
        assert TRUTH[row, column] == pytest.approx(area, abs=1e-7)


def test_counting_errs_with_the_power_minus_three_halves_of_the_samples_along_a_side() -> None:
    errors = np.array([RMS[tier] for tier in ("box-2", "box-4", "box-8", "box-16", "edge-box-64")])
    slope = np.polyfit(np.log([2, 4, 8, 16, 64]), np.log(errors), 1)[0]
    assert slope == pytest.approx(-1.5, abs=0.15)


def test_looking_only_at_the_edge_changes_nothing() -> None:
    np.testing.assert_allclose(RESULTS["edge-box-16"], RESULTS["box-16"], atol=1e-15)


def test_a_straight_edge_errs_by_the_bulge_of_the_circle() -> None:
    """Where the disc's edge runs along the grid, the chord has length 1 and the bulge 1/(24 R)."""
    row = int(np.abs(WORK.y).argmin())
    edge = int(np.abs(TRUTH[row] - 0.5).argmin())
    bulge = (RESULTS["straight"] - TRUTH)[row, edge]
    assert bulge == pytest.approx(1 / (24 * RADIUS_PX), rel=0.02)
    assert abs((RESULTS["curved"] - TRUTH)[row, edge]) < bulge / 50


def test_the_formula_for_a_curved_edge_beats_4096_samples() -> None:
    assert RMS["curved"] < RMS["edge-box-64"] / 5
    assert RMS["straight"] < RMS["box-16"] / 3


def test_the_metrics_notice_a_disc_larger_by_a_hundredth_of_a_pixel() -> None:
    shifted = type(WORK)(WORK.x * RADIUS_PX / (RADIUS_PX + 0.01), WORK.y)
    moved = LADDER.tier("curved").run(shifted)
    for metric in LADDER.metrics:
        assert metric.measure(moved, TRUTH, WORK) > 0.3


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    samples = {"point": 1, "ramp": 1.1, "straight": 2, "curved": 3}
    samples |= {f"box-{n}": n**2 for n in (2, 4, 8, 16)}
    front = pareto_front([(work, RMS[tier]) for tier, work in samples.items()])
    assert front[list(samples).index(LADDER.default_tier)]
