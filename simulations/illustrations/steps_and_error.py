"""Two methods to invert a lens: cost and error after each step."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import circle, dot, polyline
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.distortion.undistortion import undistort_fixed_point, undistort_newton

PLOT = Plot(Axis(0.8, 24, 62, 388, log=True), Axis(1e-17, 0.1, 236, 12, log=True))
"""Number of polynomials evaluated, and the largest error in focal lengths."""
LENS = Distortion(k1=-0.15)
STEPS = {"fixed point": (1, 2, 3, 5, 8, 12, 20), "Newton": (1, 2, 3, 4)}
POLYNOMIALS = {"fixed point": lambda steps: steps, "Newton": lambda steps: 1 + 2 * steps}
"""Number of polynomials that steps evaluate: Newton's need the slope too, and start from the
first-order inverse."""


def points() -> list[tuple[int, float, str]]:
    """Cost, error and method of each number of steps."""
    ideal = np.stack([np.linspace(0, 0.9, 91), np.zeros(91)], axis=-1)
    distorted = distort(ideal, LENS)
    found = []
    for name, method in (("fixed point", undistort_fixed_point), ("Newton", undistort_newton)):
        for steps in STEPS[name]:
            error = float(np.abs(method(distorted, LENS, steps) - ideal).max())
            found.append((POLYNOMIALS[name](steps), max(error, PLOT.y.low), name))
    return found


def front() -> list[tuple[int, float, str]]:
    """The Pareto front of cost and error."""
    every = points()
    beaten = [p for p in every for q in every if q != p and q[0] <= p[0] and q[1] <= p[1]]
    return sorted(p for p in every if p not in beaten)


def draw() -> Illustration:
    best = front()
    stairs = [PLOT.at(cost, error) for cost, error, _ in best]
    marks = [
        PLOT.frame(Scale(tick_style="muted small"), Scale(ticks=5, tick_style="muted small")),
        polyline(stairs, "image bold"),
    ]
    for cost, error, name in points():
        style = "image" if (cost, error, name) in best else "muted"
        place = PLOT.at(cost, error)
        newton = name == "Newton"
        marks.append(dot(place, style, 4.5) if newton else circle(place, 4.5, f"{style} hollow"))
    marks += [
        label((PLOT.x.end, PLOT.y.start + 36), "polynomials worked out", "muted small", "end"),
        label((PLOT.x.end, 24), "largest error", "muted small", "end"),
        dot((84, 196), "image", 4.5),
        label((96, 200), "Newton", ""),
        circle((84, 216), 4.5, "image hollow"),
        label((96, 220), "fixed point", ""),
    ]
    words = "Error over cost of undoing a barrel lens, on logarithmic axes: " + "; ".join(
        f"{name}, {cost} polynomials, {error:.0e}" for cost, error, name in best
    )
    return Illustration(
        (Panel("plot", "", 400.0, 284.0, overlay="".join(marks)),),
        f"{words}. These are on the front.",
    )
