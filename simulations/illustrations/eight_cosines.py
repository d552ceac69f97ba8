"""The eight waves by which JPEG represents a row of eight values."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot
from simulations.models.arrays import Floats
from simulations.models.compression.blocks import BLOCK, DCT

COLUMNS, PITCH, ROW = 4, 98.0, 100.0


def samples(u: int) -> Floats:
    """The pattern of frequency ``u``, scaled to a height of 1 between its samples."""
    return DCT[u] / math.sqrt((1 if u == 0 else 2) / BLOCK)


def draw() -> Illustration:
    x = np.linspace(-0.5, BLOCK - 0.5, 161)
    marks = []
    for u in range(BLOCK):
        left, top = 10 + PITCH * (u % COLUMNS), 8 + ROW * (u // COLUMNS)
        plot = Plot(Axis(-0.5, BLOCK - 0.5, left, left + 82), Axis(-1, 1, top + 60, top))
        marks += [
            line(plot.at(-0.5, 0), plot.at(BLOCK - 0.5, 0), "muted thin"),
            plot.curve(x, np.cos(math.pi * u * (x + 0.5) / BLOCK), "image"),
            *(dot(plot.at(n, float(value)), "image", 2.8) for n, value in enumerate(samples(u))),
            label((left + 41, top + 82), f"u = {u}", "muted small", "middle"),
        ]
    words = (
        f"Eight cosines over a row of {BLOCK} values, each sampled at the middle of every value. "
        "The first is constant; each of the others has half a wave more than the one before."
    )
    return Illustration((Panel("waves", "", 400.0, 206.0, overlay="".join(marks)),), words)
