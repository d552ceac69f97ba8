"""PSNR and root mean square against their definitions."""

from typing import Any

import numpy as np
import pytest

from simulations.models.error_measures import psnr_db, root_mean_square


def test_psnr_of_an_error_of_one_code_is_48_decibel() -> None:
    picture = np.zeros((32, 32, 3))
    assert psnr_db(picture + 1 / 255, picture) == pytest.approx(48.1308, abs=1e-4)
    assert psnr_db(picture, picture) == np.inf


def test_psnr_leaves_out_just_the_border() -> None:
    clean = np.zeros((20, 30))
    for crop, inner in ((8, (slice(8, 12), slice(8, 22))), (3, (slice(3, 17), slice(3, 27)))):
        spoilt = np.ones((20, 30))
        spoilt[inner] = 0
        assert psnr_db(spoilt, clean, crop=crop) == np.inf
        for corner in ((inner[0].start, inner[1].start), (inner[0].stop - 1, inner[1].stop - 1)):
            one = clean.copy()
            one[corner] = 1
            count = clean[inner].size
            assert psnr_db(one, clean, crop=crop) == pytest.approx(10 * np.log10(count))


def test_psnr_leaves_nothing_out_unless_told() -> None:
    corner = np.zeros((20, 30))
    corner[0, 0] = 1
    assert psnr_db(corner, np.zeros((20, 30))) == pytest.approx(10 * np.log10(600))


def test_values_of_a_line_are_compared_as_well() -> None:
    assert psnr_db([0.1, 0.3, 0.0], [0.0, 0.2, 0.1]) == pytest.approx(20)


def test_psnr_counts_in_units_of_the_peak() -> None:
    picture = np.zeros((20, 20))
    assert psnr_db(picture + 1, picture, peak=255) == pytest.approx(20 * np.log10(255))
    assert psnr_db(picture + 1, picture) == pytest.approx(0)


@pytest.mark.parametrize(
    ("a", "b", "crop", "message"),
    [
        ((20, 20), (20, 21), 2, "shapes"),
        ((), (), 0, "shapes"),
        ((20, 20), (20, 20), -1, "crop -1"),
        ((20, 20), (20, 20), 2.5, "crop 2.5; legal: whole numbers"),
        ((20, 40), (20, 40), 10, "crop 10"),
        ((40, 20), (40, 20), 10, "crop 10"),
        ((40, 40, 3), (40, 40, 3), 20, "crop 20"),
    ],
)
def test_pictures_that_cannot_be_compared_are_refused(
    a: tuple[int, ...], b: tuple[int, ...], crop: Any, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        psnr_db(np.zeros(a), np.zeros(b), crop=crop)


def test_a_crop_that_leaves_a_single_row_is_legal() -> None:
    assert psnr_db(np.ones((7, 9, 3)), np.zeros((7, 9, 3)), crop=3) == pytest.approx(0)


def test_psnr_is_of_the_difference() -> None:
    picture = np.random.default_rng(6).random((20, 20))
    assert psnr_db(picture + 0.1, picture) == pytest.approx(20)


@pytest.mark.parametrize(("far", "score"), [(np.inf, -np.inf), (1e200, -np.inf), (1e100, -2000.0)])
def test_pictures_however_far_apart_have_a_score(far: float, score: float) -> None:
    assert psnr_db(np.full((20, 20), far), np.zeros((20, 20))) == pytest.approx(score)


@pytest.mark.parametrize("peak", [0.0, -1.0, np.inf, np.nan])
def test_a_score_needs_a_peak(peak: float) -> None:
    with pytest.raises(ValueError, match=r"peak .*; legal: above 0, finite"):
        psnr_db(np.ones((20, 20)), np.zeros((20, 20)), peak)


def test_the_root_mean_square_of_three_four_is_that_of_their_hypotenuse() -> None:
    assert root_mean_square([[3.0, -4.0]]) == pytest.approx(5 / np.sqrt(2))
