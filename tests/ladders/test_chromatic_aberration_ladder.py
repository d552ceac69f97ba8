"""How many wavelengths make a smooth fringe."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from support.ladder_run import LadderRun

from simulations.ladders.chromatic_aberration import (
    LADDER,
    LENS,
    PEAKS_UM,
    SIZE,
    TILE_PX,
    WIDTH_UM,
    Workload,
    reference,
    rms,
)
from simulations.models.lens.chromatic_aberration import lateral_chromatic_scale

RUN = LadderRun(LADDER)
PICTURES = {"gauss-1": 3, "gauss-3": 9, "even-9": 9, "gauss-5": 15, "even-16": 16, "even-31": 31}


@cache
def errors() -> dict[str, float]:
    return RUN.measured(rms)


def test_the_reference_agrees_with_adaptive_quadrature_over_wavelengths() -> None:
    blue, row, column = 2, SIZE // 2 + 3, 5
    x, edges = float(RUN.work.x[0, column]), TILE_PX * (np.arange(-9, 9) + 0.5)

    def light(wavelength_um: float) -> float:
        scale = float(lateral_chromatic_scale(LENS, 50.0, 60.0, wavelength_um))
        low, high = (x - 0.5) / scale, (x + 0.5) / scale
        tiles = np.diff(np.clip(edges, low, high))
        bell = np.exp(-0.5 * ((wavelength_um - PEAKS_UM[blue]) / WIDTH_UM) ** 2)
        bright = tiles[::2].sum()  # in this row, which lies in tile 0, the even tiles are light
        return float(bright / (high - low) * bell / (WIDTH_UM * np.sqrt(2 * np.pi)))

    expected, _ = quad(light, 0.30, 0.62, limit=400)
    assert RUN.truth[blue, row, column] == pytest.approx(expected, abs=1e-4)


def test_the_axis_has_no_fringe() -> None:
    """On the axis every wavelength has the same scale; a step away it hardly differs."""
    middle = slice(SIZE // 2 - 3, SIZE // 2 + 3)
    np.testing.assert_allclose(RUN.truth[:, middle, middle], 1.0, atol=1e-6)


def test_more_wavelengths_of_one_kind_are_truer() -> None:
    assert errors()["gauss-1"] > 2 * errors()["gauss-3"] > 3 * errors()["gauss-5"]
    assert errors()["even-9"] > 2 * errors()["even-16"] > 4 * errors()["even-31"]


def test_even_wavelengths_beat_as_many_chosen_ones() -> None:
    """Gauss's rule is made for smooth functions; an edge that passes a pixel is none."""
    assert errors()["even-9"] < errors()["gauss-3"] / 2
    assert errors()["even-16"] < errors()["gauss-5"] / 2


def test_three_pictures_leave_coloured_ghosts_and_many_leave_less_than_a_code() -> None:
    assert errors()["gauss-1"] > 10 / 255
    assert errors()["even-31"] < 0.5 / 255


@pytest.mark.parametrize("tier", list(PICTURES))
def test_without_fringes_there_is_nothing_to_err_on(tier: str) -> None:
    """Near the axis all wavelengths agree, so that any number of them is enough."""
    middle = slice(SIZE // 2 - 3, SIZE // 2 + 3)
    axis = Workload(RUN.work.x[:, middle], RUN.work.y[middle])
    whole = LADDER.tier(tier).run(RUN.work)[:, middle, middle]
    np.testing.assert_allclose(whole, reference(axis), atol=1e-5)


def test_the_metric_notices_a_target_that_is_a_thousandth_larger() -> None:
    near = Workload(RUN.work.x * np.float32(1.001), RUN.work.y * np.float32(1.001))
    assert rms(LADDER.tier("even-31").run(near), RUN.truth, RUN.work) > 5 * errors()["even-31"]
