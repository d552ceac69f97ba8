"""A square grid without distortion, and through three lenses: barrel, pincushion, moustache."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion, distort

WIDTH, HEIGHT, UNITS = 190.0, 210.0, 76.0
LENSES = (
    ("ideal", "No distortion", 0.0, 0.0, 1.0),
    ("barrel", "Barrel", -0.15, 0.0, 1.0),
    ("pincushion", "Pincushion", 0.15, 0.0, 1.0),
    ("moustache", "Moustache", -0.5, 0.21, 1.25),
)
"""Name, title, k1 and k2, and magnification."""
LINES = np.linspace(-0.9, 0.9, 7)
ALONG = np.linspace(-0.9, 0.9, 49)


def placed(points: Floats, k1: float, k2: float, zoom: float) -> Floats:
    """Points (n, 2) of the ideal image, distorted, in view box units."""
    seen = distort(points, Distortion(k1=k1, k2=k2))
    return np.array([WIDTH / 2, 94.0]) + zoom * UNITS * np.asarray(seen)


def _lines() -> list[Floats]:
    rows = [np.stack([ALONG, np.full_like(ALONG, c)], axis=-1) for c in LINES]
    return [*rows, *(row[:, ::-1] for row in rows)]


def draw() -> Illustration:
    panels = []
    for name, title, k1, k2, zoom in LENSES:
        lines = [placed(points, k1, k2, zoom) for points in _lines()]
        border = [lines[0], lines[-1], lines[6][::-1], lines[7][::-1]]
        formula = "k_1 = 0" if k1 == 0 else f"k_1 = {k1:+.2f}".replace("-", "−")
        if k2:
            formula += f", k_2 = {k2:+.2f}"
        marks = [
            polygon(np.concatenate(border), "image fill thin"),
            path(lines, "image"),
            label((WIDTH / 2, HEIGHT - 10), formula, "muted small", "middle"),
        ]
        panels.append(Panel(name, title, WIDTH, HEIGHT, overlay="".join(marks)))
    words = (
        "A square grid, ideal and through three lenses. The barrel pulls its corners in and bows "
        "its sides out, the pincushion does the opposite, and in the moustache the sides bend one "
        "way in the middle and back at the corners."
    )
    return Illustration(tuple(panels), words)
