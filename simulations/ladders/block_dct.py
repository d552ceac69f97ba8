"""JPEG's cosine transform: one large product, two small ones, a Fourier transform, integers."""

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.compression.blocks import BLOCK, LUMINANCE_TABLE
from simulations.models.compression.cosine_transforms import TRANSFORMS, exact_block_dct

SIDE = 256


def prepare() -> Floats:
    """Blocks (1024, 8, 8) of whole codes −128…127: waves that grow finer, an edge, grain."""
    return _blocks(3, 60.0, 1.0)


def draw(index: int) -> Floats:
    """Other grain, finer or coarser waves, and edges of other slants."""
    rng = np.random.default_rng(index)
    return _blocks(index, rng.uniform(20.0, 100.0), rng.uniform(0.2, 5.0))


def _blocks(seed: int, fineness: float, slope: float) -> Floats:
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    waves = 60.0 * np.cos(fineness * np.pi * (x * x + y * y))
    edge = np.where(x > slope * y, 40.0, -40.0)
    grain = 8.0 * np.random.default_rng(seed).standard_normal((SIDE, SIDE))
    codes = np.clip(np.rint(waves + edge + grain), -128, 127)
    count = SIDE // BLOCK
    grid: Floats = codes.reshape(count, BLOCK, count, BLOCK).swapaxes(1, 2)
    return grid.reshape(-1, BLOCK, BLOCK)


def worst_codes(result: Floats, truth: Floats, _blocks: Floats) -> float:
    return float(np.abs(result - truth).max())


def changed_per_million(result: Floats, truth: Floats, _blocks: Floats) -> float:
    """Coefficients per million that quality 50 rounds to a different whole number.

    Whole codes have many sums exactly between two numbers. There both are right.
    """
    quotient = truth / LUMINANCE_TABLE
    tie = np.abs(quotient - np.floor(quotient) - 0.5) < 1e-9
    changed = np.rint(result / LUMINANCE_TABLE) != np.rint(quotient)
    return float(1e6 * (changed & ~tie).mean())


LADDER = Ladder(
    id="block-dct",
    title="Transforming blocks",
    workload="256 × 256 pixels in 1024 blocks of 8 × 8 whole codes",
    prepare=prepare,
    tiers=tuple(
        Tier(name, label, cost, TRANSFORMS[name])
        for name, label, cost in (
            ("fixed-point", "Rows, columns, integers", "1024 products a block"),
            ("separable-32", "Rows, columns, float32", "1024 products a block"),
            ("separable", "Rows, then columns", "1024 products a block"),
            ("direct-32", "64 × 64 matrix, float32", "4096 products a block"),
            ("direct", "64 × 64 matrix", "4096 products a block"),
            ("fourier", "By Fourier transforms", "16 transforms of 8 a block"),
        )
    ),
    reference=exact_block_dct,
    reference_label="the standard's double sum in extended precision",
    metrics=(
        Metric("worst", "Largest error", "codes", worst_codes),
        Metric("changed", "Coefficients that round otherwise", "per million", changed_per_million),
    ),
    draw=draw,
    default_tier="separable",
    items=65_536,
)
