r"""TeX commands of an author's own: ``R = '\mathbb{R}'``, ``norm = '\lVert #1 \rVert'``."""

import re
from collections.abc import Iterator, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter

from site_builder.markdown.text.math import UnsupportedTexError, quoted
from site_builder.markdown.text.tex_arguments import arguments

NAME = re.compile(r"[A-Za-z]+")
COMMAND = re.compile(r"\\([A-Za-z]+)")
SLOT = re.compile(r"#([1-9])")
OURS = (
    "calc",
    "role",
    "qty",
    "SI",
    "unit",
    "si",
    "num",
    "ce",
    "tag",
    "bm",
    "begin",
    "end",
    "left",
    "right",
)
LONGEST = 10_000
"""Characters of a formula whose macros are written out: some double what they are given."""

type Macros = Mapping[str, str]
"""What each command, named without its backslash, stands for."""


def faults_of(macros: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    """Names of macros that cannot be, each with what is wrong."""
    sound: dict[str, str] = {}
    for name, body in macros.items():
        fault = _fault_of(name, body)
        if fault:
            yield name, fault
        else:
            sound[name] = str(body)
    uses = {name: {n for n in COMMAND.findall(body) if n in sound} for name, body in sound.items()}
    while circle := _circle(uses):
        way = " → ".join(f"\\{name}" for name in circle)
        yield circle[0], f"goes round in a circle: {way}; legal: macros that end"
        del uses[circle[0]]


def _circle(uses: Mapping[str, set[str]]) -> list[str]:
    """Macros each of which uses the next, and the last the first; nothing where none do."""
    try:
        TopologicalSorter(uses).prepare()
    except CycleError as error:
        return list(reversed(error.args[1]))
    return []


def _fault_of(name: str, body: object) -> str:
    if not NAME.fullmatch(name):
        return "is no name; legal: letters, without a backslash"
    if not isinstance(body, str) or not body.strip():
        return "stands for nothing; legal: TeX between single quotes"
    if name in OURS:
        return "is a command of the book; legal: a name of your own"
    slots = {int(slot) for slot in SLOT.findall(body)}
    if slots != set(range(1, len(slots) + 1)):
        missing = min(set(range(1, max(slots))) - slots)
        return f"takes #{max(slots)} but no #{missing}; legal: #1, #2, … without a gap"
    depth = 0
    for brace in re.findall(r"\\.|[{}]", body, re.DOTALL):
        depth += {"{": 1, "}": -1}.get(brace, 0)
        if depth < 0:
            break
    return f"has unbalanced braces in {quoted(body)}" if depth else ""


def _filled(body: str, given: Sequence[str]) -> str:
    return SLOT.sub(lambda slot: given[int(slot[1]) - 1], body)


def expanded(tex: str, macros: Macros) -> str:
    """``tex`` with its macros written out; they are free of circles. Raises
    `UnsupportedTexError`."""
    rest = 0
    while found := COMMAND.search(tex, rest):
        body = macros.get(found[1])
        if body is None:
            rest = found.end()
            continue
        count = len(set(SLOT.findall(body)))
        given, end = arguments(tex, found.end(), count, found[0])
        made = _filled(body, given)
        # In braces, so that an index below it is one of the whole; after them no space is needed.
        tex = f"{tex[: found.start()]}{{{made}}}{tex[end:]}"
        rest = found.start()
        if len(tex) > LONGEST:
            expected = "a shorter one"
            raise UnsupportedTexError(
                f"{found[0]} makes a formula of over {LONGEST} characters; legal: {expected}"
            )
    return tex
