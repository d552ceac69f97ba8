"""Whether standard errors are true to coverage, and how they follow the count of photographs."""

import numpy as np
import pytest
from support.sittings import SIZE, TRUTH, photographs

from simulations.models.calibration.bundle_adjustment import calibrate, refine
from simulations.models.calibration.camera import LENSES, PINHOLE
from simulations.models.calibration.left_out import growth, left_out_px
from simulations.models.calibration.standard_errors import uncertainty

FREE = PINHOLE + LENSES["p1p2"]


def errors_in_units(runs: int, count: int, sigma_px: float) -> np.ndarray:
    """(runs, m) true errors of calibrations, in standard errors stated by each."""
    truth = photographs(count, seed=5)
    rows = []
    for run in range(runs):
        views = truth.views(sigma_px, seed=run)
        fit = calibrate(views, SIZE, "p1p2")
        stated = np.array(list(uncertainty(views, fit, FREE).errors.values()))
        rows.append((fit.camera.values(FREE) - TRUTH.values(FREE)) / stated)
    return np.array(rows)


def check_coverage(runs: int, tolerance: float) -> None:
    off = errors_in_units(runs, 6, 0.2)
    assert np.mean(np.abs(off) < 1.0) == pytest.approx(0.683, abs=tolerance)
    assert np.mean(np.abs(off) < 2.0) == pytest.approx(0.954, abs=tolerance)
    assert np.abs(off.mean(axis=0)).max() < 4.0 / np.sqrt(runs)


def test_the_truth_lies_within_the_stated_errors_at_the_stated_rate() -> None:
    check_coverage(60, 0.08)


@pytest.mark.deep
def test_the_truth_lies_within_the_stated_errors_at_the_stated_rate_over_many_runs() -> None:
    check_coverage(1000, 0.02)


def test_noise_of_the_corners_is_estimated_from_the_residuals() -> None:
    views = photographs(12).views(0.2)
    sigma = uncertainty(views, calibrate(views, SIZE, "p1p2"), FREE).sigma_px
    assert sigma == pytest.approx(0.2, rel=0.06)


@pytest.mark.parametrize("lens", ["k1k2", "p1p2", "k3"])
def test_error_on_a_photograph_left_out_is_that_of_a_calibration_without_it(lens: str) -> None:
    views, free = photographs(8, seed=4).views(0.1), PINHOLE + LENSES[lens]
    fit = calibrate(views, SIZE, lens)
    quick = left_out_px(views, fit, free)
    for index in range(len(views)):
        rest = [other for other in range(len(views)) if other != index]
        others = calibrate(views.take(rest), SIZE, lens).camera
        alone = refine(views.take([index]), others, fit.poses.take(slice(index, index + 1)), ())
        assert quick[index] == pytest.approx(np.sqrt(alone.cost / 54), rel=0.01)


def test_growth_is_that_of_calibrations_of_the_first_photographs() -> None:
    views = photographs(10, seed=6).views(0.1)
    fit = calibrate(views, SIZE, "p1p2")
    grown = growth(views, fit, FREE, 0.1, "fx", 4)
    assert grown.counts == tuple(range(4, 11))
    for count, value, error in zip(grown.counts, grown.value, grown.error, strict=True):
        first = views.take(slice(count))
        alone = calibrate(first, SIZE, "p1p2")
        stated = uncertainty(first, alone, FREE)
        assert value == pytest.approx(alone.camera.fx, abs=0.1 * error)
        assert error == pytest.approx(0.1 * stated.errors["fx"] / stated.sigma_px, rel=0.03)
