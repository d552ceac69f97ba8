"""Conditions on the state of a figure, for questions whose answer is a figure."""

from collections.abc import Mapping, Sequence

from simulations.engine.expressions import ExpressionError, evaluate
from simulations.engine.frame import Frame
from simulations.engine.settings import values_of

WORDS = {"∞": float("inf"), "\u2212∞": float("-inf"), "undefined": float("nan")}


def readout_value(text: str) -> float | str:
    """The number in a readout, or its text if there is none."""
    if text in WORDS:
        return WORDS[text]
    try:
        return float(text.replace("\u2212", "-"))
    except ValueError:
        return text


def names_in(settings: object, frame: Frame) -> Mapping[str, object]:
    """Names and values for conditions: the settings, and the readouts that share no setting's
    name."""
    readouts = {readout.name: readout_value(readout.text) for readout in frame.readouts}
    return {**readouts, **values_of(settings)}


def first_true(conditions: Sequence[str], settings: object, frame: Frame) -> int | None:
    """The place of the first condition that holds, or None. Raises `ExpressionError`."""
    names = names_in(settings, frame)
    return next((at for at, text in enumerate(conditions) if _holds(text, names)), None)


def _holds(condition: str, names: Mapping[str, object]) -> bool:
    value = evaluate(condition, names)
    if isinstance(value, tuple):
        raise ExpressionError(f"{condition!r} is a list; legal: a condition, with decimal points")
    return bool(value)
