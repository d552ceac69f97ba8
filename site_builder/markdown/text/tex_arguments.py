r"""Where a command's arguments stand in TeX: ``{groups}``, or single letters and commands."""

import re
from collections.abc import Callable

from site_builder.markdown.text.math import UnsupportedTexError, quoted

TOKEN = re.compile(r"\s*(\\(?:[A-Za-z]+|.)|[^\s{}])")


def arguments(tex: str, start: int, count: int, command: str) -> tuple[list[str], int]:
    """So many arguments from ``start`` on, and where they end. Raises `UnsupportedTexError`."""
    found: list[str] = []
    for _ in range(count):
        group = re.compile(r"\s*\{").match(tex, start)
        if group:
            end = _closing(tex, group.end() - 1)
            found.append(tex[group.end() : end])
            start = end + 1
        elif token := TOKEN.match(tex, start):
            found.append(token[1])
            start = token.end()
        else:
            wants = "one argument" if count == 1 else f"{count} arguments"
            has = f"{len(found)}" if found else "none"
            raise UnsupportedTexError(f"{command} takes {wants}, {has} given in {quoted(tex)}")
    return found, start


def _closing(tex: str, opening: int) -> int:
    depth = 0
    for brace in re.compile(r"\\.|[{}]", re.DOTALL).finditer(tex, opening):
        depth += {"{": 1, "}": -1}.get(brace[0], 0)
        if depth == 0:
            return brace.start()
    raise UnsupportedTexError(f"unbalanced braces in {quoted(tex)}")


def replaced(
    tex: str, commands: re.Pattern[str], make: Callable[[str, list[str]], str], count: int
) -> str:
    """``tex`` with each command and its arguments given over to ``make``, from left to right."""
    parts, rest = [], 0
    while found := commands.search(tex, rest):
        given, end = arguments(tex, found.end(), count, found[0])
        parts += [tex[rest : found.start()], make(found[0], given)]
        rest = end
    return "".join([*parts, tex[rest:]])
