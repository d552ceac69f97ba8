"""An error of half a code in RMS, as a screen shows it and magnified."""

import numpy as np

from simulations.engine.drafting import picture
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.pictures.balloon import balloon

RMS_CODES, MAGNIFIED = 0.5, 32
SHOWN = 190.0  # width of a panel
ROWS, COLUMNS = slice(10, 90), slice(100, 200)  # of the balloon


def codes() -> Floats:
    """(H, W, 3) codes of 255 of the balloon, not rounded."""
    return 255.0 * encode_srgb(balloon().astype(float))


def slope() -> Floats:
    """Change of the codes from a pixel to the next."""
    return np.asarray(np.gradient(codes(), axis=1))


def moved_px() -> float:
    """How far the picture has to move for that error: for so short a way the error is the slope
    times the way."""
    return RMS_CODES / root_mean_square(slope())


def draw() -> Illustration:
    error = moved_px() * slope()
    pictures = {
        "The picture": codes(),
        f"Moved by {moved_px():.3f} px": codes() + error,
        f"The error, × {MAGNIFIED}": 127.5 + MAGNIFIED * error,
    }
    height = 0.8 * SHOWN
    panels = tuple(
        Panel(
            f"part-{number}",
            title,
            SHOWN,
            height,
            overlay=picture((0.0, 0.0), SHOWN, height, to_rgba8(shown[ROWS, COLUMNS] / 255.0)),
        )
        for number, (title, shown) in enumerate(pictures.items())
    )
    return Illustration(
        panels,
        f"A striped balloon; the same moved by {moved_px():.3f} pixels, which nobody can tell "
        f"apart; and their difference, {MAGNIFIED} times enlarged, in which all edges stand out.",
    )
