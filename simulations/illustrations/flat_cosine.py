"""One rounding step, converted to an angle: wide where the cosine is flat, narrow on the sine."""

import math

import numpy as np

from simulations.engine.drafting import dimension, label
from simulations.engine.drawing import line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot

PLOT = Plot(Axis(0.0, 1.0, 30, 306), Axis(0.0, 1.1, 178, 10))
STEP = 0.08  # width of a rounding step, drawn coarse


def angles(kind: str) -> tuple[float, float]:
    """The range of angles in radians that round to the same value as 0.1, and as 0."""
    if kind == "cosine":
        return 0.0, math.acos(1 - STEP)
    return 0.0, math.asin(STEP)


def _panel(kind: str, values: np.ndarray, band: tuple[float, float], title: str) -> Panel:
    theta = np.linspace(0.0, 1.0, 201)
    low, high = angles(kind)
    foot, end = PLOT.y.start, PLOT.at(high, 0)[0]
    marks = [
        PLOT.region(y=band, style="error fill thin"),
        PLOT.axes(),
        PLOT.curve(theta, values, "image bold"),
        line((end, foot), PLOT.at(high, band[0] if kind == "cosine" else band[1]), "error dashed"),
        dimension((PLOT.at(low, 0)[0], foot + 12), (end, foot + 12), "error"),
        label((end + 10, foot + 17), f"θ from 0 to {high:.2f}", "error"),
        label((PLOT.x.end, foot + 17), "θ", "muted italic", "end"),
        label((PLOT.x.end, foot + 44), f"one step of {STEP:g}, read back", "muted small", "end"),
    ]
    return Panel(kind, title, 320.0, 230.0, overlay="".join(marks))


def draw() -> Illustration:
    theta = np.linspace(0.0, 1.0, 201)
    panels = (
        _panel("cosine", np.cos(theta), (1 - STEP, 1.0), "From the cosine"),
        _panel("sine", np.sin(theta), (0.0, STEP), "From the sine"),
    )
    words = (
        f"A band {STEP:g} wide, the step of a coarse rounding, at the start of the cosine and of "
        f"the sine. On the cosine all angles up to {angles('cosine')[1]:.2f} radians lie in it, on "
        f"the sine those up to {angles('sine')[1]:.2f}."
    )
    return Illustration(panels, words)
