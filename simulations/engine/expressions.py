"""A small language of expressions: arithmetic, comparisons and calls, written as in Python.

Answers and conditions in chapters are such expressions. They are evaluated when the book is built
and, for the state of a figure, in the browser. An expression can use only the names it is given; it
has no methods and no comprehensions.
"""

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from simulations.engine.controls import suggestion

MOST_BITS = 4096
"""Limit of a whole number, so that no power or product takes minutes."""
MOST_DIGITS = 400
"""Numbers are rounded to these: no float has more on either side of the point."""
BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: lambda left, right: _product(left, right),
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: lambda left, right: _remainder(left, right),
    ast.Pow: lambda base, exponent: _power(base, exponent),
    ast.MatMult: np.matmul,
}
UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Not: operator.not_,
}
COMPARISONS: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.In: lambda item, items: item in items,
    ast.NotIn: lambda item, items: item not in items,
}
MATHS: Mapping[str, object] = {
    **{
        name: getattr(math, name)
        for name in (
            "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "degrees", "radians", "hypot",
            "sqrt", "exp", "log", "log2", "log10", "floor", "ceil", "isfinite", "inf", "pi",
        )
    },
    **{function.__name__: function for function in (abs, min, max, len, sum, np.allclose)},
    "round": lambda number, digits=None: _rounded(number, digits),
}  # fmt: skip
"""Names that every expression can use."""


class ExpressionError(ValueError):
    """An expression that cannot be evaluated; the message states why."""


def evaluate(text: str, names: Mapping[str, object]) -> Any:
    """The value of ``text`` with the values of ``names``. Raises `ExpressionError`."""
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        legal = "'-' for minus" if re.search("[−–]", text) else "as '2 * x < 1'"
        raise ExpressionError(f"{text!r} is no expression; legal: {legal}") from None
    return evaluate_node(tree.body, names, text)


def evaluate_node(node: ast.expr, names: Mapping[str, object], text: str = "") -> Any:
    """The value of a parsed expression; ``text`` is quoted in errors."""
    text = text or ast.unparse(node)
    try:
        return _value(node, {**MATHS, **names})
    except ExpressionError as error:
        raise ExpressionError(f"{text!r}: {error}") from None
    except Exception as error:  # the functions that it calls may raise anything
        raise ExpressionError(f"{text!r}: {type(error).__name__}: {error}") from error


def _value(node: ast.expr, names: Mapping[str, object]) -> Any:
    match node:
        case ast.Constant(value=bool() | int() | float() | str()):
            return node.value
        case ast.Name(id=name):
            if name not in names:
                raise ExpressionError(f"unknown name {name!r}{_expected(name, names)}")
            return names[name]
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in UNARY:
            return UNARY[type(sign)](_value(operand, names))
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in BINARY:
            return BINARY[type(sign)](_value(left, names), _value(right, names))
        case ast.BoolOp(op=ast.And(), values=values):
            return all(_value(value, names) for value in values)
        case ast.BoolOp(values=values):
            return any(_value(value, names) for value in values)
        case ast.Compare():
            return _compared(node, names)
        case ast.Tuple(elts=items) | ast.List(elts=items):
            return tuple(_value(item, names) for item in items)
        case ast.Subscript(value=whole, slice=index):
            return _value(whole, names)[_value(index, names)]
        case ast.Slice(lower=first, upper=last, step=step):
            return slice(*(part and _value(part, names) for part in (first, last, step)))
        case ast.Attribute(value=whole, attr=attr) if not attr.startswith("_"):
            return _data(_value(whole, names), attr)
        case ast.Lambda(args=parameters, body=body):
            keys = [parameter.arg for parameter in parameters.args]
            return lambda *given: _value(body, {**names, **dict(zip(keys, given, strict=True))})
        case ast.Call(func=ast.Name(), args=args, keywords=given):
            call = _value(node.func, names)
            named = {str(item.arg): _value(item.value, names) for item in given if item.arg}
            return call(*(_value(arg, names) for arg in args), **named)
    legal = "numbers, names, calls, comparisons"
    match node:
        case ast.BinOp(op=ast.BitXor()):
            legal = "'**' for a power"
        case ast.Call(func=ast.Attribute(attr=attr)):
            legal = f"the name alone, '{attr}(…)'"
    raise ExpressionError(f"{ast.unparse(node)!r} has no meaning here; legal: {legal}")


def _power(base: Any, exponent: Any) -> Any:
    integers = isinstance(base, int) and isinstance(exponent, int)
    if integers and base.bit_length() * exponent > MOST_BITS:
        raise ExpressionError("a power that is too large; legal: below 1e1000")
    return base**exponent


def _product(left: Any, right: Any) -> Any:
    for one, other in ((left, right), (right, left)):
        if isinstance(one, str | tuple) and isinstance(other, int):
            raise ExpressionError("a text or list times a number; legal: a product of numbers")
    integers = isinstance(left, int) and isinstance(right, int)
    if integers and left.bit_length() + right.bit_length() > MOST_BITS:
        raise ExpressionError("a product that is too large; legal: below 1e1000")
    return left * right


def _remainder(left: Any, right: Any) -> Any:
    if isinstance(left, str):
        raise ExpressionError("a text before '%'; legal: the remainder of numbers")
    return left % right


def _rounded(number: Any, digits: int | None) -> Any:
    if digits is not None and abs(digits) > MOST_DIGITS:
        raise ExpressionError(f"rounded to {digits} digits; legal: -{MOST_DIGITS} to {MOST_DIGITS}")
    return round(number) if digits is None else round(number, digits)


def _data(whole: object, name: str) -> object:
    """The attribute of an object, unless it is a method."""
    value = getattr(whole, name)
    if callable(value):
        raise ExpressionError(f"method {name!r}; legal: attributes that hold data")
    return value


def _expected(name: str, names: Mapping[str, object]) -> str:
    legal = [known for known in names if known not in MATHS]
    return suggestion(name, names) or f"; legal: {', '.join(legal) or 'none'}"


def _compared(node: ast.Compare, names: Mapping[str, object]) -> Any:
    """True or False; of arrays, one for each element."""
    left, holds = _value(node.left, names), True
    for sign, term in zip(node.ops, node.comparators, strict=True):
        if type(sign) not in COMPARISONS:
            raise ExpressionError(f"unknown comparison; legal: {'<, <=, >, >=, ==, !=, in'}")
        right = _value(term, names)
        holds = np.logical_and(holds, COMPARISONS[type(sign)](left, right))
        left = right
    return holds if np.ndim(holds) else bool(holds)
