"""Colour differences filled in, against OpenCV, Pillow, means of parabolas, and regression."""

import cv2
import numpy as np
import pytest

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


def test_the_parabola_is_exact_for_means_of_a_parabola() -> None:
    """Means over cells and over half cells of 3 + 2t − t²/2, from its integral."""

    def means(edges: Floats) -> Floats:
        integral = 3 * edges + edges**2 - edges**3 / 6
        return np.diff(integral) / np.diff(edges)

    coarse, fine = means(np.arange(0.0, 9.0)), means(np.arange(0.0, 8.25, 0.5))
    ours = refine(coarse[None], (1, 2), np.zeros((1, 16)), "parabola")[0]
    np.testing.assert_allclose(ours[2:-2], fine[2:-2], atol=1e-12)


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


def test_the_triangle_is_the_default() -> None:
    plane, luma = np.eye(3), np.zeros((6, 6))
    np.testing.assert_array_equal(
        refine(plane, (2, 2), luma), refine(plane, (2, 2), luma, "triangle")
    )
