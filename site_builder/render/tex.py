"""Formulae as TeX, for what sets them by itself: MathJax in notebooks and in Moodle."""

import re
from collections.abc import Mapping


def plain_tex(tex: str, macros: Mapping[str, str]) -> str:
    r"""A formula with the commands of the book's own that it uses defined in it, ``%`` as a sign,
    ``\bm`` by its other name, and without colours."""
    tex = re.sub(r"\\role\{[\w-]*\}", "", tex.strip())
    tex = re.sub(r"\\bm\b", r"\\boldsymbol", tex)
    tex = re.sub(r"\\.|%", lambda sign: r"\%" if sign[0] == "%" else sign[0], tex)
    return f"{_definitions(tex, macros)}{tex}"


def _definitions(tex: str, macros: Mapping[str, str]) -> str:
    r"""``\def\R{\mathbb{R}}`` for each that the formula uses, also by way of another."""
    used: dict[str, str] = {}
    left = re.findall(r"\\([A-Za-z]+)", tex)
    while left:
        name = left.pop()
        if name in macros and name not in used:
            used[name] = macros[name]
            left += re.findall(r"\\([A-Za-z]+)", macros[name])
    return "".join(f"\\def\\{name}{_places(body)}{{{body}}}" for name, body in used.items())


def _places(body: str) -> str:
    """``#1#2`` where it has two arguments."""
    count = max((int(digit) for digit in re.findall(r"#(\d)", body)), default=0)
    return "".join(f"#{place + 1}" for place in range(count))
