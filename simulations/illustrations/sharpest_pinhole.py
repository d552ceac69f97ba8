"""How wide the spot of a pinhole is: the hole itself, or the spread of light behind a small one.

Airy's disc is 2.44 λ f / A wide. Szeliski, 2nd ed., §2.2.3; E. Hecht, *Optics*, §10.2.
"""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.frame import Panel
from simulations.engine.illustration import Illustration
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats

WIDTH, HEIGHT = 400.0, 272.0
PLOT = Plot(Axis(0.02, 4.0, 54, 388, log=True), Axis(0.05, 7.0, 224, 12, log=True))
"""Diameters of hole and spot in millimetres."""
DISTANCE_MM, WAVELENGTH_MM = 100.0, 550e-6


def spread_mm(hole_mm: Floats | float) -> Floats:
    """What diffraction makes of the light of a point: the width of Airy's disc."""
    return np.asarray(2.44 * WAVELENGTH_MM * DISTANCE_MM / np.asarray(hole_mm))


def sharpest_mm() -> float:
    """The hole whose own width and whose spread are equal."""
    return math.sqrt(2.44 * WAVELENGTH_MM * DISTANCE_MM)


def draw() -> Illustration:
    holes = np.geomspace(0.02, 4.0, 300)
    best = sharpest_mm()
    small, large = holes[holes <= best], holes[holes >= best]
    marks = [
        PLOT.frame(Scale(tick_style="muted small"), Scale(tick_style="muted small")),
        line(PLOT.at(best, 0.05), PLOT.at(best, best), "muted thin dashed"),
        PLOT.curve(holes, spread_mm(holes), "light thin dashed"),
        PLOT.curve(holes, holes, "ray thin dashed"),
        PLOT.curve(small, spread_mm(small), "light bold"),
        PLOT.curve(large, large, "ray bold"),
        dot(PLOT.at(best, best), "camera", 5),
        label((PLOT.at(0.062, 1)[0], 30), "light spreads:", "light"),
        label((PLOT.at(0.062, 1)[0], 47), "2.44 λ f / A", "light italic"),
        label((PLOT.x.end, PLOT.at(1, 0.6)[1]), "rays go straight:", "ray", "end"),
        label((PLOT.x.end, PLOT.at(1, 0.6)[1] + 17), "A", "ray italic", "end"),
        label((PLOT.at(best, 1)[0] + 8, PLOT.y.start - 10), f"{best:.2f} mm", "camera"),
        label((PLOT.x.end, HEIGHT - 8), "width A of the hole, mm", "muted small", "end"),
        label((61, PLOT.at(1, 0.062)[1]), "spot, mm", "muted small"),
    ]
    words = (
        f"The width of the spot that a pinhole {DISTANCE_MM:g} mm from the sensor makes of a "
        f"point, over the width of the hole, on logarithmic axes. Holes wider than {best:.2f} mm "
        "make spots as wide as themselves. Narrower ones make wider spots, the narrower the "
        "wider, by diffraction of green light."
    )
    return Illustration((Panel("plot", "", WIDTH, HEIGHT, overlay="".join(marks)),), words)
