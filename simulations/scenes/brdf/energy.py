"""The curve of the BRDF figure: the reflected share of the light by angle of incidence."""

from functools import cache

import numpy as np

from simulations.engine.drawing import Point, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.light.brdf import schlick
from simulations.scenes.brdf.stages import INCIDENCE_DEG

PLOT = Plot(Axis(0.0, 90.0, 46.0, 384.0), Axis(0.0, 1.5, 280.0, 30.0))
ANGLES = Scale("angle of the light from the normal", "°", ticks=(0, 45, 90), style="light")
SHARES = Scale(ticks=(0, 1))


def at(angle_deg: float, share: float) -> tuple[float, float]:
    """View box units, clamped to the panel."""
    return PLOT.clamped(angle_deg, share)


def angle_at(place: Point) -> float:
    """Angle of the light at a place of the panel: 0 to 90 degrees."""
    return min(max(PLOT.values(place)[0], 0.0), 90.0)


def energy_plot(curve: Floats, angle_deg: float, sent: float, head_on: float | None) -> str:
    """The reflected share (23,), that of a smooth facet, and the present light."""
    within = "error bold" if float(curve.max()) > 1.0 else "ray bold"
    return "".join(
        (
            _ground(),
            "" if head_on is None else _facet(head_on, float(curve[0])),
            PLOT.curve(INCIDENCE_DEG, curve, within),
            PLOT.drop(angle_deg, sent, "light thin"),
            PLOT.mark(angle_deg, sent, "light"),
        )
    )


def _facet(head_on: float, share: float) -> str:
    """The share of a smooth facet; its name keeps clear of the curve, which begins at ``share``."""
    below = head_on > 0.12 and 0.0 <= share - head_on < 0.16
    fine = np.linspace(0.0, 90.0, 46)
    x, y = at(0.0, head_on)
    return PLOT.curve(fine, schlick(np.cos(np.radians(fine)), head_on), "image thin dashed") + text(
        (x + 8, y + (15 if below else -6)), "F(θ) of one facet", "image small ground"
    )


@cache
def _ground() -> str:
    x, y = at(0, 1)
    return "".join(
        (
            PLOT.region(y=(1.0, 1.5), style="error fill faint"),
            PLOT.level(1.0, "error thin dashed"),
            PLOT.frame(ANGLES, SHARES),
            text((x + 8, y - 7), "more than arrives", "error small ground"),
        )
    )
