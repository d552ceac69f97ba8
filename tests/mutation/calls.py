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


def other_calls(node: ast.Call) -> Iterator[ast.Call | ast.expr]:
    """Every mistake in the function called and in the order of its arguments."""
    match node.func:
        case ast.Attribute(value=owner, attr=name):
            same: ast.expr = owner
        case ast.Name(id=name):
            same = node.func
        case _:
            return
    if name in FUNCTION:
        yield ast.Call(_renamed(node.func, FUNCTION[name]), node.args, node.keywords)
    if name in FORGOTTEN and node.args:
        yield node.args[0]
    yield from _exchanged(node, name, _is_library(same))


def _renamed(function: ast.expr, name: str) -> ast.expr:
    if isinstance(function, ast.Attribute):
        return ast.Attribute(function.value, name, ast.Load())
    return ast.Name(name, ast.Load())


def _is_library(owner: ast.expr) -> bool:
    """Whether the function, or what it is an attribute of, is not one of ours."""
    match owner:
        case ast.Name(id=name):
            return name in LIBRARIES or name in BUILTINS
        case ast.Attribute(attr=name):
            return name in LIBRARIES
        case _:
            return True  # a method of an array


def _exchanged(node: ast.Call, name: str, library: bool) -> Iterator[ast.Call]:
    """Two neighbouring arguments exchanged: those that one can confuse."""
    if any(isinstance(argument, ast.Starred) for argument in node.args):
        return
    if name in ORDERED:
        places = [ORDERED[name]]
    else:
        places = [] if library else list(range(len(node.args) - 1))
    for place in places:
        if len(node.args) >= place + 2:
            args = list(node.args)
            args[place : place + 2] = args[place + 1], args[place]
            yield ast.Call(node.func, args, node.keywords)
