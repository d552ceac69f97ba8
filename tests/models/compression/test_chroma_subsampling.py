"""Coarser colour: means over cells, against scikit-image."""

from typing import Any

import numpy as np
import pytest
import skimage.transform

from simulations.models.compression.chroma_subsampling import (
    SUBSAMPLING,
    coarsen,
    subsampling_factor,
)

FACTORS = [(1, 1), (1, 2), (2, 1), (2, 2), (3, 4)]


def test_the_names_of_the_standard_say_how_many_pixels_share_a_colour() -> None:
    cells = {name: rows * columns for name, (rows, columns) in SUBSAMPLING.items()}
    assert cells == {"4:4:4": 1, "4:2:2": 2, "4:2:0": 4}
    assert subsampling_factor("4:2:2") == (1, 2)


def test_a_name_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match=r"'4:1:1'; legal: 4:4:4, 4:2:2, 4:2:0"):
        subsampling_factor("4:1:1")


@pytest.mark.parametrize("factor", FACTORS)
def test_cells_are_averaged_as_by_scikit_image(factor: tuple[int, int]) -> None:
    rows, columns = factor
    plane = np.random.default_rng(0).normal(0, 50, (6 * rows, 5 * columns))
    theirs = skimage.transform.downscale_local_mean(plane, factor)
    np.testing.assert_allclose(coarsen(plane, factor), theirs, rtol=1e-12)


def test_a_cell_over_the_border_repeats_it() -> None:
    plane = np.array([[1.0, 3, 5], [1, 3, 9], [8, 8, 2]])
    assert coarsen(plane, (2, 2)).tolist() == [[2, 7], [8, 2]]


@pytest.mark.parametrize("shape", [(1, 1), (3, 5), (4, 6), (7, 2)])
@pytest.mark.parametrize("factor", FACTORS)
def test_one_colour_stays_at_any_size(shape: tuple[int, int], factor: tuple[int, int]) -> None:
    coarse = coarsen(np.full(shape, 0.3), factor)
    np.testing.assert_allclose(coarse, 0.3, rtol=1e-15)
    assert coarse.shape == tuple(
        -(-side // cells) for side, cells in zip(shape, factor, strict=True)
    )


@pytest.mark.parametrize("shape", [(0, 4), (4, 0), (4,), (2, 2, 3)])
def test_what_is_no_plane_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"legal: \(H, W\), not empty"):
        coarsen(np.zeros(shape), (2, 2))


@pytest.mark.parametrize("factor", [(0, 2), (2, 0), (-1, 1), (1.5, 2), (2, np.nan)])
def test_factors_that_are_no_whole_numbers_from_one_are_refused(factor: Any) -> None:
    with pytest.raises(ValueError, match=r"factor .*; legal: whole numbers, 1 or more"):
        coarsen(np.zeros((4, 4)), factor)


def test_float32_stays_float32() -> None:
    assert coarsen(np.zeros((4, 4), np.float32), (2, 2)).dtype == np.float32


def test_what_overflows_is_infinite_without_a_warning() -> None:
    assert coarsen(np.full((2, 2), 1e308), (2, 2))[0, 0] == np.inf
