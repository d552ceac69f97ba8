"""What models of compression refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.compression import blocks, jpeg
from simulations.models.compression.chroma_subsampling import coarsen, subsampling_factor
from simulations.models.compression.chroma_upsampling import refine
from simulations.models.compression.entropy import LARGEST, symbol_bits
from simulations.models.compression.zigzag import first_in_order

STEPS = np.ones((8, 8))
BLOCK = np.zeros((8, 8))
TABLE = blocks.LUMINANCE_TABLE
CODES = np.zeros((1, 1, 8, 8))
CELLS, LUMA = np.zeros((2, 2)), np.zeros((4, 4))
NO_PLANE = [np.zeros(shape) for shape in ((0, 8), (8, 0), (8,), (8, 8, 3))]
TOO_MUCH = [np.nan, np.inf, 1.01e9, -1.01e9]
NO_STEP = [0.0, -1.0, 0.9e-3, np.inf, np.nan]
NO_FACTOR = [(0, 2), (2, 0), (-1, 1), (1.5, 2), (2, np.nan)]
NO_QUALITY = [-5, 0, 101, 50.5, 99.999, np.nan, np.inf]


def one(value: float, rest: Any) -> Any:
    """The array with another value in one place."""
    changed = np.array(rest, float)
    changed.flat[-1] = value
    return changed


def filled(
    cells: Any = CELLS, factor: Any = (2, 2), luma: Any = LUMA, method: str = "guided"
) -> Any:
    return refine(cells, factor, luma, method)


@each_of(
    (r"legal: \(H, W\), not empty", lambda p: blocks.compress_plane(p, STEPS), NO_PLANE),
    (r"legal: \(H, W\), not empty", lambda p: coarsen(p, (2, 2)), NO_PLANE),
    ("legal: finite, to", lambda v: blocks.compress_plane(one(v, BLOCK), STEPS), TOO_MUCH),
    (r"legal: 0\.001 or more", lambda s: blocks.compress_plane(BLOCK, one(s, STEPS)), NO_STEP),
    (
        "quality .*whole numbers, 1 to 100",
        lambda q: blocks.quantisation_table(TABLE, q),
        NO_QUALITY,
    ),
    ("codes of type float64", lambda c: blocks.restore_plane(c, STEPS, 8, 8), [CODES]),
    ("'4:1:1'; legal: 4:4:4, 4:2:2, 4:2:0", subsampling_factor, ["4:1:1"]),
    ("factor .*whole numbers, 1 or more", lambda f: coarsen(LUMA, f), NO_FACTOR),
    ("plane reaches .*legal: finite", lambda v: filled(one(v, CELLS)), [np.nan, np.inf, -1.01e12]),
    ("luma reaches .*legal: finite", lambda v: filled(luma=one(v, LUMA)), [np.nan, -1.01e12]),
    ("method 'magic'; legal: repeated, tri", lambda m: filled(method=m), ["magic"]),
    ("factor .*legal: 1 or 2", lambda f: filled(factor=f), [(3, 2), (1.5, 2)]),
    ("legal: one sample for each cell", lambda luma: filled(luma=luma), [np.zeros((5, 4))]),
    ("legal: one sample for each cell", filled, [np.zeros(2)]),
    ("not empty", lambda p: filled(p, luma=np.zeros((0, 4))), [np.zeros((0, 2))]),
    (r"luma \(H, W\)", lambda luma: filled(luma=luma), [np.zeros((4, 4, 3))]),
    ("legal: -32767 to 32767", lambda v: symbol_bits([v + CODES.astype(int)]), [LARGEST + 1]),
    ("legal: -32767 to 32767", lambda v: symbol_bits([v + CODES.astype(int)]), [-LARGEST - 1]),
    ("codes of type float64", lambda c: symbol_bits([c]), [CODES]),
    ("plane reaches", lambda light: jpeg.compress(light, 50), [np.full((8, 8, 3), 1e308)]),
    ("legal: whole numbers, 1 to 64", lambda n: first_in_order(CODES.astype(int), n), [0, 65, 2.5]),
)
def test_models_of_compression_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_largest_values_are_legal() -> None:
    assert blocks.compress_plane(one(1e9, BLOCK), STEPS)[0].max() > 0.99e9
    assert (coarsen(np.full((2, 2), 1e308), (2, 2)) == np.inf).all()
    thirty: Any = 30.0
    table = blocks.quantisation_table(TABLE, thirty)
    np.testing.assert_array_equal(table, blocks.quantisation_table(TABLE, 30))
