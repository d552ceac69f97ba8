"""Coverage by counting and by formula, against exact areas."""

import math
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from support.ladder_run import LadderRun

from simulations.ladders.edge_coverage import LADDER, disc_on

RUN = LadderRun(LADDER)


@cache
def measured(metric_id: str) -> dict[str, float]:
    (metric,) = (each for each in LADDER.metrics if each.id == metric_id)
    return RUN.measured(metric.measure)


@pytest.mark.parametrize("which", [0, 1])
def test_the_reference_adds_up_to_the_area_of_the_disc(which: int) -> None:
    assert RUN.truth[which].sum() == pytest.approx(np.pi * RUN.work[which].radius ** 2, rel=1e-13)
    assert RUN.truth[which].min() >= -1e-12
    assert RUN.truth[which].max() <= 1 + 1e-12


@pytest.mark.parametrize("which", [0, 1])
def test_the_reference_agrees_with_adaptive_quadrature(which: int) -> None:
    disc, truth = RUN.work[which], RUN.truth[which]
    rows, columns = np.nonzero((truth > 0.05) & (truth < 0.95))
    for row, column in list(zip(rows, columns, strict=True))[:: 40 if which == 0 else 5]:
        x, y = disc.x[column], disc.y[row]

        def covered(at: float, y: float = y) -> float:
            half = math.sqrt(max(disc.radius**2 - at**2, 0.0))
            return max(min(half, y + 0.5) - max(-half, y - 0.5), 0.0)

        area, _ = quad(covered, x - 0.5, x + 0.5, limit=200)
        assert truth[row, column] == pytest.approx(area, abs=1e-6)


def test_counting_errs_with_the_power_minus_three_halves_of_the_samples_along_a_side() -> None:
    errors = np.array(
        [measured("rms")[tier] for tier in ("box-2", "box-4", "box-8", "box-16", "edge-box-64")]
    )
    slope = np.polyfit(np.log([2, 4, 8, 16, 64]), np.log(errors), 1)[0]
    assert slope == pytest.approx(-1.5, abs=0.15)


def test_looking_only_at_the_edge_changes_nothing() -> None:
    for edge, everywhere in zip(RUN.results["edge-box-16"], RUN.results["box-16"], strict=True):
        np.testing.assert_array_equal(edge, everywhere)


def test_counting_in_bytes_counts_right() -> None:
    """Word for word from the definition, one pixel at a time."""
    disc, factor = RUN.work[1], 8
    within = (np.arange(factor) + 0.5) / factor - 0.5
    for row, column in np.ndindex(16, 16):
        square = (disc.x[column] + within) ** 2 + (disc.y[row] + within[:, None]) ** 2
        share = np.mean(square < disc.radius**2)
        assert RUN.results["box-8"][1][row, column] == pytest.approx(share, abs=1e-12)


@pytest.mark.parametrize(("which", "exact"), [(0, 0.02), (1, 0.12)])
def test_a_straight_edge_errs_by_the_bulge_of_the_circle(which: int, exact: float) -> None:
    """Where the disc's edge runs along the grid, the chord has length 1 and the bulge 1/(24 R)."""
    truth, radius = RUN.truth[which], RUN.work[which].radius
    row = int(np.abs(RUN.work[which].y).argmin())
    edge = int(np.abs(truth[row] - 0.5).argmin())
    bulge = (RUN.results["straight"][which] - truth)[row, edge]
    assert bulge == pytest.approx(1 / (24 * radius), rel=exact)
    assert abs((RUN.results["curved"][which] - truth)[row, edge]) < bulge / 10


def test_a_straight_edge_errs_with_the_curvature_and_a_curved_one_is_right_for_both() -> None:
    ratio = RUN.work[0].radius / RUN.work[1].radius
    assert measured("rms-small")["straight"] / measured("rms")["straight"] == pytest.approx(
        ratio, rel=0.1
    )
    assert measured("worst-small")["straight"] > 1.5
    assert measured("worst-small")["curved"] < 0.2
    assert (
        measured("rms-small")["box-16"]
        < measured("rms-small")["straight"]
        < measured("rms-small")["box-4"]
    )


def test_the_formula_for_a_curved_edge_beats_4096_samples_on_the_large_disc() -> None:
    assert measured("rms")["curved"] < measured("rms")["edge-box-64"] / 5
    assert measured("rms")["straight"] < measured("rms")["box-16"] / 3


@pytest.mark.parametrize("which", [0, 1])
def test_the_metrics_notice_a_disc_larger_by_a_hundredth_of_a_pixel(which: int) -> None:
    larger = [*RUN.work]
    disc = RUN.work[which]
    larger[which] = type(disc)(disc.x, disc.y, disc.radius + 0.01)
    moved = LADDER.tier("curved").run(tuple(larger))
    noticed = {m.id: m.measure(moved, RUN.truth, RUN.work) for m in LADDER.metrics}
    others = ("rms", "worst") if which else ("rms-small", "worst-small")
    for name, value in noticed.items():
        if name in others:
            assert value == measured(name)["curved"]
        else:
            assert value > 0.3


def test_discs_smaller_than_a_pixel_or_larger_than_the_picture_are_covered_too() -> None:
    for radius in (0.3, 200.0):
        work = (disc_on(8, radius, (3.5, 3.5)), disc_on(8, radius, (3.0, 3.0)))
        for tier in LADDER.tiers:
            for covered in tier.run(work):
                assert covered.shape == (8, 8)
                assert ((covered >= 0) & (covered <= 1)).all()
