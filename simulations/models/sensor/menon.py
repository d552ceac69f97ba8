"""Demosaicing along edges instead of across them.

Menon, Andriani and Calvagno: Demosaicing with directional filtering and a posteriori decision, IEEE
Transactions on Image Processing 16(1), 2007 (DDFAPD). Green is estimated twice, along rows and
along columns; at each pixel the direction with smaller variation of the colour differences is
chosen. Red and blue follow from green, and a last pass, the refinement, smooths the colour
differences.

Names: ``g_r`` is green at the red pixels, ``r_gb`` is red at the green pixels of blue rows.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.sensor.bayer_quads import Quads, above, below, left_of, right_of

type Step = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True)
class Estimate:
    """The eight estimated planes, each (h, w), and the chosen direction."""

    g_r: Floats
    g_b: Floats
    r_gr: Floats
    r_gb: Floats
    b_gr: Floats
    b_gb: Floats
    r_b: Floats
    b_r: Floats
    by_row_r: Mask
    """Whether rows were chosen at the red pixels."""
    by_row_b: Mask
    """Whether rows were chosen at the blue pixels."""


def menon(quads: Quads) -> Floats:
    """Directional interpolation with refinement: (3, 2, 2, h, w). May overshoot the range."""
    return _planes(quads, _refined(quads, _estimate(quads)))


def menon_unrefined(quads: Quads) -> Floats:
    """`menon` without its last pass: (3, 2, 2, h, w). May overshoot the range."""
    return _planes(quads, _estimate(quads))


def _estimate(quads: Quads) -> Estimate:
    """Green in the direction of less variation, then red and blue from their differences to
    green."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    along_rows, along_columns = _green_along_rows(quads), _green_along_columns(quads)
    by_row_r, by_row_b = _calmer_along_rows(r, b, along_rows, along_columns)
    g_r = np.where(by_row_r, along_rows[0], along_columns[0])
    g_b = np.where(by_row_b, along_rows[1], along_columns[1])

    r_gr, r_gb, b_gr, b_gb = _at_greens(r - g_r, b - g_b, gr, gb)
    at_gr, at_gb = r_gr - b_gr, r_gb - b_gb
    r_b = b + np.where(by_row_b, at_gb + right_of(at_gb), at_gr + below(at_gr)) / 2
    b_r = r - np.where(by_row_r, at_gr + left_of(at_gr), at_gb + above(at_gb)) / 2
    return Estimate(g_r, g_b, r_gr, r_gb, b_gr, b_gb, r_b, b_r, by_row_r, by_row_b)


def _refined(quads: Quads, first: Estimate) -> Estimate:
    """Smooth the differences from green, at the pixels where green was estimated ..."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    by_row_r, by_row_b = first.by_row_r, first.by_row_b
    g_r = r - _mean_of_3(r - first.g_r, first.r_gr - gr, left_of, first.r_gb - gb, above, by_row_r)
    g_b = b - _mean_of_3(b - first.g_b, first.b_gb - gb, right_of, first.b_gr - gr, below, by_row_b)
    # ... which moves red and blue at the green pixels, and then at one another's.
    r_gr, r_gb, b_gr, b_gb = _at_greens(r - g_r, b - g_b, gr, gb)
    at_gr, at_gb = r_gr - b_gr, r_gb - b_gb
    r_b = b + _mean_of_3(first.r_b - b, at_gb, right_of, at_gr, below, by_row_b)
    b_r = r - _mean_of_3(r - first.b_r, at_gr, left_of, at_gb, above, by_row_r)
    return Estimate(g_r, g_b, r_gr, r_gb, b_gr, b_gb, r_b, b_r, by_row_r, by_row_b)


def _planes(quads: Quads, e: Estimate) -> Floats:
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    return np.array(
        [[[r, e.r_gr], [e.r_gb, e.r_b]], [[e.g_r, gr], [gb, e.g_b]], [[e.b_r, e.b_gr], [e.b_gb, b]]]
    )


def _green_along_rows(quads: Quads) -> tuple[Floats, Floats]:
    """Green at the red and at the blue pixels from their rows, corrected by the curvature there."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    g_r = (left_of(gr) + gr) / 2 + (2 * r - left_of(r) - right_of(r)) / 4
    g_b = (gb + right_of(gb)) / 2 + (2 * b - left_of(b) - right_of(b)) / 4
    return g_r, g_b


def _green_along_columns(quads: Quads) -> tuple[Floats, Floats]:
    """Green at the red and at the blue pixels from their columns."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    g_r = (above(gb) + gb) / 2 + (2 * r - above(r) - below(r)) / 4
    g_b = (gr + below(gr)) / 2 + (2 * b - above(b) - below(b)) / 4
    return g_r, g_b


def _calmer_along_rows(
    r: Floats, b: Floats, along_rows: tuple[Floats, Floats], along_columns: tuple[Floats, Floats]
) -> tuple[Mask, Mask]:
    """Whether colour differences vary less along rows, at the red and at the blue pixels.

    The variation is summed over a window of five by five pixels; the pixel's own row (or column)
    counts threefold. A tie goes to the rows.
    """
    rows_r, rows_b = (_step(c - g, right_of) for c, g in zip((r, b), along_rows, strict=True))
    columns_r, columns_b = (_step(c - g, below) for c, g in zip((r, b), along_columns, strict=True))
    in_rows_r = _window(rows_r, left_of, above, below) + left_of(rows_b + above(rows_b))
    in_rows_b = _window(rows_b, left_of, above, below) + rows_r + below(rows_r)
    in_columns_r = _window(columns_r, above, left_of, right_of) + above(
        columns_b + left_of(columns_b)
    )
    in_columns_b = _window(columns_b, above, left_of, right_of) + columns_r + right_of(columns_r)
    return in_columns_r >= in_rows_r, in_columns_b >= in_rows_b


def _step(difference: Floats, towards: Step) -> Floats:
    return np.abs(difference - towards(difference))


def _window(change: Floats, back: Step, aside: Step, other_side: Step) -> Floats:
    pair = change + back(change)
    return 3 * pair + aside(pair) + other_side(pair)


def _at_greens(
    red_less_green: Floats, blue_less_green: Floats, gr: Floats, gb: Floats
) -> tuple[Floats, Floats, Floats, Floats]:
    """Red at both kinds of green pixel, then blue: green plus the mean of the adjacent
    differences."""
    d_r, d_b = red_less_green, blue_less_green
    return (
        gr + (d_r + right_of(d_r)) / 2,
        gb + (d_r + below(d_r)) / 2,
        gr + (above(d_b) + d_b) / 2,
        gb + (left_of(d_b) + d_b) / 2,
    )


def _mean_of_3(
    centre: Floats, in_row: Floats, aside: Step, in_column: Floats, upright: Step, by_row: Mask
) -> Floats:
    """Mean of a difference at a pixel and at its two neighbours in the chosen direction."""
    ends = np.where(by_row, in_row + aside(in_row), in_column + upright(in_column))
    return (centre + ends) / 3
