"""Demosaicing: estimate the two missing colours of each pixel of a Bayer mosaic. Six methods, from
cheap to expensive. Szeliski, 2nd ed., section 10.3.1. The mosaic itself is in
`simulations.models.sensor.bayer`; the methods that choose a direction are in
`simulations.models.sensor.menon`.

A sensor counts light, so mosaic and result are linear; use `encode_srgb` on the result for display.

The gradient-corrected linear filters are of Malvar, He and Cutler: High-quality linear
interpolation for demosaicing of Bayer-patterned color images, ICASSP 2004. Edges are at the same
place in all three colours, so the bilinear estimate is corrected by the difference of the measured
colour from its surroundings. The weights, in eighths, are those of the paper's figure 2.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.require import require_one_of
from simulations.models.sensor.bayer import PATTERNS, filter_colours, mosaic
from simulations.models.sensor.bayer_quads import (
    Quads,
    above,
    below,
    from_quads,
    left_of,
    right_of,
    to_quads,
)
from simulations.models.sensor.menon import menon, menon_unrefined


def malvar(quads: Quads) -> Floats:
    """Five by five filters, one per missing colour: (3, 2, 2, h, w). May overshoot the range."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    gb_right, gr_below = right_of(gb), below(gr)
    # Greens next to, and at the corners of, each green pixel.
    corners_gr = (gb + gb_right) + (above(gb) + above(gb_right))
    corners_gb = (gr + gr_below) + (left_of(gr) + left_of(gr_below))
    aside_gr, upright_gr = left_of(gr) + right_of(gr), above(gr) + gr_below
    aside_gb, upright_gb = left_of(gb) + gb_right, above(gb) + below(gb)

    # Each is a mean plus a difference that is exactly 0 where the picture is flat.
    r_excess, b_excess = (4 * plane - _cross(plane) for plane in (r, b))
    gr_excess, gb_excess = 4 * gr - corners_gr, 4 * gb - corners_gb
    green_at_red = ((left_of(gr) + gr) + (above(gb) + gb)) / 4 + r_excess / 8
    green_at_blue = ((gb + gb_right) + (gr + gr_below)) / 4 + b_excess / 8
    along_row_gr = (gr_excess + (gr + upright_gr / 2 - aside_gr)) / 8
    along_row_gb = (gb_excess + (gb + upright_gb / 2 - aside_gb)) / 8
    along_column_gr = (gr_excess + (gr + aside_gr / 2 - upright_gr)) / 8
    along_column_gb = (gb_excess + (gb + aside_gb / 2 - upright_gb)) / 8
    reds, blues = r + right_of(r), left_of(b) + b
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
    return (left_of(plane) + right_of(plane)) + (above(plane) + below(plane))


__all__ = ["METHODS", "PATTERNS", "demosaic", "mosaic"]


def nearest(quads: Quads) -> Floats:
    """Copy the missing colours from within the quad: (3, 2, 2, h, w). Green is from the same
    row."""
    q = quads
    return np.array(
        [
            [[q.red, q.red], [q.red, q.red]],
            [[q.green_red, q.green_red], [q.green_blue, q.green_blue]],
            [[q.blue, q.blue], [q.blue, q.blue]],
        ]
    )


def bilinear(quads: Quads) -> Floats:
    """Average the nearest two or four samples of the missing colour: (3, 2, 2, h, w)."""
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    red_at_gr, red_at_gb = (r + right_of(r)) / 2, (r + below(r)) / 2
    red_at_blue = (red_at_gr + below(red_at_gr)) / 2
    green_at_red = (left_of(gr) + gr + above(gb) + gb) / 4
    green_at_blue = (gb + right_of(gb) + gr + below(gr)) / 4
    blue_at_gr, blue_at_gb = (above(b) + b) / 2, (left_of(b) + b) / 2
    blue_at_red = (left_of(blue_at_gr) + blue_at_gr) / 2
    return np.array(
        [
            [[r, red_at_gr], [red_at_gb, red_at_blue]],
            [[green_at_red, gr], [gb, green_at_blue]],
            [[blue_at_red, blue_at_gr], [blue_at_gb, b]],
        ]
    )


def menon_encoded(quads: Quads) -> Floats:
    """`menon_unrefined` of sRGB-encoded values: (3, 2, 2, h, w).

    Where the light on one surface changes, its three colours change by a common *factor*. The sRGB
    curve makes the differences across such edges, which the methods compare, more similar in the
    three colours than they are in linear light.
    """
    r, gr, gb, b = quads.red, quads.green_red, quads.green_blue, quads.blue
    guessed = decode_srgb(menon_unrefined(Quads(*(encode_srgb(each) for each in (r, gr, gb, b)))))
    # Measured values stay exactly as they are.
    guessed[0, 0, 0], guessed[1, 0, 1], guessed[1, 1, 0], guessed[2, 1, 1] = r, gr, gb, b
    return guessed


METHODS: dict[str, Callable[[Quads], Floats]] = {
    "nearest": nearest,
    "bilinear": bilinear,
    "malvar": malvar,
    "menon-unrefined": menon_unrefined,
    "menon": menon,
    "menon-encoded": menon_encoded,
}
"""The methods by name, in the order of their work."""


def demosaic(cfa: ArrayLike, pattern: str = "RGGB", method: str = "bilinear") -> Floats:
    """A full-colour picture (H, W, 3) from a mosaic (H, W).

    The mosaic is mirrored at its borders, so that a flat colour survives: to the last bit with
    `nearest`, `bilinear` and `malvar`, to a few units in the last place with the others. The
    gradient-corrected methods can overshoot: clip before showing. A mosaic of a single row or
    column is interpolated along it; a colour that it lacks is the mean of those that it has, so
    that a single pixel becomes grey. Values that are not finite spread to the pixels estimated from
    them, without a warning.

    Raises
    ------
    ValueError
        For a mosaic that is empty or not of two dimensions, an unknown pattern or method.
    """
    values = as_floats(cfa)
    if values.ndim != 2 or 0 in values.shape:
        raise ValueError(f"mosaic of shape {values.shape}; legal: (H, W), not empty")
    require_one_of("method", method, METHODS)
    if min(values.shape) == 1:
        return _demosaic_line(values, pattern, method)
    with np.errstate(over="ignore", invalid="ignore"):
        planes = METHODS[method](to_quads(values, pattern))
    return from_quads(planes, values.shape, pattern)


def _demosaic_line(cfa: Floats, pattern: str, method: str) -> Floats:
    """A mosaic one pixel high or wide, which holds at most two colours."""
    filters = filter_colours(cfa.shape[0], cfa.shape[1], pattern).reshape(-1)
    line, places = cfa.reshape(-1), np.arange(cfa.size)
    rgb = np.empty((cfa.size, 3), cfa.dtype)
    present = sorted(set(filters.tolist()))
    for colour in present:
        known = places[filters == colour]
        at = known[np.abs(places[:, None] - known).argmin(1)] if method == "nearest" else places
        rgb[:, colour] = np.interp(at, known, line[known])
    for colour in set(range(3)).difference(present):
        rgb[:, colour] = rgb[:, present].mean(axis=1)
    return rgb.reshape(*cfa.shape, 3)
