"""Demosaicing with gradient-corrected linear filters.

Malvar, He and Cutler: High-quality linear interpolation for demosaicing of Bayer-patterned
color images, ICASSP 2004. Edges lie at the same place in all three colours, so the bilinear
guess is corrected by how much the colour that *was* measured here departs from its own
surroundings. The weights, in eighths, are those of the paper's figure 2.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.sensor.bayer_quads import Quads, above, below, left, right


def malvar(quads: Quads) -> Floats:
    """Five by five filters, one per missing colour: (3, 2, 2, h, w). May overshoot the range."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    gb_right, gr_below = right(gb), below(gr)
    # Greens next to, and at the corners of, each green pixel.
    corners_gr = gb + gb_right + above(gb) + above(gb_right)
    corners_gb = gr + gr_below + left(gr) + left(gr_below)
    aside_gr, upright_gr = left(gr) + right(gr), above(gr) + gr_below
    aside_gb, upright_gb = left(gb) + gb_right, above(gb) + below(gb)

    green_at_red = (2 * (left(gr) + gr + above(gb) + gb) + 4 * r - _cross(r)) / 8
    green_at_blue = (2 * (gb + gb_right + gr + gr_below) + 4 * b - _cross(b)) / 8
    along_row_gr = 5 * gr - corners_gr - aside_gr + upright_gr / 2
    along_row_gb = 5 * gb - corners_gb - aside_gb + upright_gb / 2
    along_column_gr = 5 * gr - corners_gr - upright_gr + aside_gr / 2
    along_column_gb = 5 * gb - corners_gb - upright_gb + aside_gb / 2
    red_at_gr = (4 * (r + right(r)) + along_row_gr) / 8
    red_at_gb = (4 * (r + below(r)) + along_column_gb) / 8
    blue_at_gr = (4 * (above(b) + b) + along_column_gr) / 8
    blue_at_gb = (4 * (left(b) + b) + along_row_gb) / 8
    reds, blues = r + right(r), left(b) + b
    red_at_blue = (2 * (reds + below(reds)) + 6 * b - 1.5 * _cross(b)) / 8
    blue_at_red = (2 * (above(blues) + blues) + 6 * r - 1.5 * _cross(r)) / 8
    return np.array(
        [
            [[r, red_at_gr], [red_at_gb, red_at_blue]],
            [[green_at_red, gr], [gb, green_at_blue]],
            [[blue_at_red, blue_at_gr], [blue_at_gb, b]],
        ]
    )


def _cross(plane: Floats) -> Floats:
    """Sum of the four next pixels of the same colour, two pixels away."""
    return left(plane) + right(plane) + above(plane) + below(plane)
