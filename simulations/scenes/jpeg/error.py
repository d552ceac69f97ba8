"""Errors of a picture's coefficients against the standard's sums, and the changed codes."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Readout, format_magnitude
from simulations.models.arrays import Floats
from simulations.models.compression.blocks import Transform, round_outwards, to_blocks
from simulations.models.compression.chroma_subsampling import coarsen, subsampling_factor
from simulations.models.compression.cosine_transforms import exact_block_dct
from simulations.models.compression.jpeg import Coded, tables

BLOCKS_A_STEP = 120
"""Blocks per step, as extended precision is slow in a browser."""


def estimates(planes: Floats, coded: Coded, transform: Transform) -> Iterator[Readout]:
    """The largest error so far, and the count of changed codes, over more blocks with each step.

    ``planes`` (3, H, W) are those before the transform.
    """
    worst, changed, compared = 0.0, 0, 0
    total = sum(codes.size // 64 for codes in coded.planes)
    for blocks, steps, codes in _parts(planes, coded):
        truth = exact_block_dct(blocks)
        worst = max(worst, float(np.abs(transform(blocks) - truth).max()))
        changed += int(np.count_nonzero(round_outwards(truth / steps) != codes))
        compared += len(blocks)
        label = (
            f"Largest error of a coefficient in {compared} of {total} blocks "
            f"({changed} round otherwise)"
        )
        yield Readout("error", label, format_magnitude(worst, 1e-15), "codes", "error")


def _parts(planes: Floats, coded: Coded) -> Iterator[tuple[Floats, Floats, NDArray[np.int64]]]:
    """Blocks (n, 8, 8) of samples, the steps of their plane, and their codes."""
    factor = subsampling_factor(coded.subsampling)
    fine, coarse = tables(coded.quality)
    samples = (planes[0], *(coarsen(plane, factor) for plane in planes[1:]))
    for plane, steps, codes in zip(samples, (fine, coarse, coarse), coded.planes, strict=True):
        blocks, coefficients = to_blocks(plane).reshape(-1, 8, 8), codes.reshape(-1, 8, 8)
        for start in range(0, len(blocks), BLOCKS_A_STEP):
            part = slice(start, start + BLOCKS_A_STEP)
            yield blocks[part], steps.astype(float), coefficients[part]
