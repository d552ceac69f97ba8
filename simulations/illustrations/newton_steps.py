"""Newton's steps back through a barrel lens: each follows the tangent to the wanted height."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line, path
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.distortion.radial_profile import RadialProfile, evaluate, slope

PLOT = Plot(Axis(0.62, 1.06, 40, 392), Axis(0.55, 0.72, 226, 14))
LENS = RadialProfile((-0.3,))
DISTORTED, STEPS = 0.68, 4
"""The distorted radius, and the number of steps drawn."""


def guesses() -> list[float]:
    """The first guess, which is the distorted radius, and the following ones."""
    found = [DISTORTED]
    for _ in range(STEPS):
        r = found[-1]
        found.append(r - (float(evaluate(LENS, r)) - DISTORTED) / float(slope(LENS, r)))
    return found


def draw() -> Illustration:
    radii = np.linspace(0.62, 1.06, 200)
    found = guesses()
    foot, target = PLOT.y.start, PLOT.at(0.62, DISTORTED)[1]
    marks = [
        PLOT.axes(),
        PLOT.x_axis(Scale(ticks=(0.7, 0.8, 0.9), tick_style="muted small")),
        PLOT.y_axis(Scale(ticks=(0.55, 0.6, 0.65, 0.7), tick_style="muted small")),
        line((PLOT.x.start, target), (PLOT.x.end, target), "image dashed"),
        PLOT.curve(radii, evaluate(LENS, radii), "camera bold"),
    ]
    for index, r in enumerate(found[:-1]):
        height = float(evaluate(LENS, r))
        marks.append(
            path([[(PLOT.at(r, DISTORTED)[0], foot), PLOT.at(r, height)]], "muted thin dashed")
        )
        if index < 3:
            marks.append(line(PLOT.at(r, height), PLOT.at(found[index + 1], DISTORTED), "ray"))
            marks.append(dot(PLOT.at(r, height), "ray", 4))
            side, anchor = (-5, "end") if index == 2 else (5, "start")
            marks.append(
                label((PLOT.at(r, DISTORTED)[0] + side, foot - 8), f"r_{index}", "italic", anchor)
            )
    root = PLOT.at(found[-1], DISTORTED)
    marks += [
        dot(root, "image", 4.5),
        label((PLOT.x.start + 8, target - 8), f"seen: r_d = {DISTORTED:g}", "image"),
        label((root[0] + 10, foot - 8), f"r = {found[-1]:.3f}", "image ground"),
        label((PLOT.x.end, foot + 18), "ideal radius r", "muted small", "end"),
    ]
    words = (
        f"The distorted radius against the ideal one, for k1 = −0.3, and a line at {DISTORTED:g}. "
        "From the first guess the tangent is followed up to that line, which gives the second "
        "guess: " + ", ".join(f"{r:.4f}" for r in found) + "."
    )
    return Illustration((Panel("plot", "", 400.0, 282.0, overlay="".join(marks)),), words)
