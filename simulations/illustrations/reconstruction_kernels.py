"""The bumps of five interpolations, and a piece of a picture that each has enlarged."""

import numpy as np

from simulations.engine.drafting import label, picture
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.sampling.resampling import KERNELS, sample
from simulations.pictures.round_windows import places, rings

WIDTH, HEIGHT, SIDE = 190.0, 338.0, 160.0
PLOT = Plot(Axis(-3.3, 3.3, 6, 184), Axis(-0.22, 1.08, 140, 10))
TITLES = {
    "nearest": "Nearest",
    "bilinear": "Triangle",
    "bicubic": "Keys’ cubic",
    "spline": "B-spline",
    "lanczos3": "Lanczos 3",
}
PIECE, TIMES = 12, 12
"""Pixels along a side of the piece, and how often it is enlarged."""


def enlarged(kernel: str) -> Floats:
    """(144, 144) a piece of the rings with waves of about four pixels."""
    along = (np.arange(PIECE * TIMES) + 0.5) / TIMES - 0.5
    place = np.stack(np.meshgrid(along + 83, along + 33), axis=-1)
    return sample(rings(*places()), place, kernel)


def draw() -> Illustration:
    panels = []
    x = np.linspace(-3.3, 3.3, 1321)
    whole = np.arange(-3, 4, dtype=float)
    for name, title in TITLES.items():
        kernel = KERNELS[name]
        taps = f"{kernel.taps}×{kernel.taps} samples"
        weights, samples = kernel.weigh(x), kernel.weigh(whole)
        marks = [
            line(PLOT.at(-3.3, 0), PLOT.at(3.3, 0), "muted thin"),
            PLOT.curve(x, weights, "ray bold"),
            *(dot(PLOT.at(*place), "image", 3.2) for place in zip(whole, samples, strict=True)),
            label((WIDTH / 2, 164), taps, "muted", "middle"),
            picture(((WIDTH - SIDE) / 2, HEIGHT - SIDE), SIDE, SIDE, to_rgba8(enlarged(name))),
        ]
        panels.append(Panel(name, title, WIDTH, HEIGHT, overlay="".join(marks)))
    return Illustration(
        tuple(panels),
        "The weight of a sample over its distance in pixels, for five kernels, and below each the "
        "same fine arcs, enlarged: squares with the nearest pixel, beads with the triangle, a "
        "little beaded with the cubic, smooth with B-spline and Lanczos.",
    )
