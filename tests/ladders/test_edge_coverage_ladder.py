"""Coverage by counting and by formula, against exact areas."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from simulations.engine.ladder import pareto_front
from simulations.ladders.edge_coverage import LADDER, disc_on, prepare, reference

WORK = prepare()
TRUTH = reference(WORK)
RESULTS = {tier.id: tier.run(WORK) for tier in LADDER.tiers}
MEASURED = {
    metric.id: {tier: metric.measure(result, TRUTH, WORK) for tier, result in RESULTS.items()}
    for metric in LADDER.metrics
}
RMS, SMALL_RMS = MEASURED["rms"], MEASURED["rms-small"]


@pytest.mark.parametrize("which", [0, 1])
def test_the_reference_adds_up_to_the_area_of_the_disc(which: int) -> None:
    assert TRUTH[which].sum() == pytest.approx(np.pi * WORK[which].radius ** 2, rel=1e-13)
    assert TRUTH[which].min() >= -1e-12
    assert TRUTH[which].max() <= 1 + 1e-12


@pytest.mark.parametrize("which", [0, 1])
def test_the_reference_agrees_with_adaptive_quadrature(which: int) -> None:
    disc, truth = WORK[which], TRUTH[which]
    rows, columns = np.nonzero((truth > 0.05) & (truth < 0.95))
    for row, column in list(zip(rows, columns, strict=True))[:: 40 if which == 0 else 5]:
        x, y = disc.x[column], disc.y[row]

        def covered(at: float, y: float = y) -> float:
            half = math.sqrt(max(disc.radius**2 - at**2, 0.0))
            return max(min(half, y + 0.5) - max(-half, y - 0.5), 0.0)

        area, _ = quad(covered, x - 0.5, x + 0.5, limit=200)
        assert truth[row, column] == pytest.approx(area, abs=1e-6)


def test_counting_errs_with_the_power_minus_three_halves_of_the_samples_along_a_side() -> None:
    errors = np.array([RMS[tier] for tier in ("box-2", "box-4", "box-8", "box-16", "edge-box-64")])
    slope = np.polyfit(np.log([2, 4, 8, 16, 64]), np.log(errors), 1)[0]
    assert slope == pytest.approx(-1.5, abs=0.15)


def test_looking_only_at_the_edge_changes_nothing() -> None:
    for edge, everywhere in zip(RESULTS["edge-box-16"], RESULTS["box-16"], strict=True):
        np.testing.assert_array_equal(edge, everywhere)


def test_counting_in_bytes_counts_right() -> None:
    """Word for word from the definition, one pixel at a time."""
    disc, factor = WORK[1], 8
    within = (np.arange(factor) + 0.5) / factor - 0.5
    for row, column in np.ndindex(16, 16):
        square = (disc.x[column] + within) ** 2 + (disc.y[row] + within[:, None]) ** 2
        share = np.mean(square < disc.radius**2)
        assert RESULTS["box-8"][1][row, column] == pytest.approx(share, abs=1e-12)


@pytest.mark.parametrize(("which", "exact"), [(0, 0.02), (1, 0.12)])
def test_a_straight_edge_errs_by_the_bulge_of_the_circle(which: int, exact: float) -> None:
    """Where the disc's edge runs along the grid, the chord has length 1 and the bulge 1/(24 R)."""
    truth, radius = TRUTH[which], WORK[which].radius
    row = int(np.abs(WORK[which].y).argmin())
    edge = int(np.abs(truth[row] - 0.5).argmin())
    bulge = (RESULTS["straight"][which] - truth)[row, edge]
    assert bulge == pytest.approx(1 / (24 * radius), rel=exact)
    assert abs((RESULTS["curved"][which] - truth)[row, edge]) < bulge / 10


def test_a_straight_edge_errs_with_the_curvature_and_a_curved_one_is_right_for_both() -> None:
    ratio = WORK[0].radius / WORK[1].radius
    assert SMALL_RMS["straight"] / RMS["straight"] == pytest.approx(ratio, rel=0.1)
    assert MEASURED["worst-small"]["straight"] > 1.5
    assert MEASURED["worst-small"]["curved"] < 0.2
    assert SMALL_RMS["box-16"] < SMALL_RMS["straight"] < SMALL_RMS["box-4"]


def test_the_formula_for_a_curved_edge_beats_4096_samples_on_the_large_disc() -> None:
    assert RMS["curved"] < RMS["edge-box-64"] / 5
    assert RMS["straight"] < RMS["box-16"] / 3


@pytest.mark.parametrize("which", [0, 1])
def test_the_metrics_notice_a_disc_larger_by_a_hundredth_of_a_pixel(which: int) -> None:
    larger = [*WORK]
    disc = WORK[which]
    larger[which] = type(disc)(disc.x, disc.y, disc.radius + 0.01)
    moved = LADDER.tier("curved").run(tuple(larger))
    noticed = {m.id: m.measure(moved, TRUTH, WORK) for m in LADDER.metrics}
    others = ("rms", "worst") if which else ("rms-small", "worst-small")
    for name, value in noticed.items():
        if name in others:
            assert value == MEASURED[name]["curved"]
        else:
            assert value > 0.3


def test_discs_smaller_than_a_pixel_or_larger_than_the_picture_are_covered_too() -> None:
    for radius in (0.3, 200.0):
        work = (disc_on(8, radius, (3.5, 3.5)), disc_on(8, radius, (3.0, 3.0)))
        for tier in LADDER.tiers:
            for covered in tier.run(work):
                assert covered.shape == (8, 8)
                assert ((covered >= 0) & (covered <= 1)).all()


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    samples = {"point": 1, "ramp": 1.1, "straight": 2, "curved": 2.5}
    samples |= {f"box-{n}": n**2 for n in (2, 4, 8, 16)}
    front = pareto_front([(work, RMS[tier]) for tier, work in samples.items()])
    assert front[list(samples).index(LADDER.default_tier)]
