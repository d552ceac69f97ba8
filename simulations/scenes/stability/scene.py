"""Near Trouble: rounding errors of a formula, as written and rearranged."""

import math

from simulations.engine.frame import Frame, Panel, Readout, format_number, power_of_ten
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.scenes.stability import digits, plot
from simulations.scenes.stability.errors import Errors, errors_of
from simulations.scenes.stability.handles import HANDLES
from simulations.scenes.stability.settings import FORMULAS, Settings


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """Both errors and the bound, and the count of right digits at the mark."""
    errors: Errors = outputs["errors"]
    return Frame(
        panels=(
            Panel(
                "plot",
                "Relative error of two computations",
                plot.WIDTH,
                plot.HEIGHT,
                overlay=plot.draw(settings, errors),
                lead=True,
            ),
            Panel(
                "digits",
                "Right digits at the mark",
                digits.WIDTH,
                digits.HEIGHT,
                overlay=digits.draw(settings, errors),
            ),
        ),
        readouts=(
            Readout("digits", "Right digits, as written", _written(settings, errors), "", "error"),
        ),
        description=describe(settings, errors),
    )


def _written(settings: Settings, errors: Errors) -> str:
    return digits.right_digits(
        float(plot.shown(errors.written, settings.digits)[plot.place_of(settings)])
    )


def describe(settings: Settings, errors: Errors) -> str:
    """Both computations at the mark, in one sentence."""
    at = plot.place_of(settings)
    where = f"{FORMULAS[settings.formula]} in {settings.digits}"
    if math.isnan(errors.written[at]):
        return f"{where}: the format has no two numbers that close."
    written, rearranged = (
        digits.right_digits(float(plot.shown(each, settings.digits)[at]))
        for each in (errors.written, errors.rearranged)
    )
    names = plot.CURVE_NAMES[settings.formula]
    power = format_number(settings.power, 2).rstrip("0").rstrip(".")
    distance = power_of_ten(int(settings.power)) if settings.power % 1 == 0 else f"10^{power}"
    return (
        f"{where}, at a distance of {distance} from trouble: "
        f"{written} right digits by {names[0]}, {rearranged} by {names[1]}."
    )


# The curves take some milliseconds, once per formula and format: no tiers.
SCENE = Scene(
    id="stability",
    title="Near Trouble",
    settings=Settings,
    draw=draw,
    stages=(Stage("errors", errors_of),),
    handles=HANDLES,
)
