"""Interpolation kernels, judged by turns that do not come back by themselves."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import skimage.data
from numpy.typing import NDArray

from simulations.ladders import resampling
from simulations.ladders.resampling import LADDER, TURN_RAD, TURNS, Turned, Workload
from simulations.models.error_measures import psnr_db
from simulations.models.sampling.fine_detail import FineDetail, without_fine_detail
from simulations.pictures.round_windows import FREQUENCIES, GOLDEN_RAD, SIZE

KERNELS = ("nearest", "bilinear", "bicubic", "spline", "lanczos3")
OTHER_ANGLES_DEG = (20.0, 29.0, 33.0, 37.0, 41.0)
PHOTOGRAPHS = ("astronaut", "camera", "coffee", "chelsea", "coins", "grass")


@cache
def turned(angle_deg: float, kernel: str) -> tuple[Turned, Turned, Workload]:
    work = resampling.prepare(np.deg2rad(angle_deg))
    return LADDER.tier(kernel).run(work), resampling.reference(work), work


def once_db(angle_deg: float, kernel: str) -> list[float]:
    result, truth, _ = turned(angle_deg, kernel)
    return resampling.psnr_each(result.once, truth.once)


def often_db(angle_deg: float, kernel: str) -> list[float]:
    result, truth, _ = turned(angle_deg, kernel)
    return resampling.psnr_each(result.often, truth.often)


def detail(angle_deg: float, kernel: str) -> list[FineDetail]:
    result, truth, _ = turned(angle_deg, kernel)
    return resampling.detail_each(result, truth)


def measured(metric_id: str) -> dict[str, float]:
    metric = next(metric for metric in LADDER.metrics if metric.id == metric_id)
    return {kernel: metric.measure(*turned(33.0, kernel)) for kernel in KERNELS}


def off_px(angle_deg: float, turns: int) -> NDArray[np.float64]:
    """(N, 2) how far from its true place the nearest neighbour finds a pixel, after turns.

    By its own arithmetic: the places are rounded to the grid and followed.
    """
    angle = np.deg2rad(angle_deg)
    _, _, work = turned(angle_deg, "nearest")
    step = np.clip(np.floor(work.source_px + 0.5), 0, SIZE - 1).astype(int)
    start = place = np.stack(np.meshgrid(np.arange(SIZE), np.arange(SIZE)), axis=-1)
    for _ in range(turns):
        place = step[place[..., 1], place[..., 0]]
    cos, sin = np.cos(turns * angle), np.sin(turns * angle)
    from_middle = start - (SIZE - 1) / 2
    true = from_middle @ np.array([[cos, sin], [-sin, cos]]) + (SIZE - 1) / 2
    near = np.hypot(from_middle[..., 0], from_middle[..., 1]) < 40
    off: NDArray[np.float64] = (place - true)[near]
    return off


def rms_px(off: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(np.sum(off * off, axis=-1))))


@pytest.mark.parametrize("angle_deg", OTHER_ANGLES_DEG)
def test_displacements_of_the_nearest_pixel_add_up_like_random_steps(angle_deg: float) -> None:
    once = rms_px(off_px(angle_deg, 1))
    assert once == pytest.approx(np.sqrt(1 / 6), rel=0.03), "even within a pixel"
    assert rms_px(off_px(angle_deg, TURNS)) == pytest.approx(np.sqrt(TURNS) * once, rel=0.1)


def test_turns_of_thirty_degrees_put_most_pixels_back_where_they_were() -> None:
    """Three of them take the grid onto itself; so the ladder does not use this angle."""
    after = off_px(30.0, TURNS)
    assert rms_px(after) < 0.5 * np.sqrt(TURNS) * rms_px(off_px(30.0, 1))
    assert np.mean(np.hypot(*after.T) < 1e-6) == pytest.approx(2 / 3, abs=0.03)
    np.testing.assert_allclose(off_px(30.0, 2 * TURNS), after, atol=1e-9)
    assert np.rad2deg(TURN_RAD) in OTHER_ANGLES_DEG


@pytest.mark.parametrize("angle_deg", OTHER_ANGLES_DEG)
def test_bilinear_is_nearer_the_truth_than_the_nearest_pixel_after_twelve_turns(
    angle_deg: float,
) -> None:
    pairs = zip(often_db(angle_deg, "nearest"), often_db(angle_deg, "bilinear"), strict=True)
    assert all(bilinear > nearest + 1 for nearest, bilinear in pairs)


@pytest.mark.parametrize("angle_deg", OTHER_ANGLES_DEG)
def test_bilinear_loses_fine_detail_and_the_nearest_pixel_misplaces_it(angle_deg: float) -> None:
    for nearest, bilinear in zip(
        detail(angle_deg, "nearest"), detail(angle_deg, "bilinear"), strict=True
    ):
        assert bilinear.present < 0.25
        assert nearest.present > 0.8
        assert nearest.in_place < 0.6 * nearest.present
        assert bilinear.in_place > 0.6 * bilinear.present


@pytest.mark.parametrize("angle_deg", OTHER_ANGLES_DEG)
def test_up_to_the_spline_a_dearer_kernel_is_truer_on_every_picture(angle_deg: float) -> None:
    assert tuple(tier.id for tier in LADDER.tiers) == KERNELS
    for db, margin in ((once_db, 2.5), (often_db, 1.0)):
        each = [db(angle_deg, kernel) for kernel in KERNELS[:4]]
        for cheaper, dearer in pairwise(each):
            assert np.all(np.subtract(dearer, cheaper) > margin)


def test_of_the_same_sixteen_pixels_the_spline_makes_far_more_than_keys_kernel() -> None:
    """Sharper than a factor of two in the root of the squared error, on every picture."""
    for db in (once_db, often_db):
        assert np.all(np.subtract(db(33.0, "spline"), db(33.0, "bicubic")) > 6)


def test_lanczos_is_ahead_of_the_spline_on_waves_alone_and_lifts_fine_detail() -> None:
    for db in (once_db, often_db):
        ahead = np.subtract(db(33.0, "lanczos3"), db(33.0, "spline"))
        assert np.all((ahead > 0.8) == [True, False, False])
        assert np.all(ahead[1:] < -0.8)
    assert all(1 < each.present < 1.2 for each in detail(33.0, "lanczos3"))
    assert all(0.7 < each.present < 1 for each in detail(33.0, "spline"))


def test_each_turn_takes_the_contrast_that_the_triangles_spectrum_says() -> None:
    """A triangle passes sinc² f along each axis of the pixel grid; turns multiply."""
    left = []
    for n, f in enumerate(FREQUENCIES):
        if f > 0.2:
            # The wave turns against the grid by 33° each time.
            ways = n * GOLDEN_RAD + TURN_RAD * np.arange(TURNS)
            left.append(np.prod(np.square(np.sinc(f * np.cos(ways)) * np.sinc(f * np.sin(ways)))))
    assert detail(33.0, "bilinear")[0].in_place == pytest.approx(np.mean(left), abs=0.01)


def test_the_windows_leave_grey_where_turning_would_lose_a_picture() -> None:
    _, _, work = turned(33.0, "nearest")
    assert np.all(work.pictures[[0, 64], [0, 0]] == pytest.approx(0.5))
    assert np.all(work.pictures.min((0, 1)) >= 0)
    assert np.all(work.pictures.max((0, 1)) <= 1)
    assert np.all(np.ptp(work.pictures, axis=(0, 1)) > 0.7)


def test_the_metric_notices_a_turn_by_a_tenth_of_a_degree_more() -> None:
    more = LADDER.tier("lanczos3").run(resampling.prepare(TURN_RAD + np.deg2rad(0.1)))
    _, truth, _ = turned(33.0, "lanczos3")
    exact = once_db(33.0, "lanczos3")
    assert np.all(np.array(resampling.psnr_each(more.once, truth.once)) < np.array(exact) - 5)


def test_the_default_is_as_true_as_what_reads_more_than_twice_as_much() -> None:
    once = measured("psnr-once")
    best = max(once.values())
    assert LADDER.default_tier == "spline"
    assert once["spline"] > best - 0.2
    assert all(once[cheaper] < best - 5 for cheaper in KERNELS[:3])


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_on_photographs_two_pixels_of_shift_cost_more_than_all_fine_detail(name: str) -> None:
    photograph = np.asarray(getattr(skimage.data, name)(), float) / 255
    grey = photograph.mean(-1) if photograph.ndim == 3 else photograph
    grey = grey[:300, :300]
    dulled = without_fine_detail(grey)
    for axis in (0, 1):
        assert psnr_db(np.roll(grey, 2, axis), grey, crop=16) < psnr_db(dulled, grey, crop=16) - 3
