"""Laws of single tiers' errors: powers of the work, closed forms, and other libraries."""

from dataclasses import replace
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats
from support.ladders import run_of

from simulations.models.geometry.homography_estimation import estimate_homography
from simulations.models.geometry.quaternion_blends import STRAIGHT
from simulations.pictures.round_windows import FREQUENCIES, GOLDEN_RAD

type Floats = NDArray[np.floating[Any]]

POWERS = [
    ("edge-coverage", "rms", ("box-2", "box-4", "box-8", "box-16"), (2, 4, 8, 16), -1.5),
    ("exposure-blur", "rms", ("instants-4", "instants-16", "instants-64"), (4, 16, 64), -1.0),
    ("shading", "rms", ("gouraud-8", "gouraud-16", "gouraud-32"), (8, 16, 32), -2.0),
]
"""Ladder, metric, tiers, their work, and the power with which the error falls."""


@pytest.mark.parametrize(("ladder_id", "metric", "tiers", "work", "power"), POWERS)
def test_error_falls_with_its_power_of_the_work(
    ladder_id: str, metric: str, tiers: tuple[str, ...], work: tuple[int, ...], power: float
) -> None:
    errors = [run_of(ladder_id).error(metric, tier) for tier in tiers]
    assert np.polyfit(np.log(work), np.log(errors), 1)[0] == pytest.approx(power, abs=0.15)


def test_fixed_point_coefficients_have_no_bias() -> None:
    """Shifts without rounding would lower every coefficient by a sixteenth."""
    run = run_of("block-dct")
    assert abs(np.mean(run.result("fixed-point") - run.truth)) < 0.005


def test_opencvs_corner_refinement_errs_at_most_four_times_the_gradient_tier() -> None:
    run = run_of("corner-refinement")
    part = run.work[0]
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 30, 1e-4)
    begin = np.ascontiguousarray(part.begin[:, None], np.float32)
    theirs = cv2.cornerSubPix(part.codes, begin, (7, 7), (-1, -1), until)[:, 0]
    error = np.sqrt(((theirs - part.truth) ** 2).sum(axis=-1).mean())
    assert 0.5 < error / run.error("noisy", "gradients") < 4.0


def test_bilinear_damps_a_wave_by_the_mean_of_its_neighbours() -> None:
    """Midway between two samples of a wave the mean is the wave times cos(its phase step)."""
    run, soft, place = run_of("demosaicing"), 2, (96, 121, 0)  # left of a pixel that lacks red
    step = 2 * np.pi * np.cos(0.2) / 12.0
    expected = (run.truth[soft][place] - 0.5) * np.cos(step)
    assert run.result("bilinear")[soft][place] - 0.5 == pytest.approx(expected, abs=1e-6)


def test_box_counts_agree_on_the_edge_and_with_their_definition() -> None:
    run = run_of("edge-coverage")
    for edge, everywhere in zip(run.result("edge-box-16"), run.result("box-16"), strict=True):
        np.testing.assert_array_equal(edge, everywhere)
    disc, within = run.work[1], (np.arange(8) + 0.5) / 8 - 0.5
    for row, column in np.ndindex(16, 16):
        square = (disc.x[column] + within) ** 2 + (disc.y[row] + within[:, None]) ** 2
        share = np.mean(square < disc.radius**2)
        assert run.result("box-8")[1][row, column] == pytest.approx(share, abs=1e-12)


@pytest.mark.parametrize(("which", "exact"), [(0, 0.02), (1, 0.12)])
def test_straight_edge_errs_by_the_bulge_of_the_circle(which: int, exact: float) -> None:
    """Where the disc's edge runs along the grid, the chord has length 1 and the bulge 1/(24 R)."""
    run = run_of("edge-coverage")
    truth, disc = run.truth[which], run.work[which]
    row = int(np.abs(disc.y).argmin())
    edge = int(np.abs(truth[row] - 0.5).argmin())
    bulge = (run.result("straight")[which] - truth)[row, edge]
    assert bulge == pytest.approx(1 / (24 * disc.radius), rel=exact)
    assert abs((run.result("curved")[which] - truth)[row, edge]) < bulge / 10


def mapped(H: Floats, points: Floats) -> Floats:
    return np.asarray(cv2.perspectiveTransform(points[None], H)[0])


@pytest.mark.parametrize("index", [0, 1])
def test_two_sided_least_squares_reaches_the_cramer_rao_bound(index: int) -> None:
    """Cramér–Rao: the RMS error that no unbiased estimate can beat, from numeric derivatives.

    The residual of a pair of points has the covariance σ² (I + J Jᵀ).
    """
    run = run_of("homography-estimation")
    view, matches = run.module.VIEWS[index], run.work[index]
    h = np.append(view.homography, 1.0)

    def by_entries(points: Floats) -> Floats:
        """(2N, 8) change of the mapped points per relative change of each entry."""
        up, down = ((1.0 + sign * 1e-6 * np.eye(9)[:8]) * h for sign in (1.0, -1.0))
        each = [
            mapped(a.reshape(3, 3), points) - mapped(b.reshape(3, 3), points)
            for a, b in zip(up, down, strict=True)
        ]
        return np.stack([change.ravel() / 2e-6 for change in each], axis=-1)

    judged, squares = by_entries(matches.check), []
    for exact in matches.exact:
        H, seen = h.reshape(3, 3), by_entries(exact).reshape(-1, 2, 8)
        steps = [(mapped(H, exact + s) - mapped(H, exact - s)) / 2 for s in np.eye(2)]
        J = np.stack(steps, axis=-1)
        weight = np.linalg.inv(np.eye(2) + J @ J.transpose(0, 2, 1)) / view.noise_px**2
        information = np.einsum("nia,nij,njb->ab", seen, weight, seen)
        size = np.sqrt(np.diag(information))
        covariance = np.linalg.inv(information / np.outer(size, size))
        spread = np.einsum("ij,jk,ik->i", judged / size, covariance, judged / size)
        squares.append(spread.sum() / len(matches.check))
    bound = float(np.sqrt(np.mean(squares)))
    assert run.error(view.name, "two-sided") == pytest.approx(bound, rel=0.2)


@pytest.mark.parametrize(("index", "name"), [(0, "poster"), (1, "wall")])
def test_one_sided_least_squares_agrees_with_opencvs_estimate(index: int, name: str) -> None:
    """They differ by far less than the error; two steps of Gauss–Newton do not quite converge."""
    run = run_of("homography-estimation")
    matches, ours = run.work[index], run.result("one-sided")[index][0]
    H, _ = cv2.findHomography(matches.source[0], matches.target[0], 0)
    apart = mapped(ours, matches.check) - mapped(H, matches.check)
    assert np.sqrt((apart**2).sum(axis=-1).mean()) < 0.1 * run.error(name, "one-sided")


@pytest.mark.parametrize("tier", ["squared", "normalised"])
def test_unchecked_normalised_transform_agrees_with_the_model(tier: str) -> None:
    run = run_of("homography-estimation")
    for matches, ours in zip(run.work, run.result(tier), strict=True):
        for source, target, H in zip(matches.source, matches.target, ours, strict=True):
            theirs, valid = estimate_homography(source, target)
            assert valid
            points = [mapped(each, matches.check) for each in (H, theirs)]
            np.testing.assert_allclose(points[0], points[1], atol=1e-6)


def test_bins_err_more_at_angles_where_rows_repeat() -> None:
    module, ladder = run_of("mtf-binning").module, run_of("mtf-binning").ladder
    found = []
    for angles in ((4.0, 7.0, 11.0, 22.0), (14.04, 18.43, 26.57, 33.69)):
        work = module.prepare(angles)
        truth = module.reference(work)
        error = {t.id: module.clean_error(t.run(work), truth, work) for t in ladder.tiers}
        assert error["spline"] < 0.02 < 10 * error["spline"] < min(error["bins-4"], error["bins-8"])
        found.append(error)
    good, repeating = found
    assert repeating["bins-4"] > 2 * good["bins-4"]
    assert good["bins-4"] < good["bins-4-raw"]


def test_relative_coordinates_remove_the_error_of_distance() -> None:
    run = run_of("precision")
    work = run.work
    for tier in ("relative-32", "relative-64"):
        np.testing.assert_array_equal(*run.result(tier))
    farther = 16.0 * work.far.centre
    moved = replace(work.far, centre=farther, points=farther + work.steps * run.module.UNIT_M)
    other = replace(work, far=moved)
    result = run.ladder.tier("float64").run(other)
    growth = run.metrics["far"](result, run.truth, other) / run.error("far", "float64")
    assert 8.0 < growth < 32.0


def test_each_rotation_reduces_contrast_by_the_triangles_spectrum() -> None:
    """A triangle passes sinc² f along each axis of the pixel grid; the factors multiply."""
    run, left = run_of("resampling"), []
    for n, f in enumerate(FREQUENCIES):
        if f > 0.2:
            # The wave turns against the grid by 33° each time.
            ways = n * GOLDEN_RAD + np.deg2rad(33.0) * np.arange(12)
            left.append(np.prod(np.square(np.sinc(f * np.cos(ways)) * np.sinc(f * np.sin(ways)))))
    waves = run.module.detail_each(run.result("bilinear"), run.truth)[0]
    assert waves.in_place == pytest.approx(np.mean(left), abs=0.01)


def test_nlerp_errs_by_the_chord_of_the_arc() -> None:
    """A point on the chord of the arc Ω is seen at atan2 from its centre."""
    run = run_of("rotation-interpolation")
    arc, share = np.radians(run.work.angle_deg)[:, None] / 2.0, run.work.share
    seen = np.arctan2(share * np.sin(arc), 1.0 - share + share * np.cos(arc))
    theory = np.degrees(2.0 * np.abs(seen - share * arc))
    found = run.module.errors_deg(run.result("nlerp"), run.truth)
    np.testing.assert_allclose(found, theory, atol=1e-12)
    below = theory[np.cos(arc[:, 0]) > STRAIGHT].max()
    assert run.error("worst", "slerp-threshold") == pytest.approx(below, rel=1e-6)


def test_gouraud_blends_are_exact_at_the_corners_of_the_cells() -> None:
    run = run_of("shading")
    every = slice(None, None, run.module.INTERVALS // 8)
    corners = run.module.phong_pixels(run.work[every, every])
    np.testing.assert_array_equal(run.result("gouraud-8")[every, every], corners)
    grid = run.module.INTERVALS
    np.testing.assert_array_equal(run.module.gouraud(run.work, grid=grid), run.result("phong"))


def sampling_error(run: Any) -> float:
    """The distance that 99 of 100 samples of the right distribution stay below (Kolmogorov)."""
    return float(1.63 / np.sqrt(run.module.SAMPLES))


def test_rounded_gaussian_errs_by_its_distance_from_poisson() -> None:
    run = run_of("shot-noise")
    k = np.arange(run.truth.shape[1])
    measured = run.module.distances(run.result("gaussian"), run.truth)
    for row, mean in enumerate(run.module.LEVELS_E):
        below = stats.norm.cdf(k + 0.5, loc=mean, scale=np.sqrt(mean))
        theory = np.abs(below - run.truth[row]).max()
        assert measured[row] == pytest.approx(theory, abs=sampling_error(run))
    for tier in ("quantile", "poisson"):
        assert (run.module.distances(run.result(tier), run.truth) < sampling_error(run)).all()


def test_clipped_gaussians_add_the_light_that_theory_predicts() -> None:
    run = run_of("shot-noise")
    above = 1.0 - stats.norm.cdf(np.arange(40) + 0.5, loc=1.0, scale=1.0)
    measured = run.result("gaussian")[run.module.LEVELS_E.index(1.0)].mean(dtype=float)
    assert measured == pytest.approx(above.sum(), abs=0.012)
    z = np.linspace(-9, 9, 200_001)
    clipped = np.clip(np.rint(0.1 + np.sqrt(0.1) * z + (z * z - 1) / 6), 0, None)
    theory = 100 * (np.trapezoid(clipped * stats.norm.pdf(z), z) / 0.1 - 1)
    chance = 100 * 4 * np.sqrt(0.15 / run.module.SAMPLES) / 0.1
    assert run.error("bias", "skewed") == pytest.approx(theory, abs=chance)


def test_metrics_detect_two_percent_more_light() -> None:
    run = run_of("shot-noise")
    brighter = replace(run.work, mean_e=run.work.mean_e * np.float32(1.02))
    result = run.ladder.tier("poisson").run(brighter)
    assert run.metrics["ks"](result, run.truth, run.work) > 2 * sampling_error(run)
    assert run.metrics["bias"](result, run.truth, run.work) > 1.5
