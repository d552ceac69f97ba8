"""Fine detail: how much there is, and how much of it is in its place."""

from collections.abc import Callable

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.pixel_grid import centred
from simulations.models.sampling.fine_detail import FINE, fine_detail, without_fine_detail
from simulations.pictures.round_windows import PICTURES, SIZE

type Picture = Callable[[Floats, Floats], Floats]
X, Y = np.meshgrid(centred(SIZE), centred(SIZE))
EACH = pytest.mark.parametrize("picture", PICTURES)


@EACH
@pytest.mark.parametrize("shift", [(1.0, 0.0), (0.0, 1.0), (0.5, -0.7), (3.0, 2.0)])
def test_a_shifted_picture_keeps_its_detail_though_not_in_its_place(
    picture: Picture, shift: tuple[float, float]
) -> None:
    """Shifted in the formula, so that nothing is interpolated."""
    moved = fine_detail(picture(X - shift[0], Y - shift[1]), picture(X, Y))
    assert moved.present == pytest.approx(1, abs=2e-3)
    assert moved.in_place < 0.8


def test_a_wave_s_share_in_place_is_the_cosine_of_how_far_it_moved() -> None:
    x, _ = np.meshgrid(np.arange(64.0), np.arange(64.0))
    wave, moved = (np.cos(2 * np.pi * 0.25 * (x - s)) for s in (0.0, 0.5))
    detail = fine_detail(moved, wave)
    assert (detail.present, detail.in_place) == pytest.approx((1, np.cos(np.pi / 4)))


def test_contrast_and_brightness_are_told_apart() -> None:
    truth = PICTURES[0](X, Y)
    weaker = fine_detail(0.3 + 0.25 * truth, truth)
    assert (weaker.present, weaker.in_place) == pytest.approx((0.25, 0.25))


def test_without_fine_detail_none_is_present_and_coarse_waves_stay() -> None:
    x, _ = np.meshgrid(np.arange(64.0), np.arange(64.0))
    coarse, fine = (np.cos(2 * np.pi * f * x) for f in (0.125, 0.25))
    np.testing.assert_allclose(without_fine_detail(coarse + fine), coarse, atol=1e-12)
    assert fine_detail(coarse, coarse + fine).present == pytest.approx(0, abs=1e-12)
    assert 0.125 < FINE < 0.25
