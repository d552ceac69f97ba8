"""The plot: both errors and the bound by distance from the singularity, on log–log axes."""

from collections.abc import Mapping

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import Point, dot
from simulations.engine.frame import power_of_ten
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.scenes.stability.errors import DISTANCES, Errors
from simulations.scenes.stability.settings import LOWEST, STEP, Settings

WIDTH, HEIGHT = 400.0, 316.0
PLOT = Plot(Axis(10.0**LOWEST, 1.0, 54.0, 388.0, log=True), Axis(1e-17, 1.0, 232.0, 30.0, log=True))
LEGEND_LEFT = 14.0
ACROSS: Mapping[str, str] = {
    "angle": "angle θ, in rad",
    "blur": "distance from the focus, |Z − s| / s",
    "origin": "10 m / distance from the origin",
    "fold": "short of the largest radius, 1 − r_d / r_{d,max}",
}
CURVE_NAMES: Mapping[str, tuple[str, str]] = {
    "angle": ("arccosine", "arctangent"),
    "blur": ("1/Z − 1/s", "(s − Z) / s Z"),
    "origin": ("R p + t", "R (p − c)"),
    "fold": ("5 Newton steps", "60 steps"),
}
"""Names of the two curves."""
X_TICKS, Y_TICKS = (
    [(10.0**power, power_of_ten(power) if power else "1") for power in powers]
    for powers in ((-12, -8, -4, 0), (-16, -8, 0))
)
UNITS_OF_ROUNDING = 8
"""Errors of at most so many units u are drawn as one, as they differ by machine."""
PER_DECADE = 10
"""Heights that a curve can have."""


def unit_of(digits: str) -> float:
    """u, half the spacing of the numbers just above 1."""
    return float(np.finfo(np.dtype(digits)).eps) / 2


def place_of(settings: Settings) -> int:
    """Index into `DISTANCES` of the marked one."""
    return round((settings.power - LOWEST) / STEP)


def shown(errors: Floats, digits: str) -> Floats:
    """Errors (n,) as drawn: see `UNITS_OF_ROUNDING` and `PER_DECADE`."""
    floored = np.maximum(errors, UNITS_OF_ROUNDING * unit_of(digits))
    return np.asarray(10.0 ** (np.rint(PER_DECADE * np.log10(floored)) / PER_DECADE))


def mark(settings: Settings, errors: Errors) -> Point | None:
    """The handle on the curve as written; None if it has no value."""
    at = place_of(settings)
    error = shown(errors.written, settings.digits)[at]
    return PLOT.at(float(DISTANCES[at]), float(error)) if np.isfinite(error) else None


def power_at(place: Point) -> float:
    """Power of ten of the distance at a place, clamped to the axis."""
    across = min(max(float(place[0]), PLOT.x.start), PLOT.x.end)
    return float(np.log10(PLOT.x.value(across)))


def draw(settings: Settings, errors: Errors) -> str:
    written, rearranged = CURVE_NAMES[settings.formula]
    place = mark(settings, errors)
    entries = [
        Entry(written, "error bold"),
        Entry(rearranged, "image bold"),
        Entry("rounded inputs", "muted dashed"),
    ]
    rounding = UNITS_OF_ROUNDING * unit_of(settings.digits)
    return "".join(
        (
            PLOT.region(y=(PLOT.y.low, rounding)),
            PLOT.frame(
                Scale(
                    ACROSS[settings.formula], ticks=X_TICKS, tick_style="muted small", style="small"
                ),
                Scale("relative error", ticks=Y_TICKS, tick_style="muted small", style="small"),
            ),
            PLOT.curve(DISTANCES, errors.bound, "muted dashed"),
            PLOT.curve(DISTANCES, shown(errors.rearranged, settings.digits), "image bold"),
            PLOT.curve(DISTANCES, shown(errors.written, settings.digits), "error bold"),
            PLOT.upright(float(DISTANCES[place_of(settings)]), "world thin"),
            dot(place, "world", 5) if place else "",
            label((PLOT.x.end - 6, PLOT.y.start - 6), "rounding", "muted small ground", "end"),
            legend((LEGEND_LEFT, 304), entries, "small", PLOT.x.end - LEGEND_LEFT),
        )
    )
