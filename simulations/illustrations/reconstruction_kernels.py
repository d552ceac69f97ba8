"""The bumps of five interpolations, from the flat square to Lanczos's window."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot
from simulations.models.sampling.resampling import KERNELS

WIDTH, HEIGHT = 190.0, 170.0
PLOT = Plot(Axis(-3.3, 3.3, 6, 184), Axis(-0.22, 1.08, 140, 10))
TITLES = {
    "nearest": "Nearest",
    "bilinear": "Triangle",
    "bicubic": "Keys’ cubic",
    "spline": "B-spline",
    "lanczos3": "Lanczos 3",
}


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
            label((WIDTH / 2, HEIGHT - 6), taps, "muted", "middle"),
        ]
        panels.append(Panel(name, title, WIDTH, HEIGHT, overlay="".join(marks)))
    words = "The weight of a sample over its distance in pixels, for five kernels: " + ", ".join(
        f"{TITLES[name]} ({KERNELS[name].taps} samples along each axis)" for name in TITLES
    )
    return Illustration(tuple(panels), f"{words}. Dots mark the weights at whole distances.")
