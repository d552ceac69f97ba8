"""Numbers that a question draws: it is read once with each combination of them.

:draw: f = 24, 35, 50; N = 5.6, 8
"""

import re
from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import replace
from itertools import product
from keyword import iskeyword
from math import prod

from markdown_it.token import Token

from simulations.engine.expressions import ExpressionError
from site_builder.markdown.calculation import numbers, or_problem
from site_builder.markdown.directive import DirectiveCall, OptionLine
from site_builder.markdown.parse_context import ParseContext, Variant
from site_builder.markdown.text.tokens import end_of_element

DRAW = OptionLine(
    "draw",
    doc="names and the numbers to draw for each, `f = 24, 35, 50; N = 5.6, 8`: expressions and "
    "`{calc}` in the question, its answers and replies may use them",
)
MOST = 60
"""Combinations: each is built, and their page carries all."""
IN_BRACKETS = re.compile(r"\(.*\)")
BODY = "drawing"
"""Where the opening token of a question that draws keeps its body."""


def set_aside(tokens: Sequence[Token]) -> list[Token]:
    """The tokens of a page without the bodies of questions that draw; their opening tokens keep
    them, in `BODY`."""
    kept: list[Token] = []
    position = 0
    while position < len(tokens):
        token = tokens[position]
        start, position = position, position + 1
        kept.append(token)
        if token.type == "directive_open" and _draws(token):
            end = end_of_element(tokens, start) - 1
            token.meta[BODY] = tokens[position:end]
            position = end
    return kept


def _draws(token: Token) -> bool:
    directive, call = token.meta["directive"], token.meta["call"]
    return directive is not None and DRAW in directive.options and DRAW.name in call.options


def draw(call: DirectiveCall, body: Sequence[Token], context: ParseContext) -> tuple[Variant, ...]:
    """The body with each combination, the first of each name first; nothing, and a report, where
    mistakes leave none. What the first collects of links and formulae is the page's."""
    option = call.options[DRAW.name]
    columns = or_problem(lambda: _columns(option.text, context), option.line, context)
    if columns is None:
        return ()
    count = prod(map(len, columns.values()))
    if not 2 <= count <= MOST:
        what = f"{call.name} {call.argument!r} draws from {count} combinations"
        context.problem(option.line, f"{what}; legal: 2 to {MOST}")
        return ()
    made: list[Variant] = []
    for values in product(*columns.values()):
        given = dict(zip(columns, values, strict=True))
        named = "; ".join(f"{name} = {value:g}" for name, value in given.items())
        made.append(Variant(named, deepcopy(body), context.reading(given, again=bool(made))))
    return tuple(made)


def _columns(text: str, context: ParseContext) -> Mapping[str, list[float]]:
    """The numbers to draw from, by name. Raises `ExpressionError`."""
    columns: dict[str, list[float]] = {}
    for part in text.split(";"):
        name, sign, values = (word.strip() for word in part.partition("="))
        is_name = name.isidentifier() and not iskeyword(name)
        if not sign or "=" in IN_BRACKETS.sub("", values) or not is_name or name in columns:
            given = f"{part.strip()!r} draws no number"
            raise ExpressionError(f"{given}; legal: each name once, as 'f = 24, 35; N = 5.6, 8'")
        columns[name] = [
            int(value) if value.is_integer() else value for value in numbers(values, context)
        ]
        if len({*columns[name]}) < len(columns[name]):
            given = f"{part.strip()!r} draws a number twice"
            raise ExpressionError(f"{given}; legal: each once")
    return columns


def report_first(drawn: Sequence[Variant], context: ParseContext) -> bool:
    """Report the mistakes of the first combination that has any; whether one has."""
    for each in drawn:
        own = each.context.problems
        for found, reported in (
            (own.found, context.problems.found),
            (own.doubts, context.problems.doubts),
        ):
            reported += [
                replace(item, message=f"with {each.named}: {item.message}") for item in found
            ]
        if own:
            return True
    return False
