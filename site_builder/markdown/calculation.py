"""Numbers computed while the book is built, from expressions that a page writes.

readout("lens-distortion", "corner", k1=-0.2)       what a figure shows at that setting
measured("resampling", "nearest", "psnr-round")     a number from the benchmarks' file
draws("resampling", "nearest", "psnr-round")        the same on other draws of the workload
holds(draws(…) < draws(…))                          whether it is so in nine of ten draws
2 * degrees(atan(18 / focal_mm))                    arithmetic

A code block ``calc`` of the page imports functions of the models, names values, and asserts what
the text claims; expressions below it use both. The block itself is not shown.
"""

import ast
import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from importlib import import_module
from math import isfinite
from types import ModuleType
from typing import Any

import numpy as np
from markdown_it.token import Token
from numpy.typing import NDArray

from simulations.engine.conditions import readout_value
from simulations.engine.expressions import ExpressionError, evaluate, evaluate_node
from simulations.engine.frame import power_of_ten
from site_builder.benchmarks.measurements import SIDES, in_nine_of_ten
from site_builder.cache.hashing import source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import CodeError, raised_by_code
from site_builder.diagnostics.diagnostic import cause, unknown
from site_builder.markdown.parse_context import ParseContext
from site_builder.pool.processes import run_in_pool

BLOCK = "calc"
LEGAL = "legal: 'from simulations.… import name', 'name = expression', 'assert condition'"
PACKAGES = ("simulations.", "numpy.linalg")
FORM = re.compile(r"(.*?)(?::([^:\"']*))?", re.DOTALL)
IN_FORMULA = re.compile(r"\\calc\{([^{}]*)\}")
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
"""In TeX, where it would have a space behind it."""
LIST_OF_DIGITS = re.compile(r"\d,\d")
"""What may be a list or one number with a decimal comma."""
NARROW_SPACE = "\u202f"


def names_for(context: ParseContext) -> dict[str, object]:
    """What the expressions of a page may name, besides mathematical functions."""

    def readout(scene: str, name: str, **settings: object) -> float | str:
        given = {control: str(value) for control, value in settings.items()}
        return readout_value(context.readouts.text(scene, name, given, bare=True))

    def measured(ladder: str, tier: str, wanted: str) -> float | None:
        item = context.shared.measurements.find(ladder)[tier]
        return item.times[wanted].ms if wanted in SIDES else item.errors[wanted]

    def draws(ladder: str, tier: str, metric: str) -> NDArray[np.float64]:
        return context.shared.measurements.find(ladder)[tier].draws[metric]

    named = {"readout": readout, "measured": measured, "draws": draws, "holds": in_nine_of_ten}
    return {**named, **context.values}


def number(text: str, line: int, context: ParseContext, **more: object) -> float | None:
    """The finite number that ``text`` stands for, or None and a diagnostic; it may also name what
    ``more`` holds."""
    names = {**names_for(context), **more}
    return or_problem(lambda: _as_number(evaluate(text, names), text), line, context)


def truth(text: str, line: int, context: ParseContext) -> bool | None:
    """Whether the condition ``text`` holds, or None and a diagnostic."""
    return or_problem(lambda: bool(evaluate(text, names_for(context))), line, context)


def or_problem[T](compute: Callable[[], T], line: int, context: ParseContext) -> T | None:
    """What is computed, or None and a diagnostic of what is wrong with its expressions."""
    try:
        return compute()
    except ExpressionError as error:
        context.problem(line, str(error), raised_by_code(error))
        return None


def numbers(text: str, context: ParseContext) -> list[float]:
    """The finite numbers that ``text`` stands for, one or several. Raises `ExpressionError`."""
    value = evaluate(text, names_for(context))
    several = isinstance(value, tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)
    if several and LIST_OF_DIGITS.search(text):
        raise ExpressionError(f"{text!r}; legal: a decimal point, or a space behind each comma")
    return [_as_number(item, text) for item in (value if several else (value,))]


def number_text(written: str, context: ParseContext) -> str:
    """``expression`` or ``expression:.2f`` as running text shows it: 3, −0.25, 6.2 × 10⁻⁵; the
    numbers of a vector with commas between them. Raises `ExpressionError`.
    """

    def text(mantissa: str, exponent: str) -> str:
        if exponent:
            mantissa += f"{NARROW_SPACE}×{NARROW_SPACE}{power_of_ten(int(exponent))}"
        return context.shared.words.numeral(mantissa.replace("-", "−").replace(",", "\u00a0"))

    return _separator(context).join(text(*parts) for parts in _formatted(written, context))


def compute_formula(tex: str, line: int, context: ParseContext) -> str:
    r"""The formula, which begins on ``line``, with a number in place of each
    ``\calc{expression:.2f}``; nothing, and a diagnostic, where one cannot be computed."""

    def number_tex(mantissa: str, exponent: str) -> str:
        power = rf" \cdot 10^{{{int(exponent)}}}" if exponent else ""
        numeral = context.shared.words.numeral(mantissa.replace(",", r"\,"))
        return DECIMAL_COMMA.sub("{,}", numeral) + power

    def numbers(match: re.Match[str]) -> str:
        shown = (number_tex(*parts) for parts in _formatted(match[1], context))
        return _separator(context).join(shown)

    for match in IN_FORMULA.finditer(tex):
        place = line + tex.count("\n", 0, match.start())
        found = or_problem(partial(numbers, match), place, context)
        if found is None:
            return ""
        tex = tex.replace(match[0], found, 1)
    return tex


def _separator(context: ParseContext) -> str:
    """Between numbers, of which it is no part."""
    return "; " if context.shared.words("language.decimal") == "," else ", "


def define_names(token: Token, line: int, context: ParseContext) -> None:
    """Add what a ``calc`` block imports and computes to the page's names; show nothing."""
    first = line + 1
    try:
        body = ast.parse(token.content).body
    except SyntaxError as error:
        message = f"malformed calculation: {error.msg}; {LEGAL}"
        lost = re.findall(r"[^\W\d]\w*", token.content)
        context.problem(line + (error.lineno or 1), message, spoils=_unknown(lost))
        body = []
    for statement in body:
        try:
            for name, value in _defined(statement, context):
                context.values[name] = value
        except (ExpressionError, LookupError) as error:
            place = first + statement.lineno - 1
            lost = [
                getattr(node, "asname", "") or getattr(node, "name", "") or getattr(node, "id", "")
                for node in ast.walk(statement)
                if isinstance(node, ast.alias | ast.FunctionDef)
                or isinstance(getattr(node, "ctx", None), ast.Store)
            ]
            message = str(error.args[0])
            context.problem(place, message, raised_by_code(error), spoils=_unknown(lost))
    token.type, token.content = "html_block", ""


def _unknown(lost: Iterable[str]) -> tuple[str, ...]:
    """What follows where these names are not defined."""
    return tuple(f"unknown name {name!r}" for name in lost)


def _defined(statement: ast.stmt, context: ParseContext) -> Iterator[tuple[str, object]]:
    match statement:
        case ast.ImportFrom(module=str(module), names=names):
            for name in names:
                yield name.asname or name.name, _imported(module, name.name)
        case ast.Assign(targets=[target], value=value):
            yield from _assigned(target, evaluate_node(value, names_for(context)))
        case ast.Assert(test=claim):
            if not evaluate_node(claim, names_for(context)):
                raise ExpressionError(f"{ast.unparse(claim)!r} does not hold; legal: what is true")
        case _:
            first = ast.unparse(statement).partition("\n")[0]
            raise ExpressionError(f"{first!r} in a calculation; {LEGAL}")


def _assigned(target: ast.expr, value: object) -> Iterator[tuple[str, object]]:
    match target:
        case ast.Name(id=name):
            yield name, value
        case ast.Tuple(elts=targets) if isinstance(value, Iterable):
            values = tuple(value)
            if len(values) != len(targets):
                message = f"{len(values)} values for {ast.unparse(target)!r}"
                raise ExpressionError(f"{message}; legal: as many names as values")
            for inner, item in zip(targets, values, strict=True):
                yield from _assigned(inner, item)
        case _:
            raise ExpressionError(f"{ast.unparse(target)!r} is given {value!r}; {LEGAL}")


def _formatted(written: str, context: ParseContext) -> Iterator[tuple[str, str]]:
    """Digits, and the exponent of ten or nothing, of each number."""
    expression, spec = FORM.fullmatch(written).groups()  # type: ignore[union-attr]
    for given in numbers(expression, context):
        try:
            text = format(given, spec or "g")
        except ValueError:
            raise ExpressionError(
                f"{written!r} has no number format; legal: 'expression' or 'expression:.2f'"
            ) from None
        mantissa, _, exponent = text.partition("e")
        yield re.sub(r"^-(?=[0.]*$)", "", mantissa), exponent


def _as_number(value: Any, text: str) -> float:
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        result = float("nan")
    if not isfinite(result):
        legal = (
            "a decimal point" if LIST_OF_DIGITS.search(text) else "what comes to a finite number"
        )
        raise ExpressionError(f"{text!r} is {value!r:.30}; legal: {legal}")
    return result


def _imported(module: str, name: str) -> object:
    """A function or constant of the models or of numpy.linalg. Raises `LookupError`."""
    if not f"{module}.".startswith(PACKAGES):
        raise LookupError(f"import from {module!r}; legal: 'simulations.…' or 'numpy.linalg'")
    try:
        names, value = _looked_up(module, name, source_hash(module))
    except ImportError:
        raise LookupError(f"no module {module!r}; {LEGAL}") from None
    except Exception as error:  # whatever its code may raise is the author's to see
        raise CodeError(f"module {module!r} cannot be loaded: {cause(error)}") from error
    if name not in names:
        raise LookupError(unknown(f"name of {module}", name, names))
    return getattr(np.linalg, name) if module == np.linalg.__name__ else value


@cached
def _looked_up(module: str, name: str, _sources: bytes) -> tuple[list[str], Any]:
    return run_in_pool(partial(_public, module, name))


def _public(module: str, name: str) -> tuple[list[str], Any]:
    """In the pool: the public names of a module, and the value of one."""
    public = {
        key: value
        for key, value in vars(import_module(module)).items()
        if not key.startswith("_") and not isinstance(value, ModuleType)
    }
    return [*public], public.get(name)
