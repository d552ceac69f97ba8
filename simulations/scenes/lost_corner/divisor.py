"""The plot of w at P, by which the homography divides, against the amount."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.scenes._mapped_square import family

WIDTH, HEIGHT = 400.0, 340.0
PLOT = Plot(Axis(0.0, 100.0, 46.0, 386.0), Axis(-1.0, 2.0, 290.0, 36.0))
SCALES = (Scale("amount", ticks=(0.0, 50.0, 100.0)), Scale("w", ticks=(0.0, 1.0)))


def w_at(H: Floats, point: Floats) -> float:
    """The third coordinate of the image of a point (2,), before the division."""
    return float(H[2] @ [*point, 1.0])


def draw(amount: float, H: Floats, point: Floats) -> str:
    """SVG markup of the panel."""
    amounts = np.arange(101.0)
    along = family.way("projective")[:, 2] @ [*point, 1.0]
    w = w_at(H, point)
    return "".join(
        (
            PLOT.region(y=(PLOT.y.low, 0.0), style="error fill faint"),
            PLOT.frame(*SCALES),
            PLOT.level(0.0, "error dashed"),
            PLOT.drop(amount, w, "muted thin dashed"),
            label(
                (PLOT.x.start + 10.0, PLOT.y.start - 10.0), "past infinity", "error small ground"
            ),
            PLOT.curve(amounts, along, "image bold"),
            PLOT.mark(amount, w, "image"),
        )
    )
