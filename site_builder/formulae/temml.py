"""Temml, which sets TeX as MathML, and the Speech Rule Engine, which puts it in words: a process of
Node that answers line by line.

It starts with the first formula that is not cached. Each process of a build has its own.
"""

import atexit
import json
import os
import re
import subprocess
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from site_builder.programs.node import NODE, NodeError, installed_packages

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


HERE = Path(__file__).parent
PROGRAM = HERE / "set.mjs"
SOURCES = (HERE / "package-lock.json", *sorted(HERE.glob("*.mjs")))
"""All that a formula's markup depends on."""


class TemmlError(RuntimeError):
    """Temml could not be had, or ended."""


class TexError(ValueError):
    """Temml refuses the formula; the message is its own."""


def set_tex(tex: str, *, display: bool, spoken: bool, macros: Mapping[str, str]) -> str:
    """A ``<math>`` element, with English words as ``alttext`` where it is ``spoken``; the names of
    ``macros`` have their backslashes. Raises `TexError` and `TemmlError`."""
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
    answer = json.loads(line)
    if "error" in answer:
        raise TexError(answer["error"])
    return str(answer["mathml"])


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
