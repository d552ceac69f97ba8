"""Temml, which sets TeX as MathML, and the Speech Rule Engine, which says it in words: a process of
Node that answers line by line.

It starts with the first formula that is not cached. Each process of a build has its own.
"""

import atexit
import json
import os
import subprocess
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from site_builder.programs.node import NODE, NodeError, installed_packages

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
    """Of the process ``_owner``: a fork must not talk to its parent's."""
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
