"""Demosaicing with gradient-corrected linear filters.

Malvar, He and Cutler: High-quality linear interpolation for demosaicing of Bayer-patterned color
images, ICASSP 2004. Edges are at the same place in all three colours, so the bilinear estimate is
corrected by the difference of the measured colour from its surroundings. The weights, in eighths,
are those of the paper's figure 2.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.sensor.bayer_quads import Quads, above, below, left, right


def malvar(quads: Quads) -> Floats:
    """Five by five filters, one per missing colour: (3, 2, 2, h, w). May overshoot the range."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    gb_right, gr_below = right(gb), below(gr)
    # Greens next to, and at the corners of, each green pixel.
    corners_gr = (gb + gb_right) + (above(gb) + above(gb_right))
    corners_gb = (gr + gr_below) + (left(gr) + left(gr_below))
    aside_gr, upright_gr = left(gr) + right(gr), above(gr) + gr_below
    aside_gb, upright_gb = left(gb) + gb_right, above(gb) + below(gb)

    # Each is a mean plus a difference that is exactly 0 where the picture is flat.
    r_excess, b_excess = (4 * plane - _cross(plane) for plane in (r, b))
    gr_excess, gb_excess = 4 * gr - corners_gr, 4 * gb - corners_gb
    green_at_red = ((left(gr) + gr) + (above(gb) + gb)) / 4 + r_excess / 8
    green_at_blue = ((gb + gb_right) + (gr + gr_below)) / 4 + b_excess / 8
    along_row_gr = (gr_excess + (gr + upright_gr / 2 - aside_gr)) / 8
    along_row_gb = (gb_excess + (gb + upright_gb / 2 - aside_gb)) / 8
    along_column_gr = (gr_excess + (gr + aside_gr / 2 - upright_gr)) / 8
    along_column_gb = (gb_excess + (gb + aside_gb / 2 - upright_gb)) / 8
    reds, blues = r + right(r), left(b) + b
    red_at_gr, red_at_gb = reds / 2 + along_row_gr, (r + below(r)) / 2 + along_column_gb
    blue_at_gr, blue_at_gb = (above(b) + b) / 2 + along_column_gr, blues / 2 + along_row_gb
    red_at_blue = (reds + below(reds)) / 4 + b_excess * (1.5 / 8)
    blue_at_red = (above(blues) + blues) / 4 + r_excess * (1.5 / 8)
    return np.array(
        [
            [[r, red_at_gr], [red_at_gb, red_at_blue]],
            [[green_at_red, gr], [gb, green_at_blue]],
            [[blue_at_red, blue_at_gr], [blue_at_gb, b]],
        ]
    )


def _cross(plane: Floats) -> Floats:
    """Sum of the four nearest pixels of the same colour, two pixels away."""
    return (left(plane) + right(plane)) + (above(plane) + below(plane))
