"""Near Trouble: rounding errors of a formula, as written and rearranged.

A picture of the room goes through both, and shows what the errors do.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.drafting import label
from simulations.engine.drawing import dot
from simulations.engine.frame import Frame, Panel, Readout, format_number, power_of_ten
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.scenes.stability.errors import DISTANCES, LOWEST, STEP, Errors, errors_of, unit_of
from simulations.scenes.stability.pictures import COLUMNS, pictures

FORMULAS = {
    "angle": "Angle between two orientations",
    "blur": "Blur beside the focus",
    "origin": "Pixel, far from the origin",
    "fold": "Ideal radius, near the fold",
}
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
FORMATS = {"float64": "float64: 16 digits", "float32": "float32: 7 digits"}
UNITS_OF_ROUNDING = 8  # errors of at most so many u are drawn as one, as they differ by machine
PER_DECADE = 10  # heights that a curve can have

PLOT = Plot(Axis(10.0**LOWEST, 1.0, 54.0, 388.0, log=True), Axis(1e-17, 1.0, 232.0, 30.0, log=True))
X_TICKS, Y_TICKS = (
    [(10.0**power, power_of_ten(power) if power else "1") for power in powers]
    for powers in ((-12, -8, -4, 0), (-16, -8, 0))
)
LEGEND_LEFT = 14.0
WIDTH = 400.0


@dataclass(frozen=True, slots=True)
class Settings:
    formula: str = choice("Formula", FORMULAS)
    digits: str = choice("Numbers", FORMATS)
    power: float = slider("Distance", -4.0, LOWEST, 0.0, STEP, prefix="10^")

    @property
    def index(self) -> int:
        """Index into `DISTANCES` of the marked one."""
        return round((self.power - LOWEST) / STEP)


def rounded_errors(errors: Floats, digits: str) -> Floats:
    """Errors (n,) as drawn: see `UNITS_OF_ROUNDING` and `PER_DECADE`."""
    floored = np.maximum(errors, UNITS_OF_ROUNDING * unit_of(digits))
    return np.asarray(10.0 ** (np.rint(PER_DECADE * np.log10(floored)) / PER_DECADE))


def right_digits(error: float) -> str:
    """Right digits to a tenth; a text if there are no inputs."""
    return "no inputs" if math.isnan(error) else format_number(-math.log10(error), 1)


def mark_at(settings: Settings, outputs: Outputs) -> Point:
    """The mark on the curve as written, or where that has no value, at the top."""
    error = float(rounded_errors(outputs["errors"].written, settings.digits)[settings.index])
    return PLOT.at(float(DISTANCES[settings.index]), error if math.isfinite(error) else 1.0)


def power_at(_settings: Settings, place: Point) -> dict[str, float]:
    """The distance below the pointer: a search would compute pictures."""
    share = (place[0] - PLOT.x.start) / (PLOT.x.end - PLOT.x.start)
    return {"power": LOWEST * (1.0 - min(max(share, 0.0), 1.0))}


def error_plot(settings: Settings, errors: Errors) -> str:
    """Both errors and the bound by distance from the singularity."""
    names, digits = CURVE_NAMES[settings.formula], settings.digits
    entries = [
        Entry(names[0], "error bold"),
        Entry(names[1], "image bold"),
        Entry("rounded inputs", "muted dashed"),
    ]
    across, up = (
        Scale(name, ticks=ticks, tick_style="muted small", style="small")
        for name, ticks in ((ACROSS[settings.formula], X_TICKS), ("relative error", Y_TICKS))
    )
    marked = not math.isnan(errors.written[settings.index])
    return "".join(
        (
            PLOT.region(y=(PLOT.y.low, UNITS_OF_ROUNDING * unit_of(digits))),
            PLOT.frame(across, up),
            PLOT.curve(DISTANCES, errors.bound, "muted dashed"),
            PLOT.curve(DISTANCES, rounded_errors(errors.rearranged, digits), "image bold"),
            PLOT.curve(DISTANCES, rounded_errors(errors.written, digits), "error bold"),
            PLOT.upright(float(DISTANCES[settings.index]), "world thin"),
            dot(mark_at(settings, {"errors": errors}), "world", 5) if marked else "",
            label((PLOT.x.end - 6, PLOT.y.start - 6), "rounding", "muted small ground", "end"),
            legend((LEGEND_LEFT, 304), entries, "small", PLOT.x.end - LEGEND_LEFT),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture through both computations, their errors and the bound."""
    errors: Errors = outputs["errors"]
    both = [
        float(rounded_errors(curve, settings.digits)[settings.index])
        for curve in (errors.written, errors.rearranged)
    ]
    plot = error_plot(settings, errors)
    titles = (
        f"{name}: {right_digits(error)} right digits"
        for name, error in zip(CURVE_NAMES[settings.formula], both, strict=True)
    )
    first, second = (
        Panel(name, title, WIDTH, 300.0, raster, pixelated=True, lead=name == "written")
        for name, title, raster in zip(
            ("written", "rearranged"), titles, outputs["pictures"], strict=True
        )
    )
    return Frame(
        (first, second, Panel("plot", "Relative error", WIDTH, 316.0, overlay=plot)),
        (Readout("digits", "Right digits, as written", right_digits(both[0]), "", role="error"),),
        describe(settings, *both),
    )


def describe(settings: Settings, written: float, rearranged: float) -> str:
    """Both computations at the mark, in one sentence."""
    where = f"{FORMULAS[settings.formula]} in {settings.digits}"
    if math.isnan(written):
        return f"{where}: the format has no two numbers that close."
    names = CURVE_NAMES[settings.formula]
    power = format_number(settings.power, 2).rstrip("0").rstrip(".")
    distance = power_of_ten(int(settings.power)) if settings.power % 1 == 0 else f"10^{power}"
    return (
        f"{where}, at a distance of {distance} from trouble: {right_digits(written)} right digits "
        f"by {names[0]}, {right_digits(rearranged)} by {names[1]}."
    )


SCENE = Scene(
    "stability",
    "Near Trouble",
    Settings,
    draw,
    (Stage("errors", errors_of), Stage("pictures", pictures)),
    (
        Handle(
            "place",
            "plot",
            "Mark on the curve",
            drives=("power",),
            at=mark_at,
            pull=power_at,
            reach="press",
            role="world",
        ),
    ),
    accuracy=Accuracy(levels=columns(COLUMNS // 2, COLUMNS)),
)
