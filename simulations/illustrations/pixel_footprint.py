"""Cells nearly as wide as a stripe: their means form a weak false wave."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot
from simulations.models.arrays import Floats
from simulations.models.sampling.aliasing import alias_frequency, box_mtf
from simulations.models.sampling.prefilters import filtered_wave, prefilter

WIDTH, HEIGHT, CELLS = 400.0, 214.0, 10
PLOT = Plot(Axis(-0.5, CELLS - 0.5, 12, 388), Axis(-1.15, 1.15, 176, 14))
FREQUENCY = 0.8  # cycles per cell


def cell_means() -> Floats:
    """The value of each cell: the mean of the wave over its width."""
    return filtered_wave(prefilter("box"), np.arange(CELLS, dtype=float), FREQUENCY).real


def draw() -> Illustration:
    x = np.linspace(-0.5, CELLS - 0.5, 500)
    passed, seen = float(box_mtf(FREQUENCY)), abs(float(alias_frequency(FREQUENCY)))
    found = f"what is seen: {seen:g} per cell, contrast {passed:.2f}"
    marks = [PLOT.curve(x, np.cos(2 * np.pi * FREQUENCY * x), "world thin")]
    for n, mean in enumerate(cell_means()):
        marks.append(PLOT.region((n - 0.5, n + 0.5), (0, mean), "image fill thin"))
        marks.append(dot(PLOT.at(n, float(mean)), "image", 3.5))
    marks += [PLOT.upright(edge - 0.5, "muted thin faint") for edge in range(CELLS + 1)]
    marks += [
        PLOT.curve(x, passed * np.cos(2 * np.pi * seen * x), "error bold dashed"),
        line(PLOT.at(-0.5, 0), PLOT.at(CELLS - 0.5, 0), "muted thin"),
        label((12, HEIGHT - 8), f"stripes, {FREQUENCY:g} per cell", "world"),
        label((388, HEIGHT - 8), found, "error", "end"),
    ]
    words = (
        f"A wave of {FREQUENCY:g} cycles per cell over {CELLS} cells. The means of the cells are "
        f"small: they lie on a wave of {seen:g} cycles per cell with {passed:.2f} of the height."
    )
    return Illustration((Panel("row", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
