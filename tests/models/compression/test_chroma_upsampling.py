"""Colour differences filled in, against OpenCV, Pillow, means of parabolas, and regression."""

from typing import Any

import cv2
import numpy as np
import pytest
from PIL import Image

from simulations.models.arrays import Floats
from simulations.models.compression.chroma_subsampling import coarsen
from simulations.models.compression.chroma_upsampling import GRAIN_CODES, KERNELS, METHODS, refine

FACTORS = [(1, 1), (1, 2), (2, 1), (2, 2)]
RANDOM = np.random.default_rng(0)


def luma_for(plane: Floats, factor: tuple[int, int]) -> Floats:
    rows, columns = (side * cells for side, cells in zip(plane.shape, factor, strict=True))
    return RANDOM.normal(0, 50, (rows, columns))


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize(
    ("method", "theirs"), [("repeated", cv2.INTER_NEAREST), ("triangle", cv2.INTER_LINEAR)]
)
def test_repetition_and_triangle_are_opencvs(
    method: str, theirs: int, factor: tuple[int, int]
) -> None:
    plane = RANDOM.normal(0, 50, (6, 5))
    luma = luma_for(plane, factor)
    expected = cv2.resize(plane, luma.shape[::-1], interpolation=theirs)
    np.testing.assert_allclose(refine(plane, factor, luma, method), expected, atol=1e-12)


def test_the_cubic_is_pillows_inside_the_border() -> None:
    plane = RANDOM.normal(0, 50, (9, 8)).astype(np.float32)
    theirs = np.asarray(Image.fromarray(plane).resize((16, 18), Image.Resampling.BICUBIC))
    ours = refine(plane, (2, 2), np.zeros((18, 16)), "cubic")
    np.testing.assert_allclose(ours[4:-4, 4:-4], theirs[4:-4, 4:-4], atol=1e-3)


def test_the_parabola_is_exact_for_means_of_a_parabola() -> None:
    """Means over cells and over half cells of 3 + 2t − t²/2, from its integral."""

    def means(edges: Floats) -> Floats:
        integral = 3 * edges + edges**2 - edges**3 / 6
        return np.diff(integral) / np.diff(edges)

    coarse, fine = means(np.arange(0.0, 9.0)), means(np.arange(0.0, 8.25, 0.5))
    ours = refine(coarse[None], (1, 2), np.zeros((1, 16)), "parabola")[0]
    np.testing.assert_allclose(ours[2:-2], fine[2:-2], atol=1e-12)


@pytest.mark.parametrize("method", ["repeated", "parabola"])
def test_what_keeps_the_mean_of_each_cell_is_undone_by_averaging(method: str) -> None:
    plane = RANDOM.normal(size=(4, 3))
    full = refine(plane, (2, 2), np.zeros((8, 6)), method)
    np.testing.assert_allclose(coarsen(full, (2, 2))[1:-1, 1:-1], plane[1:-1, 1:-1], rtol=1e-14)


def test_the_cubic_s_weights_are_catmull_and_roms() -> None:
    """(−t + 2t² − t³)/2 and so on, at three quarters of the way."""
    t = 0.75
    expected = (
        (-t + 2 * t**2 - t**3) / 2,
        (2 - 5 * t**2 + 3 * t**3) / 2,
        (t + 4 * t**2 - 3 * t**3) / 2,
        (-(t**2) + t**3) / 2,
    )
    assert KERNELS["cubic"] == pytest.approx(expected)


def test_where_colour_follows_luma_its_edges_come_back() -> None:
    """A fine chequerboard of luma, on which colour depends linearly: no kernel can see it."""
    y, x = np.mgrid[:32, :32]
    luma = np.where((x // 3 + y // 3) % 2, 60.0, -60.0)
    colour = 0.4 * luma + 7
    coarse = coarsen(colour, (2, 2))
    off = {
        m: np.sqrt(np.mean((refine(coarse, (2, 2), luma, m) - colour)[4:-4, 4:-4] ** 2))
        for m in METHODS
    }
    assert off["guided"] < 0.1 * min(off[m] for m in KERNELS)


def test_the_slope_is_that_of_a_regression_held_back_by_grain() -> None:
    """Cell by cell, by numpy's covariance of the 3 x 3 cells around it."""
    luma = RANDOM.normal(0, 30, (10, 12))
    coarse = coarsen(luma, (2, 2))
    plane = 0.5 * coarse + RANDOM.normal(0, 10, coarse.shape)
    slope = np.empty_like(plane)
    light, colour = np.pad(coarse, 1, mode="edge"), np.pad(plane, 1, mode="edge")
    for row, column in np.ndindex(plane.shape):
        around = (slice(row, row + 3), slice(column, column + 3))
        covariance = np.cov(light[around].ravel(), colour[around].ravel(), bias=True)
        slope[row, column] = covariance[0, 1] / (covariance[0, 0] + GRAIN_CODES**2)
    base, detail, scale = (
        refine(each, (2, 2), luma, "parabola") for each in (plane, coarse, slope)
    )
    expected = base + scale * (luma - detail)
    np.testing.assert_allclose(refine(plane, (2, 2), luma, "guided"), expected, atol=1e-10)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("shape", [(1, 1), (3, 5), (4, 6), (7, 2)])
def test_any_size_comes_back_and_one_colour_stays(
    shape: tuple[int, int], factor: tuple[int, int], method: str
) -> None:
    coarse = coarsen(np.full(shape, 0.3), factor)
    back = refine(coarse, factor, RANDOM.normal(0, 50, shape), method)
    assert back.shape == shape
    np.testing.assert_allclose(back, 0.3, rtol=1e-13)


@pytest.mark.parametrize("method", METHODS)
def test_colour_of_every_pixel_is_left_alone(method: str) -> None:
    plane = RANDOM.normal(0, 50, (5, 7))
    np.testing.assert_array_equal(refine(plane, (1, 1), RANDOM.normal(size=(5, 7)), method), plane)


def test_the_triangle_is_the_default_and_float32_stays_float32() -> None:
    plane, luma = np.eye(3, dtype=np.float32), np.zeros((6, 6), np.float32)
    np.testing.assert_array_equal(
        refine(plane, (2, 2), luma), refine(plane, (2, 2), luma, "triangle")
    )
    for method in METHODS:
        assert refine(plane, (2, 2), luma, method).dtype == np.float32


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.01e12])
def test_values_beyond_all_codes_are_refused(bad: float, method: str) -> None:
    plane, luma = np.zeros((2, 2)), np.zeros((4, 4))
    plane[1, 0] = bad
    with pytest.raises(ValueError, match=r"plane reaches .*legal: finite"):
        refine(plane, (2, 2), luma, method)
    luma[3, 2] = bad
    with pytest.raises(ValueError, match=r"luma reaches .*legal: finite"):
        refine(np.zeros((2, 2)), (2, 2), luma, method)


@pytest.mark.parametrize(
    ("plane", "factor", "luma", "method", "message"),
    [
        ((2, 2), (2, 2), (4, 4), "magic", "method 'magic'; legal: repeated, triangle"),
        ((2, 2), (3, 2), (6, 4), "triangle", r"factor \(3, 2\); legal: 1 or 2"),
        ((2, 2), (1.5, 2), (3, 4), "triangle", "factor .*legal: 1 or 2"),
        ((2, 2), (2, 2), (5, 4), "triangle", "legal: one sample for each cell"),
        ((0, 2), (2, 2), (0, 4), "triangle", "not empty"),
        ((2,), (2, 2), (4, 4), "triangle", "legal: one sample for each cell"),
        ((2, 2), (2, 2), (4, 4, 3), "triangle", r"luma \(H, W\)"),
    ],
)
def test_what_does_not_fit_is_refused(
    plane: tuple[int, ...],
    factor: Any,
    luma: tuple[int, ...],
    method: str,
    message: str,
) -> None:
    with pytest.raises(ValueError, match=message):
        refine(np.zeros(plane), factor, np.zeros(luma), method)
