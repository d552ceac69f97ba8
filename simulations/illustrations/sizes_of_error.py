"""Sizes of errors, from a visible one down to the last bit, on one axis."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis

WIDTH, HEIGHT, FOOT = 400.0, 286.0, 250.0
AXIS = Axis(1e-17, 1.0, 16, 388, log=True)
SIZES = (
    (0.1, "a tenth of the range, 20 dB", "error"),
    (0.01, "the least difference in light that an eye sees", "light"),
    (0.5 / 255, "rounding to 8 bits", "image"),
    (0.5 / 4095, "rounding to 12 bits", "image"),
    (float(np.spacing(np.float32(1))) / 2, "float32, half a last digit", "camera"),
    (float(np.spacing(1.0)) / 2, "float64, half a last digit", "camera"),
)
"""Each error as a share of the range, its name and colour."""


def draw() -> Illustration:
    marks = [line((AXIS.start, FOOT), (AXIS.end, FOOT), "muted")]
    for power in range(-16, 1, 4):
        x = AXIS.place(10.0**power)
        name = "1" if power == 0 else f"10^{{−{-power}}}"
        marks.append(line((x, FOOT), (x, FOOT + 5), "muted"))
        marks.append(label((x, FOOT + 22), name, "muted small", "middle"))
    for row, (size, name, role) in enumerate(SIZES):
        x, y = AXIS.place(size), 26.0 + 34 * row
        marks.append(line((x, y + 4), (x, FOOT), f"{role} thin"))
        marks.append(dot((x, FOOT), role, 4.5))
        side, anchor = (-8, "end") if x > 200 else (8, "start")
        marks.append(label((x + side, y + 8), name, role, anchor))
    words = "Errors as shares of a range, on a logarithmic axis: " + "; ".join(
        f"{name}, {size:.0e}" for size, name, _ in SIZES
    )
    return Illustration((Panel("axis", "", WIDTH, HEIGHT, overlay="".join(marks)),), f"{words}.")
