"""Hard cases of models: questions at the edge of a model's domain, read from tables in TOML.

A table, ``hard_cases/rotations.toml``, names what its expressions use, and lists the cases::

    title = "Rotations and quaternions"
    names = [
      "simulations.models.geometry.rotations:*",      # every name of a module
      "simulations.models.geometry.rotations:slerp",  # a single name
      "simulations.models.geometry.euler",            # the module itself
    ]

    [objects]                                         # expressions, evaluated in order
    BARREL = "Distortion(k1=-0.3)"

    [cases.no-turn]                                   # the fields of `HardCase`
    call = "exponential([0.0, 0.0, 0.0])"

A question is the expression that readers see, so that the book and the tests always agree. Only
the book and the tests read the tables; scenes and pages do not.
"""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

type Check = Callable[[Any], bool]

LONGEST_SHOWN = 12
"""Arrays of more entries are printed by their shape and range."""

ROUNDING = 1e-13
"""Entries below this share of an array's largest entry are printed as 0."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HardCase:
    """A question at the edge of a model's domain, with its answers."""

    id: str
    call: str
    """The question: an expression in the names of the table."""
    why: str
    """Why the case is hard."""
    returns: str
    """What the model returns, and why."""
    expected: str
    """An expression for a function that judges the answer, such as ``near([0.6, 0.0, 0.8])``."""
    naive: str = ""
    """The textbook formula for the same numbers, in numpy and the names of the table."""
    library: str = ""
    """The question in the names of a widely used library; only the tests evaluate it."""
    library_answer: str = ""
    """The library's answer as `show` prints it; a test compares it with the installed library."""


@dataclass(frozen=True, slots=True)
class HardCases:
    """The hard cases of one model."""

    id: str
    title: str
    names: Mapping[str, Any]
    """Names for the expressions: the functions of the model, and a few prepared objects."""
    cases: tuple[HardCase, ...]


def read_table(table_id: str, text: str) -> HardCases:
    """The table ``text``. Mistakes in it raise Python's exceptions."""
    return table_of(table_id, tomllib.loads(text))


def table_of(
    table_id: str, data: Mapping[str, Any], instead: Mapping[str, Any] | None = None
) -> HardCases:
    """The table of parsed ``data``; ``instead``: names with another meaning in the questions."""
    names: dict[str, Any] = {"np": np, "inf": np.inf, "nan": np.nan}
    for path in data["names"]:
        names |= _named(path)
    for name, expression in data.get("objects", {}).items():
        names[name] = evaluate(expression, names)
    cases = tuple(HardCase(id=name, **entry) for name, entry in data["cases"].items())
    return HardCases(table_id, data["title"], {**names, **(instead or {})}, cases)


def _named(path: str) -> Mapping[str, Any]:
    name, _, attribute = path.partition(":")
    module = import_module(name)
    match attribute:
        case "":
            return {name.rpartition(".")[2]: module}
        case "*":
            return vars(module)
    return {attribute: getattr(module, attribute)}


def evaluate(expression: str, names: Mapping[str, Any]) -> Any:
    """The value of a Python expression, which is the author's code as a scene is."""
    return eval(expression, {**names})


def answer(table: HardCases, call: str) -> Any:
    """The model's answer to a question: a value, or the `ValueError` that it raises.

    Other exceptions and warnings are defects of the model and are not caught.
    """
    try:
        return evaluate(call, table.names)
    except ValueError as refusal:
        return refusal


def naive_answer(table: HardCases, formula: str) -> Any:
    """The answer of a textbook formula without its warnings: a value, or the exception raised."""
    try:
        with np.errstate(all="ignore"):
            return evaluate(formula, table.names)
    except (ArithmeticError, ValueError, IndexError) as failure:
        return failure


def as_expected(table: HardCases, expected: str, got: Any) -> bool:
    """Whether an answer, or the `ValueError` raised instead, is the expected one."""
    checks = {check.__name__: check for check in (refused, near, exactly, valid, invalid)}
    return bool(evaluate(expected, {**table.names, **checks})(got))


def show(value: Any) -> str:
    """An answer as the book prints it: numbers to five digits, exceptions with their message."""
    match value:
        case ValueError():
            return f"{type(value).__name__}: {value}"
        case BaseException():
            return type(value).__name__
        case tuple():
            return ", ".join(show(item) for item in value)
        case np.ndarray() if value.size > LONGEST_SHOWN:
            low, high = show(value.min()), show(value.max())
            extent = f"all {low}" if low == high else f"{low} to {high}"
            return f"{' × '.join(map(str, value.shape))} values, {extent}"
        case np.ndarray() if value.ndim == 0:
            return show(value[()])
        case np.ndarray():
            return f"[{', '.join(show(item) for item in _without_rounding(value))}]"
        case bool() | np.bool_():
            return str(bool(value))
        case int() | np.integer():
            return str(int(value))
        case float() | np.floating():
            return f"{float(value) + 0.0:.5g}"  # adding 0 makes −0 a plain 0
    return str(value)


def _without_rounding(array: Any) -> Any:
    """Set entries that are rounding errors of the largest one to 0, as they differ by machine."""
    if array.dtype.kind != "f":
        return array
    size = np.abs(array)
    largest = np.max(size, where=np.isfinite(array), initial=0.0)
    return np.where(size < ROUNDING * largest, 0.0, array)


def refused(*words: str) -> Check:
    """The model raises `ValueError` with a message that contains all ``words``."""
    return lambda got: isinstance(got, ValueError) and all(word in str(got) for word in words)


def near(value: Any, tolerance: float = 1e-12) -> Check:
    """The answer is ``value`` to a relative (below 1, absolute) tolerance; infinities exactly."""
    return lambda got: _is_near(got, value, tolerance)


def _is_near(got: Any, value: Any, tolerance: float) -> bool:
    if isinstance(got, Exception) or np.shape(got) != np.shape(value):
        return False
    if not np.all(np.isfinite(value)):
        return bool(np.array_equal(got, value, equal_nan=True))
    return bool(np.allclose(got, value, rtol=tolerance, atol=tolerance))


def exactly(value: Any) -> Check:
    """The answer equals ``value`` exactly, NaN included."""
    return lambda got: (
        not isinstance(got, Exception)
        and np.shape(got) == np.shape(value)
        and bool(np.array_equal(got, value, equal_nan=np.asarray(value).dtype.kind == "f"))
    )


def valid(value: Any, tolerance: float = 1e-12) -> Check:
    """The answer is a pair (values, mask); the mask is all True and the values are ``value``."""
    return lambda got: (
        isinstance(got, tuple) and bool(np.all(got[1])) and _is_near(got[0], value, tolerance)
    )


def invalid(got: Any) -> bool:
    """The answer is a pair (values, mask); the mask is all False and all values are NaN."""
    return isinstance(got, tuple) and not np.any(got[1]) and bool(np.all(np.isnan(got[0])))
