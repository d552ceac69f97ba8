"""Coarser colour: means over cells, against scikit-image."""

import numpy as np
import pytest
import skimage.transform

from simulations.models.compression.chroma_subsampling import (
    SUBSAMPLING,
    coarsen,
    subsampling_factor,
)


def test_the_names_of_the_standard_say_how_many_pixels_share_a_colour() -> None:
    cells = {name: rows * columns for name, (rows, columns) in SUBSAMPLING.items()}
    assert cells == {"4:4:4": 1, "4:2:2": 2, "4:2:0": 4}
    assert subsampling_factor("4:2:2") == (1, 2)


@pytest.mark.parametrize("factor", [(1, 1), (1, 2), (2, 1), (2, 2), (3, 4)])
def test_cells_are_averaged_as_by_scikit_image(factor: tuple[int, int]) -> None:
    rows, columns = factor
    plane = np.random.default_rng(0).normal(0, 50, (6 * rows, 5 * columns))
    theirs = skimage.transform.downscale_local_mean(plane, factor)
    np.testing.assert_allclose(coarsen(plane, factor), theirs, rtol=1e-12)


def test_a_cell_over_the_border_repeats_it() -> None:
    plane = np.array([[1.0, 3, 5], [1, 3, 9], [8, 8, 2]])
    assert coarsen(plane, (2, 2)).tolist() == [[2, 7], [8, 2]]
