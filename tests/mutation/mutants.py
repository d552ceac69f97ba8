"""Small, plausible mistakes in a Python module: one constant, sign, comparison, order or index.

Numbers in messages, annotations and decorators are left alone: no test of a model is meant to
see those. Source: DeMillo, Lipton, Sayward, *Hints on test data selection*, 1978.
"""

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest

from mutation.calls import EVEN, called, other_calls

UNTOUCHED = (ast.Raise, ast.JoinedStr, ast.TypeAlias, ast.Import, ast.ImportFrom)
UNTOUCHED_FIELDS = ("annotation", "returns", "decorator_list", "type_params")

BOUNDARY: dict[type, type] = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
OPPOSITE: dict[type, type] = {
    ast.Lt: ast.GtE,
    ast.LtE: ast.Gt,
    ast.Gt: ast.LtE,
    ast.GtE: ast.Lt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
OPERATOR: dict[type, type] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mod,
    ast.Mod: ast.FloorDiv,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
TRANSPOSED = ("T", "mT")
PRODUCT = (ast.Mult, ast.Div, ast.MatMult, ast.Pow)


@dataclass(frozen=True, slots=True)
class Mutant:
    """A module with one mistake in it."""

    place: str
    """The function in which the mistake is, as ``Class.method``; empty for the module itself."""
    before: str
    """The statement, on one line, as it should be."""
    after: str
    """The statement with the mistake: with `place`, the name of the mutant."""
    source: str
    """The whole mutated module."""


def mutants(source: str) -> Iterator[Mutant]:
    """Every mutant of a module, in the order of its text. Yields nothing that changes nothing."""
    tree = ast.parse(source)
    for mistake in list(_mistakes(tree)):
        _exchange(tree, mistake.old, mistake.new)
        wrong = ast.unparse(tree)
        _exchange(tree, mistake.new, mistake.old)
        yield Mutant(mistake.place, mistake.before, mistake.after, wrong)


def names(source: str) -> Iterator[tuple[str, str]]:
    """(place, after) of every mutant of a module, in a tenth of the time."""
    for mistake in _mistakes(ast.parse(source)):
        yield mistake.place, mistake.after


@dataclass(frozen=True, slots=True)
class _Mistake:
    """One node of a tree, and what may stand in its place; the rest as in `Mutant`."""

    old: ast.AST
    new: ast.AST
    place: str
    before: str
    after: str


def _mistakes(tree: ast.Module) -> Iterator[_Mistake]:
    for place, statement, old, new in list(_mutations(tree, "", tree.body[0])):
        alone = ast.Module([_without_body(statement)], [])
        right = ast.unparse(alone)
        _exchange(alone, old, new)
        wrong = ast.unparse(alone)
        _exchange(alone, new, old)
        if wrong != right:
            yield _Mistake(old, new, place, *_changed_line(right, wrong))


def _without_body(statement: ast.stmt) -> ast.stmt:
    """The statement itself, or the head alone, made of the same nodes, if it holds others."""
    if not hasattr(statement, "body"):
        return statement
    head = copy.copy(statement)
    for field, empty in (("body", [ast.Pass()]), ("orelse", [])):
        if hasattr(head, field):
            setattr(head, field, empty)
    return head


def _exchange(tree: ast.AST, old: ast.AST, new: ast.AST) -> None:
    """One node for another, in place."""

    class Exchange(ast.NodeTransformer):
        def visit(self, node: ast.AST) -> ast.AST:
            return new if node is old else self.generic_visit(node)

    Exchange().visit(tree)


def _changed_line(right: str, wrong: str) -> tuple[str, str]:
    pairs = zip_longest(right.splitlines(), wrong.splitlines(), fillvalue="")
    before, after = next(pair for pair in pairs if pair[0] != pair[1])
    if after.strip() == "pass":
        after = f"pass  # {before.strip()}"
    return before.strip(), after.strip()


def _mutations(
    node: ast.AST, place: str, statement: ast.stmt
) -> Iterator[tuple[str, ast.stmt, ast.AST, ast.AST]]:
    """(function, statement, node, what may stand in its place) for a node and all below it."""
    if isinstance(node, UNTOUCHED) or (isinstance(node, ast.keyword) and node.arg == "strict"):
        return  # of zip: a check of the code, not a part of the model
    if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
        return
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        place = f"{place}.{node.name}".lstrip(".")
    if isinstance(node, ast.stmt):
        statement = node
    for new in _alternatives(node):
        yield place, statement, node, new
    for part, new in _alternatives_of_parts(node):
        yield place, part if isinstance(part, ast.stmt) else statement, part, new
    for field, value in ast.iter_fields(node):
        if field in UNTOUCHED_FIELDS:
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                yield from _mutations(child, place, statement)


def _alternatives(node: ast.AST) -> Iterator[ast.AST]:
    match node:
        case ast.Constant(value=bool() | int() | float() as value):
            yield from (ast.Constant(number) for number in _other_numbers(value))
        case ast.UnaryOp(op=ast.USub() | ast.Not() | ast.Invert()):
            yield node.operand
        case ast.BinOp(op=ast.MatMult()):
            yield ast.BinOp(node.right, node.op, node.left)
        case ast.BinOp() if type(node.op) in OPERATOR:
            yield ast.BinOp(node.left, OPERATOR[type(node.op)](), node.right)
        case ast.AugAssign() if type(node.op) in OPERATOR:
            yield ast.AugAssign(node.target, OPERATOR[type(node.op)](), node.value)
        case ast.BoolOp():
            yield ast.BoolOp(ast.Or() if isinstance(node.op, ast.And) else ast.And(), node.values)
        case ast.Compare():
            yield from _other_comparisons(node)
        case ast.Call():
            yield from other_calls(node)
        case ast.Attribute(attr=name) if name in TRANSPOSED:
            yield node.value
        case ast.Slice():
            yield from _other_slices(node)
        case ast.Tuple(ctx=ast.Load()) if not _is_spread(node):
            yield from (ast.Tuple(order, node.ctx) for order in _other_orders(node.elts))
        case ast.List(ctx=ast.Load()):
            yield from (ast.List(order, node.ctx) for order in _other_orders(node.elts))
        case ast.Constant(value="xyz" | "XYZ" | "RGB" as axes):
            yield ast.Constant(axes[1] + axes[0] + axes[2])


def _alternatives_of_parts(node: ast.AST) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Mistakes that are seen only from above: (child, what may stand in its place)."""
    match node:
        case ast.If(test=ast.Name() | ast.Attribute() | ast.Call() as test):
            yield test, ast.UnaryOp(ast.Not(), test)
        case ast.IfExp(test=ast.Name() | ast.Attribute() | ast.Call() as test):
            yield test, ast.UnaryOp(ast.Not(), test)
    is_product = isinstance(node, ast.BinOp) and isinstance(node.op, PRODUCT)
    is_product |= isinstance(node, ast.Call) and called(node) in EVEN
    for child in ast.iter_child_nodes(node):
        match child:
            case ast.BinOp(op=ast.Mult() | ast.Div()) if not is_product:
                yield child, ast.UnaryOp(ast.USub(), child)
            case ast.Expr(value=ast.Call()) | ast.Assign(targets=[ast.Subscript()]):
                yield child, ast.Pass()


def _other_orders(items: list[ast.expr]) -> Iterator[list[ast.expr]]:
    """Neighbours exchanged: any two of a vector, the first two of a longer table."""
    for index in range(len(items) - 1 if len(items) <= 4 else 1):
        first, second = items[index : index + 2]
        if any(_is_new_axis(item) for item in (first, second)):
            continue  # x[None, 0] and x[0, None] are the same
        yield [*items[:index], second, first, *items[index + 2 :]]


def _other_slices(node: ast.Slice) -> Iterator[ast.AST]:
    """A bound forgotten. Constants in bounds are changed as constants elsewhere are."""
    if node.lower and not _is_number(node.lower):
        yield ast.Slice(None, node.upper, node.step)
    if node.upper and not _is_number(node.upper):
        yield ast.Slice(node.lower, None, node.step)


def _is_new_axis(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def _is_number(node: ast.expr) -> bool:
    bare = node.operand if isinstance(node, ast.UnaryOp) else node
    return isinstance(bare, ast.Constant)


def _is_spread(node: ast.Tuple) -> bool:
    """``[..., x]``: in another order it is rarely an index at all."""
    return any(isinstance(item, ast.Constant) and item.value is ... for item in node.elts)


def _other_numbers(value: bool | int | float) -> list[bool | int | float]:
    """A tolerance moves by three decades, another quantity by a tenth, a count by one."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1] if value > 0 else [value + 1]
    if value == 0.0:
        return [1.0]
    if value < 1e-4:
        return [value * 1000.0]
    return [value / 1000.0 if value > 1e6 else value * 1.1]


def _other_comparisons(node: ast.Compare) -> Iterator[ast.AST]:
    for index, operator in enumerate(node.ops):
        for table in (BOUNDARY, OPPOSITE):
            if other := table.get(type(operator)):
                ops = [*node.ops[:index], other(), *node.ops[index + 1 :]]
                yield ast.Compare(node.left, ops, node.comparators)
