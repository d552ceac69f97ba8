"""A result and its data: the error of the one, and the step of the other that would explain it."""

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.distortion import radial_profile
from simulations.models.distortion.radial_profile import RadialProfile, evaluate

LENS = RadialProfile((-0.3,))
PLOT = Plot(Axis(0.6, 0.71, 46, 390), Axis(0.68, 1.07, 222, 12))
RIGHT, COMPUTED = 0.90, 0.97
"""Ideal radii: the right one, and one that a program found."""


def draw() -> Illustration:
    radii = np.linspace(0.7, float(radial_profile.fold_radius(LENS)), 200)
    data, explained = (float(evaluate(LENS, np.array(r))) for r in (RIGHT, COMPUTED))
    foot, left = PLOT.y.start, PLOT.x.start
    marks = [PLOT.frame(Scale(ticks=()), Scale(ticks=()))]
    for seen, ideal, role in ((data, RIGHT, "image"), (explained, COMPUTED, "error")):
        spot = PLOT.at(seen, ideal)
        marks.append(line((spot[0], foot), spot, f"{role} thin dashed"))
        marks.append(line((left, spot[1]), spot, f"{role} thin dashed"))
    marks.append(PLOT.curve(evaluate(LENS, radii), radii, "camera bold"))
    marks += [
        dot(PLOT.at(data, RIGHT), "image", 5.0),
        dot(PLOT.at(explained, COMPUTED), "error", 5.0),
    ]
    (low_x, low_y), (high_x, high_y) = PLOT.at(data, RIGHT), PLOT.at(explained, COMPUTED)
    marks += [
        dimension((low_x, foot - 12), (high_x, foot - 12), "muted"),
        label((low_x - 8, foot - 8), "backward error", "small", "end"),
        dimension((left + 12, high_y), (left + 12, low_y), "muted"),
        label((left + 22, (low_y + high_y) / 2 + 4), "forward error", "small"),
        label((PLOT.x.end, foot + 20), "data: where the point is seen", "muted small", "end"),
        label((left + 6, 24), "result: its ideal radius", "muted small"),
        label((low_x + 10, low_y + 18), "right", "image small"),
        label((high_x - 10, high_y - 8), "computed", "error small", "end"),
    ]
    words = (
        f"The ideal radius over the radius that is seen, for k1 = {LENS.numerator[0]:g}; "
        f"the curve grows steeper to the right. A point seen at {data:.3f} belongs at {RIGHT:.2f}, "
        f"and {COMPUTED:.2f} was computed: an error of {COMPUTED - RIGHT:.2f}. That would be right "
        f"for a point seen at {explained:.3f}, which is only {explained - data:.3f} away."
    )
    return Illustration((Panel("plot", "", 400.0, 250.0, overlay="".join(marks)),), words)
