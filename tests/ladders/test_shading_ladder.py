"""Blending light across a grid errs with the square of its cells; highlights suffer first."""

import math
from itertools import pairwise

import numpy as np
import pytest

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
    prepare,
    reference,
    rms,
    worst,
)

NORMALS = prepare()
TRUTH = reference(NORMALS)
RESULT = {tier.id: tier.run(NORMALS) for tier in LADDER.tiers}
RMS = {name: rms(result, TRUTH, NORMALS) for name, result in RESULT.items()}


@pytest.mark.parametrize("place", [(128, 128), (60, 190), (0, 256), (256, 0), (30, 220)])
def test_the_reference_is_phongs_formula_by_mirroring_the_view(place: tuple[int, int]) -> None:
    n = [float(each) for each in NORMALS[place]]
    n_dot_l = math.fsum(a * b for a, b in zip(n, LIGHT, strict=True))
    mirrored_view = [2 * n[2] * n[0], 2 * n[2] * n[1], 2 * n[2] * n[2] - 1]
    cosine = max(0.0, math.fsum(a * b for a, b in zip(mirrored_view, LIGHT, strict=True)))
    expected = ALBEDO * n_dot_l + SPECULAR * cosine**SHININESS if n_dot_l > 0 else 0.0
    assert TRUTH[place] == pytest.approx(expected, abs=1e-9)


def test_the_dome_has_shadow_shading_and_a_full_highlight() -> None:
    assert TRUTH.min() == 0.0
    # The highlight peaks where the normal halves the angle of 37° between light and camera.
    peak = ALBEDO * math.sqrt((1 + LIGHT[2]) / 2) + SPECULAR
    assert TRUTH.max() == pytest.approx(peak, abs=1e-3)


@pytest.mark.parametrize(("coarse", "fine"), list(pairwise(GRIDS)))
def test_cells_half_as_wide_err_about_a_quarter_as_much(coarse: int, fine: int) -> None:
    ratio = RMS[f"gouraud-{coarse}"] / RMS[f"gouraud-{fine}"]
    assert 3.3 < ratio < 4.3


def test_blended_light_is_exact_at_the_corners_of_the_cells() -> None:
    every = INTERVALS // 8
    corners = phong_pixels(NORMALS[::every, ::every])
    np.testing.assert_array_equal(RESULT["gouraud-8"][::every, ::every], corners)


def test_a_coarse_grid_misses_a_quarter_of_white_in_the_highlight() -> None:
    error = np.abs(RESULT["gouraud-8"] - TRUTH)
    assert 0.2 < worst(RESULT["gouraud-8"], TRUTH, NORMALS) < 0.3
    assert TRUTH.flat[error.argmax()] > 0.8 * TRUTH.max()


def test_blended_normals_keep_the_highlight_that_blended_light_loses() -> None:
    assert worst(RESULT["gouraud-16"], TRUTH, NORMALS) > 20 * worst(
        RESULT["blended-normals-16"], TRUTH, NORMALS
    )


def test_blending_a_grid_of_every_pixel_changes_nothing() -> None:
    np.testing.assert_array_equal(gouraud(NORMALS, grid=INTERVALS), RESULT["phong"])
    whole = blended_normals(NORMALS, grid=INTERVALS)
    np.testing.assert_allclose(whole, RESULT["phong"], atol=1e-5)


def test_per_pixel_light_errs_by_the_rounding_of_float32() -> None:
    assert worst(RESULT["phong"], TRUTH, NORMALS) < 1e-5


def test_four_times_the_shininess_makes_blinn_look_like_phong_to_a_fiftieth_of_white() -> None:
    assert 1e-4 < worst(RESULT["blinn-phong"], TRUTH, NORMALS) < 0.02


def test_the_default_is_better_than_everything_cheaper() -> None:
    default = [tier.id for tier in LADDER.tiers].index(LADDER.default_tier)
    assert all(RMS[tier.id] > RMS[LADDER.default_tier] for tier in LADDER.tiers[:default])


def test_the_metrics_measure_a_known_offset() -> None:
    assert rms(TRUTH + 0.25, TRUTH, NORMALS) == pytest.approx(0.25)
    assert worst(TRUTH - 0.25, TRUTH, NORMALS) == pytest.approx(0.25)
