"""Answers that are worked out while the book is built: expressions over the book's own code.

readout("lens-distortion", "corner", k1=-0.2)       what a figure says at that setting
measured("resampling", "nearest", "psnr-round")     a number from the bench's file
2 * degrees(atan(18 / focal_mm))                    arithmetic
field_of_view_rad(50, 36)                           a function that ``:uses:`` names
"""

from collections.abc import Callable
from importlib import import_module

from simulations.engine.conditions import shown_value
from simulations.engine.expressions import ExpressionError, evaluate
from site_builder.benchmarks.measurements import SIDES
from site_builder.diagnostics import cause, unknown
from site_builder.kept.keeper import reads_code
from site_builder.markdown.directive import DirectiveCall
from site_builder.markdown.parse_context import ParseContext

FORM = "simulations.package.module:function"


def names_for(call: DirectiveCall, context: ParseContext) -> dict[str, object]:
    """What the expressions of a directive may name; a bad ``:uses:`` is reported."""

    def readout(scene: str, name: str, **settings: object) -> float | str:
        given = {control: str(value) for control, value in settings.items()}
        return shown_value(context.readouts.text(scene, name, given, bare=True))

    def measured(ladder: str, tier: str, wanted: str) -> float | None:
        item = context.measurements.find(ladder)[tier]
        return item.times[wanted].ms if wanted in SIDES else item.errors[wanted]

    names: dict[str, object] = {"readout": readout, "measured": measured}
    for path in call.text("uses").split():
        try:
            function = _function(path)
        except LookupError as error:
            context.problem(call.options["uses"].line, str(error.args[0]))
        else:
            names[path.partition(":")[2]] = function
    return names


def number(text: str, names: dict[str, object], line: int, context: ParseContext) -> float | None:
    """The finite number that ``text`` stands for, or None and a diagnostic."""
    try:
        value = evaluate(text, names)
    except ExpressionError as error:
        context.problem(line, str(error))
        return None
    try:
        result = float(value)
    except (TypeError, ValueError):
        result = float("nan")
    if abs(result) < float("inf"):
        return result
    context.problem(line, f"{text!r} is {value!r}; legal: what comes to a finite number")
    return None


def truth(text: str, names: dict[str, object], line: int, context: ParseContext) -> bool | None:
    """Whether the condition ``text`` holds, or None and a diagnostic."""
    try:
        return bool(evaluate(text, names))
    except ExpressionError as error:
        context.problem(line, str(error))
        return None


def _function(path: str) -> Callable[..., object]:
    """The function that ``path`` names. Raises `LookupError`."""
    module, _, name = path.partition(":")
    if not module.startswith("simulations.") or not name:
        raise LookupError(f"function {path!r}; legal: {FORM!r}")
    try:
        found = import_module(module)
    except ImportError:
        raise LookupError(f"no module {module!r}; legal: {FORM!r}") from None
    except Exception as error:  # whatever its code may raise is the author's to see
        raise LookupError(f"module {module!r} cannot be loaded: {cause(error)}") from error
    functions = {key: value for key, value in vars(found).items() if callable(value)}
    if name not in functions:
        raise LookupError(unknown(f"function of {module}", name, functions))
    function: Callable[..., object] = functions[name]
    reads_code(function)
    return function
