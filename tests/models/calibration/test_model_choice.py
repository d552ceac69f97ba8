"""The supported lens model, its stated errors, and advice for the next photograph."""

from dataclasses import replace

import numpy as np
import pytest
from support.chequerboards import (
    BENT_SIZE,
    BOARD_WORLDS,
    SIZE,
    bent_views,
    calibrate,
    photographs,
)

from simulations.models.calibration.advice import Coverage, coverage, next_photograph
from simulations.models.calibration.bundle_adjustment import refine
from simulations.models.calibration.camera import LENSES, PINHOLE, Camera, Poses
from simulations.models.calibration.left_out import left_out_px, values_by_count
from simulations.models.calibration.model_choice import compare, compare_first, supported
from simulations.models.calibration.standard_errors import uncertainty
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry import rotations


@pytest.mark.parametrize(
    ("lens", "expected"),
    [
        (Distortion(), "none"),
        (Distortion(k1=-0.1), "k1"),
        (Distortion(k1=-0.3, k2=0.15), "k1k2"),
        (Distortion(k1=-0.3, k2=0.15, p1=2e-3, p2=-2e-3), "p1p2"),
        (Distortion(k1=-0.3, k2=0.15, p1=2e-3, p2=-2e-3, k3=0.5), "k3"),
    ],
)
def test_true_model_of_the_photographs_is_supported(lens: Distortion, expected: str) -> None:
    truth = photographs(12, seed=7, camera=Camera(500.0, 500.0, 322.0, 236.0, lens))
    views = truth.views(0.05)
    trials = compare(views, SIZE)
    assert supported(trials).lens == expected
    assert min(trials, key=lambda trial: trial.aic).rms_px == pytest.approx(
        supported(trials).rms_px, rel=0.01
    )


@pytest.mark.parametrize(
    ("world", "seed", "expected"),
    [
        pytest.param("rational lens", 20, "rational", id="coefficients make up for each other"),
        pytest.param("buckled by 2 mm", 176, "k1k2", id="a poor model turns a board over"),
    ],
)
def test_lens_is_found_although(world: str, seed: int, expected: str) -> None:
    truth, views = bent_views(BOARD_WORLDS[world], np.random.default_rng((len(world), seed)))
    found = supported(compare(views, BENT_SIZE))
    assert found.lens == expected
    assert found.fit.camera.cx == pytest.approx(truth.cx, abs=1.0)


def test_errors_count_the_distance_to_the_richest_model() -> None:
    trials = compare(photographs(6, seed=3).views(0.3), SIZE)
    chosen, richest = supported(trials), next(each for each in trials if each.lens == "k3")
    off = chosen.fit.camera.values(PINHOLE) - richest.fit.camera.values(PINHOLE)
    noise = np.sqrt(np.diagonal(chosen.uncertainty.covariance)[:4])
    errors = [chosen.uncertainty.errors[name] for name in PINHOLE]
    assert np.all(errors >= np.hypot(noise, off))


@pytest.mark.parametrize(("worse", "expected"), [(1.004, "k1"), (1.006, "k1k2")])
def test_simpler_model_is_supported_within_half_a_per_cent(worse: float, expected: str) -> None:
    trials = compare(photographs(4, seed=7).views(0.1), SIZE)[1:3]
    errors = zip(trials, (worse, 1.0), strict=True)
    alike = tuple(replace(trial, left_out_px=error) for trial, error in errors)
    assert [trial.lens for trial in alike] == ["k1", "k1k2"]
    assert supported(alike).lens == expected


@pytest.mark.parametrize("count", [3, 6, 9])
def test_draft_of_few_steps_supports_the_same_model(count: int) -> None:
    views = photographs(10, seed=2).views(0.1)
    first, every = views.take(slice(count)), compare(views, SIZE)
    whole, draft = compare_first(every, first), compare_first(every, first, draft=True)
    assert [trial.lens for trial in draft] == [trial.lens for trial in whole]
    assert supported(draft).lens == supported(whole).lens
    for one, other in zip(draft, whole, strict=True):
        assert abs(one.fit.camera.fx - other.fit.camera.fx) < other.uncertainty.errors["fx"]


def test_coverage_counts_corners_and_measures_tilt_and_distance() -> None:
    truth = photographs(5)
    views = truth.views(0.0)
    measured = coverage(views, calibrate(views), SIZE)
    assert measured.cells.sum() == views.corners
    assert measured.cells.shape == (6, 8)
    assert measured.tilt_rad == pytest.approx(np.arccos(truth.poses.R[:, 2, 2]), abs=1e-6)
    assert np.all((measured.distance > 5.0) & (measured.distance < 40.0))


def coverage_with(
    tilt_deg: float = 30.0,
    count: int = 12,
    nearest: float = 10.0,
    empty: tuple[slice, slice] | None = None,
) -> Coverage:
    cells = np.ones((6, 8))
    if empty:
        cells[empty] = 0.0
    distance = np.linspace(nearest, 20.0, count)
    return Coverage(cells, np.full(count, np.radians(tilt_deg)), distance)


def test_advice_names_the_photograph_that_is_missing_most() -> None:
    right = (slice(0, 6), slice(5, 8))
    assert next_photograph(coverage_with(tilt_deg=5.0, empty=right)) == "tilted by 30° to 45°"
    assert next_photograph(coverage_with(empty=right)).endswith("right")
    assert next_photograph(coverage_with(empty=(slice(1, 5), slice(2, 6)))) == "in the middle"
    assert next_photograph(coverage_with(count=5)) == "from another side"
    assert next_photograph(coverage_with(nearest=18.0)) == "nearer or farther"
    assert next_photograph(coverage_with()) == "nothing is missing"


TANGENTIAL = PINHOLE + LENSES["p1p2"]


@pytest.mark.parametrize("lens", ["k1k2", "p1p2", "k3"])
def test_left_out_error_and_spread_agree_with_recalibrations(lens: str) -> None:
    views, free = photographs(8, seed=4).views(0.1), PINHOLE + LENSES[lens]
    fit, found = calibrate(views, lens), []
    quick = left_out_px(views, fit, free)
    for index in range(len(views)):
        rest = [other for other in range(len(views)) if other != index]
        others = calibrate(views.take(rest), lens).camera
        alone = refine(views.take([index]), others, fit.poses.take(slice(index, index + 1)), ())
        assert quick[index] == pytest.approx(np.sqrt(alone.cost / 54), rel=0.01)
        found.append(others.values(free))
    jackknife = np.sqrt(7 * np.var(found, axis=0))
    widened = np.sqrt(2) * jackknife  # the squares of seven others, divided by half as many
    assert uncertainty(views, fit, free).spread == pytest.approx(widened, rel=0.04)


def test_values_by_count_agree_with_calibrations_of_the_first_photographs() -> None:
    views = photographs(10, seed=6).views(0.1)
    fit = calibrate(views, "p1p2")
    grown = values_by_count(views, fit, TANGENTIAL, 0.1, "fx", 4)
    assert grown.counts == tuple(range(4, 11))
    for count, value, error in zip(grown.counts, grown.value, grown.error, strict=True):
        first = views.take(slice(count))
        alone = calibrate(first, "p1p2")
        stated = uncertainty(first, alone, TANGENTIAL)
        assert value == pytest.approx(alone.camera.fx, abs=0.1 * error)
        formula = 0.1 * np.sqrt(stated.covariance[0, 0]) / stated.sigma_px
        assert error == pytest.approx(max(formula, stated.spread[0]), rel=0.05)


@pytest.mark.parametrize("corner", [(0.08, 0.08), (0.92, 0.08), (0.08, 0.92), (0.92, 0.92)])
@pytest.mark.parametrize("share", [0.1, 0.14, 0.2])
def test_small_board_in_one_photograph_is_calibrated_with_the_others(
    corner: tuple[float, float], share: float
) -> None:
    truth = photographs(8, seed=3)
    columns, rows = truth.board.corners
    pitch_px = share * SIZE[0] / (columns - 1)
    depth = truth.camera.fx / pitch_px
    place = np.multiply(corner, np.subtract(SIZE, 1)) - (truth.camera.cx, truth.camera.cy)
    centre = np.append(place * depth / truth.camera.fx, depth)
    R, t = truth.poses.R.copy(), truth.poses.t.copy()
    R[-1] = rotations.exponential((0.3, -0.2, 0.1))
    t[-1] = centre - R[-1] @ (0.5 * (columns - 1), 0.5 * (rows - 1), 0.0)
    views = replace(truth, poses=Poses(R, t)).views(0.05)
    chosen = supported(compare(views, SIZE))
    off = abs(chosen.fit.camera.fx - truth.camera.fx)
    assert off < 3.5 * chosen.uncertainty.errors["fx"]
