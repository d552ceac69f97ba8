"""TeX to MathML, at build time. What cannot be set is an error, never garbled output.

Temml sets TeX as MathML, and the Speech Rule Engine puts it in words, in a process of Node that
answers line by line. It starts with the first formula that is not cached. Each process of a build
has its own.
"""

import atexit
import json
import os
import re
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from simulations.engine import frame
from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import unknown
from site_builder.diagnostics.progress import advance
from site_builder.files.folders import file_hash
from site_builder.programs.node import NODE, NodeError, installed_packages

COMMAND = re.compile(r"\\([A-Za-z]+)")


COMMA = re.compile(r"\\(?:text\w*|mbox|pu|ce|tag|class)\*?\{(?:[^{}]|\{[^{}]*\})*\}|(?<=\d),(?=\d)")
"""Commas between digits, outside of text: Temml would make one number of both."""


def common_tex(tex: str) -> str:
    r"""``%``, which begins a comment in TeX, as a percent sign, ``\bm`` by its other name, and
    lists of numbers, ``(0,4)``, with a space behind the comma."""
    tex = re.sub(r"\\bm\b", r"\\boldsymbol", tex)
    tex = COMMA.sub(lambda found: f"{found[0]} " if found[0] == "," else found[0], tex)
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


HERE = Path(__file__).parent
PROGRAM = HERE / "set.mjs"
SOURCES = (HERE / "package-lock.json", *sorted(HERE.glob("*.mjs")))
"""All that a formula's markup depends on."""


class TemmlError(RuntimeError):
    """Temml could not be had, or ended."""


def set_tex(
    tex: str, *, display: bool, spoken: bool, macros: Mapping[str, str]
) -> Mapping[str, str]:
    """``mathml``, an element with English words as ``alttext`` where it is ``spoken``, or
    ``error``; the names of ``macros`` have their backslashes. Raises `TemmlError`."""
    process = _process(os.getpid())
    assert process.stdin
    assert process.stdout
    try:
        request = {"tex": tex, "display": display, "spoken": spoken, "macros": dict(macros)}
        process.stdin.write(f"{json.dumps(request)}\n")
        process.stdin.flush()
        line = process.stdout.readline()
    except OSError:
        line = ""
    if not line:
        _process.cache_clear()
        raise TemmlError(f"Temml ended with exit code {process.wait()} at {tex!r}")
    answer: dict[str, str] = json.loads(line)
    return answer


@cache
def _process(_owner: int) -> subprocess.Popen[str]:
    """Temml for the process ``_owner``: a fork must not use its parent's."""
    try:
        packages = installed_packages(HERE)
    except NodeError as error:
        raise TemmlError(
            f"cannot get Temml from npm, which sets the formulae: {error}\n"
            "Connect to the internet once: it is kept and never requested again."
        ) from None
    command = [str(NODE), str(PROGRAM), str(packages)]
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    )
    atexit.register(_end, process, os.getpid())
    return process


def _end(process: subprocess.Popen[str], owner: int) -> None:
    if owner == os.getpid():
        process.communicate()


COLOURS = (*frame.ROLES[1:], "muted")
"""Roles of colours that a formula may name; frames also have the empty role."""
INSTEAD = {"tag": "a label behind the formula", "qty": r"'\pu{1.5 m}'"}
"""Commands of Temml with no meaning, or another than is likely meant; what is legal instead."""
EMPTY = r"a formula that shows nothing; legal: '$…$' around one, or '\$' for the sign itself"
UNKNOWN = re.compile(r"(?:Unsupported function name|Undefined control sequence): (\\\w+|\S+)")


type Macros = Mapping[str, str]
"""TeX commands of the book's own, without their backslashes, and what each stands for."""
NO_MACROS: Macros = {}
SPOKEN = "en"
"""The language in which formulae have words."""


class UnsupportedTexError(ValueError):
    """The formula cannot be set; the message names the part."""

    def __init__(self, message: str, above: int = 0) -> None:
        super().__init__(message)
        self.above = above
        """Lines of the formula above the part."""


def to_mathml(
    tex: str,
    *,
    display: bool,
    macros: Macros = NO_MACROS,
    language: str = SPOKEN,
    colours: Sequence[str] = (),
) -> str:
    """A ``<math>`` element, in English with words as ``alttext``. Besides `COLOURS` it may name
    the book's own. Raises `UnsupportedTexError`."""
    sources = tuple(file_hash(file) for file in SOURCES)
    named = _as_classes(tex, (*COLOURS, *colours))
    bodies = {name: _as_classes(body, (*COLOURS, *colours)) for name, body in macros.items()}
    return _to_mathml(named, display, language == SPOKEN, bodies, sources)


@cached
def _to_mathml(tex: str, display: bool, spoken: bool, macros: Macros, _sources: object) -> str:
    if not tex.strip():
        raise UnsupportedTexError(EMPTY)
    for name, legal in INSTEAD.items():
        if found := re.search(rf"\\{name}(?![A-Za-z])", tex):
            message = rf"\{name} in {quoted(tex)}; legal: {legal}"
            raise UnsupportedTexError(message, tex.count("\n", 0, found.start()))
    bodies = {f"\\{name}": common_tex(body) for name, body in macros.items()}
    common = common_tex(tex)
    answer = set_tex(common, display=display, spoken=spoken, macros=bodies)
    advance()
    if "error" in answer:
        above = common.count("\n", 0, _place(common, int(answer.get("position", 0))))
        raise UnsupportedTexError(_in_words(answer["error"], tex), above)
    mathml = answer["mathml"]
    if not re.search(r">[^<\s]", mathml):
        raise UnsupportedTexError(EMPTY)
    return mathml


def _place(tex: str, met: int) -> int:
    """Where a mistake is that is ``met`` somewhere: of what is never closed, its brace."""
    opened: list[int] = []
    for found in re.finditer(r"\\.|[{}]", tex) if met >= len(tex) else ():
        if found[0] == "{":
            opened.append(found.start())
        elif found[0] == "}" and opened:
            opened.pop()
    return opened[-1] if opened else met


def quoted(tex: str) -> str:
    r"""TeX as its author wrote it, on one line: ``'\frac{a}{b}'``, its backslashes single."""
    return f"'{' '.join(tex.split())}'"


def _as_classes(tex: str, colours: Sequence[str]) -> str:
    """With its colours as classes."""

    def named(match: re.Match[str]) -> str:
        if match[1] not in colours:
            raise UnsupportedTexError(unknown("colour role", match[1], colours))
        return rf"\class{{role-{match[1]}}}"

    return re.sub(r"\\role\{([\w-]*)\}", named, tex)


def _in_words(message: str, tex: str) -> str:
    """Temml's message, with the formula."""
    if found := UNKNOWN.match(message):
        return f"unsupported TeX command '{found[1]}' in {quoted(tex)}"
    return f"cannot set {quoted(tex)}: {message[:1].lower()}{message[1:]}"
