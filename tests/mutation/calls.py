"""Mistakes in a call: another function of the same kind, one left out, two arguments exchanged."""

import ast
from collections.abc import Iterator

PAIRS = (
    "min max|minimum maximum|argmin argmax|fmin fmax|sin cos|arcsin arccos|asin acos|sinh cosh"
    "|floor ceil|any all|zeros ones|exp log|zeros_like ones_like|sum mean|hstack vstack"
)
FUNCTION = {
    name: other for pair in PAIRS.split("|") for name, other in (pair.split(), pair.split()[::-1])
} | {"tan": "sin", "rint": "floor", "round": "floor", "arctan": "sin", "atan": "sin"}
FORGOTTEN = ("abs", "sqrt", "cbrt", "square", "sign", "moveaxis", "swapaxes", "copysign")
"""Functions that one may leave out: what remains is their first argument."""

EVEN = ("abs", "cos", "hypot", "sinc", "square")
"""Functions that do not see a sign."""

ORDERED = {
    name: first
    for first, names in enumerate(
        (
            "arctan2 atan2 copysign cross divide divmod fmod linspace matmul outer remainder",
            "where clip interp moveaxis",
        )
    )
    for name in names.split()
}
"""Library functions of ordered arguments: the first of the two that one may confuse."""
LIBRARIES = ("np", "math", "linalg")
BUILTINS = ("zip", "isinstance", "slice", "range", "enumerate", "map", "min", "max", "float", "len")


def called(node: ast.Call) -> str:
    """Last part of the name of the function called; empty where it has none."""
    match node.func:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
    return ""


def other_calls(node: ast.Call) -> Iterator[ast.Call | ast.expr]:
    """Every mistake in the function called and in the order of its arguments."""
    name = called(node)
    if name in FUNCTION:
        yield ast.Call(_renamed(node.func, FUNCTION[name]), node.args, node.keywords)
    if name in FORGOTTEN and node.args:
        yield node.args[0]
    yield from _exchanged(node, name)


def _renamed(function: ast.expr, name: str) -> ast.expr:
    if isinstance(function, ast.Attribute):
        return ast.Attribute(function.value, name, ast.Load())
    return ast.Name(name, ast.Load())


def _is_ours(function: ast.expr) -> bool:
    """Whether it is a function of a model: by its own name, or by that of its module."""
    match function:
        case ast.Name(id=name):
            return name not in BUILTINS
        case ast.Attribute(value=ast.Name(id=owner)):
            return owner not in LIBRARIES
    return False  # a method of an array, or of a part of numpy


def _exchanged(node: ast.Call, name: str) -> Iterator[ast.Call]:
    """Two neighbouring arguments exchanged: those that one can confuse."""
    if any(isinstance(argument, ast.Starred) for argument in node.args):
        return
    if name in ORDERED:
        places = [ORDERED[name]]
    else:
        places = list(range(len(node.args) - 1)) if _is_ours(node.func) else []
    for place in places:
        if len(node.args) >= place + 2:
            args = list(node.args)
            args[place : place + 2] = args[place + 1], args[place]
            yield ast.Call(node.func, args, node.keywords)
