"""Formulae as their authors write them, for what sets TeX: Temml, and MathJax elsewhere."""

import re
from collections.abc import Mapping

COMMAND = re.compile(r"\\([A-Za-z]+)")


def common_tex(tex: str) -> str:
    r"""``%``, which begins a comment in TeX, as a percent sign, and ``\bm`` by its other name."""
    tex = re.sub(r"\\bm\b", r"\\boldsymbol", tex)
    return re.sub(r"\\.|%", lambda sign: r"\%" if sign[0] == "%" else sign[0], tex)


def plain_tex(tex: str, macros: Mapping[str, str]) -> str:
    r"""`common_tex` without colours; the commands of the book's own that the formula uses are
    defined in it: ``\def\R{\mathbb{R}}``."""
    used: dict[str, str] = {}
    left = COMMAND.findall(tex)
    while left:
        name = left.pop()
        if name in macros and name not in used:
            used[name] = _without_colours(macros[name])
            left += COMMAND.findall(macros[name])
    defined = (f"\\def\\{name}{_places(body)}{{{body}}}" for name, body in used.items())
    return f"{''.join(defined)}{_without_colours(tex.strip())}"


def _without_colours(tex: str) -> str:
    return common_tex(re.sub(r"\\role\{[\w-]*\}", "", tex))


def _places(body: str) -> str:
    """``#1#2`` where it has two arguments."""
    count = max((int(digit) for digit in re.findall(r"#(\d)", body)), default=0)
    return "".join(f"#{place + 1}" for place in range(count))
