"""Interpolation kernels, judged by turns that lead back to where they began."""

from itertools import pairwise

import numpy as np
import pytest
import scipy.ndimage

from simulations.engine.ladder import pareto_front
from simulations.ladders.resampling import (
    FINE,
    FREQUENCIES,
    GOLDEN_RAD,
    LADDER,
    TURN_RAD,
    TURNS,
    Turned,
    prepare,
    psnr_once,
    reference,
)

WORK = prepare()
TRUTH = reference(WORK)
KERNELS = ("nearest", "bilinear", "bicubic", "spline", "lanczos3")
MEASURED = {
    metric.id: {
        kernel: metric.measure(LADDER.tier(kernel).run(WORK), TRUTH, WORK) for kernel in KERNELS
    }
    for metric in LADDER.metrics
}


def test_one_turn_is_truer_the_more_pixels_a_kernel_reads() -> None:
    assert tuple(tier.id for tier in LADDER.tiers) == KERNELS
    once = MEASURED["psnr-once"]
    assert all(once[dearer] > once[cheaper] + 2.5 for cheaper, dearer in pairwise(KERNELS))


def test_of_the_same_sixteen_pixels_the_spline_makes_far_more_than_keys_kernel() -> None:
    """Sharper than a factor of two in the root of the squared error, and after twelve turns too."""
    for metric in ("psnr-once", "psnr-round"):
        assert MEASURED[metric]["spline"] > MEASURED[metric]["bicubic"] + 6
    assert MEASURED["contrast"]["spline"] > 1.5 * MEASURED["contrast"]["bicubic"]


def test_after_a_full_circle_fidelity_ranks_bilinear_below_nearest() -> None:
    assert MEASURED["psnr-round"]["bilinear"] < MEASURED["psnr-round"]["nearest"]


def test_only_lanczos_brings_fine_detail_round_unharmed() -> None:
    contrast = MEASURED["contrast"]
    assert contrast["lanczos3"] == pytest.approx(100, abs=10)
    assert all(contrast[kernel] < 80 for kernel in KERNELS[:-1])


def test_each_turn_takes_the_contrast_that_the_triangles_spectrum_tells() -> None:
    """A triangle passes sinc² f along each axis of the pixel grid; turns multiply."""
    left = []
    for n, f in list(enumerate(FREQUENCIES))[FINE]:
        # The wave turns against the grid by 30° each time.
        ways = n * GOLDEN_RAD + TURN_RAD * np.arange(TURNS)
        left.append(np.prod(np.square(np.sinc(f * np.cos(ways)) * np.sinc(f * np.sin(ways)))))
    assert MEASURED["contrast"]["bilinear"] == pytest.approx(100 * np.mean(left), abs=1)


@pytest.mark.parametrize(("kernel", "order"), [("nearest", 0), ("bilinear", 1), ("spline", 3)])
def test_scipy_reaches_the_same_figure(kernel: str, order: int) -> None:
    x, y = np.moveaxis(WORK.source_px, -1, 0)
    once = scipy.ndimage.map_coordinates(
        WORK.picture.astype(float), [y, x], order=order, mode="nearest"
    )
    figure = psnr_once(Turned(once, once), TRUTH, WORK)
    assert MEASURED["psnr-once"][kernel] == pytest.approx(figure, abs=1e-3)


def test_the_window_leaves_the_picture_grey_where_turning_would_lose_it() -> None:
    assert WORK.picture[0, 0] == WORK.picture[64, 0] == pytest.approx(0.5)
    assert 0 <= WORK.picture.min() < 0.25 < 0.75 < WORK.picture.max() <= 1


def test_the_metric_notices_a_turn_by_a_tenth_of_a_degree_more() -> None:
    tenth = np.deg2rad(0.1)
    turn = np.array([[np.cos(tenth), -np.sin(tenth)], [np.sin(tenth), np.cos(tenth)]])
    centre = (np.array(WORK.picture.shape) - 1) / 2
    moved = LADDER.tier("lanczos3").run(
        type(WORK)(WORK.picture, (WORK.source_px - centre) @ turn.T + centre)
    )
    assert psnr_once(moved, TRUTH, WORK) < MEASURED["psnr-once"]["lanczos3"] - 5


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    taps = (1, 4, 16, 16, 36)
    losses = [-MEASURED["psnr-once"][kernel] for kernel in KERNELS]
    front = pareto_front(list(zip(taps, losses, strict=True)))
    assert front[KERNELS.index(LADDER.default_tier)]
