"""Blending light across a grid errs with the square of its cells; highlights suffer first."""

import math
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from support.ladder_run import LadderRun

from simulations.ladders.shading import (
    ALBEDO,
    GRIDS,
    INTERVALS,
    LADDER,
    LIGHT,
    SHININESS,
    SPECULAR,
    blended_normals,
    gouraud,
    phong_pixels,
    rms,
    worst,
)

RUN = LadderRun(LADDER)


@cache
def errors() -> dict[str, float]:
    return RUN.measured(rms)


@pytest.mark.parametrize("place", [(128, 128), (60, 190), (0, 256), (256, 0), (30, 220)])
def test_the_reference_is_phongs_formula_by_mirroring_the_view(place: tuple[int, int]) -> None:
    n = [float(each) for each in RUN.work[place]]
    n_dot_l = math.fsum(a * b for a, b in zip(n, LIGHT, strict=True))
    mirrored_view = [2 * n[2] * n[0], 2 * n[2] * n[1], 2 * n[2] * n[2] - 1]
    cosine = max(0.0, math.fsum(a * b for a, b in zip(mirrored_view, LIGHT, strict=True)))
    expected = ALBEDO * n_dot_l + SPECULAR * cosine**SHININESS if n_dot_l > 0 else 0.0
    assert RUN.truth[place] == pytest.approx(expected, abs=1e-9)


def test_the_dome_has_shadow_shading_and_a_full_highlight() -> None:
    assert RUN.truth.min() == 0.0
    # The highlight peaks where the normal halves the angle of 37° between light and camera.
    peak = ALBEDO * math.sqrt((1 + LIGHT[2]) / 2) + SPECULAR
    assert RUN.truth.max() == pytest.approx(peak, abs=1e-3)


@pytest.mark.parametrize(("coarse", "fine"), list(pairwise(GRIDS)))
def test_cells_half_as_wide_err_about_a_quarter_as_much(coarse: int, fine: int) -> None:
    ratio = errors()[f"gouraud-{coarse}"] / errors()[f"gouraud-{fine}"]
    assert 3.3 < ratio < 4.3


def test_blended_light_is_exact_at_the_corners_of_the_cells() -> None:
    every = INTERVALS // 8
    corners = phong_pixels(RUN.work[::every, ::every])
    np.testing.assert_array_equal(RUN.results["gouraud-8"][::every, ::every], corners)


def test_a_coarse_grid_misses_a_quarter_of_white_in_the_highlight() -> None:
    error = np.abs(RUN.results["gouraud-8"] - RUN.truth)
    assert 0.2 < worst(RUN.results["gouraud-8"], RUN.truth, RUN.work) < 0.3
    assert RUN.truth.flat[error.argmax()] > 0.8 * RUN.truth.max()


def test_blended_normals_keep_the_highlight_that_blended_light_loses() -> None:
    assert worst(RUN.results["gouraud-16"], RUN.truth, RUN.work) > 20 * worst(
        RUN.results["blended-normals-16"], RUN.truth, RUN.work
    )


def test_blending_a_grid_of_every_pixel_changes_nothing() -> None:
    np.testing.assert_array_equal(gouraud(RUN.work, grid=INTERVALS), RUN.results["phong"])
    whole = blended_normals(RUN.work, grid=INTERVALS)
    np.testing.assert_allclose(whole, RUN.results["phong"], atol=1e-5)


def test_per_pixel_light_errs_by_the_rounding_of_float32() -> None:
    assert worst(RUN.results["phong"], RUN.truth, RUN.work) < 1e-5


def test_four_times_the_shininess_makes_blinn_look_like_phong_to_a_fiftieth_of_white() -> None:
    assert 1e-4 < worst(RUN.results["blinn-phong"], RUN.truth, RUN.work) < 0.02


def test_the_metrics_measure_a_known_offset() -> None:
    assert rms(RUN.truth + 0.25, RUN.truth, RUN.work) == pytest.approx(0.25)
    assert worst(RUN.truth - 0.25, RUN.truth, RUN.work) == pytest.approx(0.25)
