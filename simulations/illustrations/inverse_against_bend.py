"""Error of two ways to invert a barrel lens, at one radius, against the strength of the barrel."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.distortion.undistortion import undistort_fixed_point, undistort_newton

RADIUS, STEPS = 0.9, 5
"""The ideal radius at which the error is taken, and the steps of both methods."""
K1: Floats = np.linspace(-0.41, -0.02, 79)
"""From a lens that folds just beyond the radius to a weak one."""
PLOT = Plot(Axis(-0.43, 0.0, 62, 392), Axis(1e-16, 1.0, 226, 14, log=True))


def errors() -> tuple[Floats, Floats]:
    """(79,) each: error of the radius by the fixed point and by Newton's method."""
    lenses = [Distortion(k1=float(k1)) for k1 in K1]
    distorted = [distort((RADIUS, 0.0), lens) for lens in lenses]
    pairs = list(zip(distorted, lenses, strict=True))
    fixed = [undistort_fixed_point(point, lens, STEPS)[0] for point, lens in pairs]
    newton = [undistort_newton(point, lens, STEPS)[0] for point, lens in pairs]
    return np.abs(np.array(fixed) - RADIUS), np.abs(np.array(newton) - RADIUS)


def draw() -> Illustration:
    fixed, newton = (np.maximum(found, PLOT.y.low) for found in errors())
    (x, y), (_, low) = PLOT.at(-0.2, fixed[42]), PLOT.at(-0.2, newton[42])
    marks = (
        PLOT.axes(),
        PLOT.x_axis(Scale(ticks=(-0.4, -0.3, -0.2, -0.1, 0), tick_style="muted small")),
        PLOT.y_axis(Scale(ticks=4, tick_style="muted small")),
        PLOT.curve(K1, fixed, "error bold"),
        PLOT.curve(K1, newton, "camera bold"),
        label((x, y - 14), f"fixed point, {STEPS} steps", "error"),
        label((x, low - 12), f"Newton, {STEPS} steps", "camera"),
        label((PLOT.x.end, 26), "error of r", "muted small", "end"),
        label((PLOT.x.end, PLOT.y.start + 34), "k_1", "muted small italic", "end"),
    )
    words = (
        f"The error of the ideal radius {RADIUS:g} after {STEPS} steps against k1, on a "
        f"logarithmic scale. At k1 = {K1[42]:.2f} the fixed point is off by {fixed[42]:.4f}. "
        f"Newton's method is exact to rounding as far as {K1[newton < 1e-12].min():.2f}, off by "
        f"{newton[0]:.4f} at {K1[0]:.2f}."
    )
    return Illustration((Panel("plot", "", 400.0, 272.0, overlay="".join(marks)),), words)
