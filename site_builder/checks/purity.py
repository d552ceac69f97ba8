"""Clocks and chance in the simulations' sources: what would draw another picture next time."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from site_builder.diagnostics import Diagnostics

FREE = ("engine", "editing")
"""Folders below ``simulations/`` that belong to no scene."""
HINT = re.compile(r"time|random|uuid|secrets")
"""Stands in every source that could hold any of it."""
CLOCKS = (
    "time", "datetime.datetime.now", "datetime.datetime.today", "datetime.datetime.utcnow",
    "datetime.date.today",
)  # fmt: skip
CHANCE = ("secrets", "uuid.uuid1", "uuid.uuid4", "os.urandom", "os.getrandom", "random")
SEEDED = (
    "default_rng", "RandomState", "SeedSequence", "PCG64", "PCG64DXSM", "Philox", "MT19937",
    "SFC64",
)  # fmt: skip
"""Of ``numpy.random``: a generator that takes a seed."""
TYPES = ("Generator", "BitGenerator")


def check_purity(simulations: Path, problems: Diagnostics) -> None:
    """Report them in all that scenes, ladders and illustrations may call."""
    for file in sorted(simulations.rglob("*.py")):
        folders = file.relative_to(simulations).parts[:-1]
        if not folders or folders[0] in FREE:
            continue
        source = file.read_bytes().decode("utf-8", errors="replace")
        if HINT.search(source):
            path = file.relative_to(simulations.parent).as_posix()
            for line, message in impurities(source):
                problems.add(path, line, message)


def impurities(source: str) -> Iterator[tuple[int, str]]:
    """Lines of ``source`` that ask a clock or unseeded chance; none of what is no Python."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError):  # told where it is imported
        return
    names = dict(_imported(tree))
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        called = _dotted(node.func, names)
        if any(called == clock or called.startswith(f"{clock}.") for clock in CLOCKS):
            yield node.lineno, f"{called}() asks a clock; legal: what settings say alone"
        elif _is_chance(called, node):
            expected = "numpy.random.default_rng(seed), its seed a setting or a number"
            yield node.lineno, f"{called}() is chance without a seed; legal: {expected}"


def _is_chance(called: str, call: ast.Call) -> bool:
    package, _, name = called.rpartition(".")
    given = [*call.args, *(keyword.value for keyword in call.keywords)]
    has_seed = any(not (isinstance(one, ast.Constant) and one.value is None) for one in given)
    if package == "numpy.random":
        return name not in TYPES and not (name in SEEDED and has_seed)
    if called == "random.Random":
        return not has_seed
    return any(called == one or called.startswith(f"{one}.") for one in CHANCE)


def _imported(tree: ast.Module) -> Iterator[tuple[str, str]]:
    """What each imported name stands for."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                name = alias.asname or alias.name.partition(".")[0]
                yield name, alias.name if alias.asname else name
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}"


def _dotted(node: ast.expr, names: dict[str, str]) -> str:
    """``numpy.random.normal`` of ``np.random.normal``; nothing of what was not imported."""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.Attribute):
        around = _dotted(node.value, names)
        return f"{around}.{node.attr}" if around else ""
    return ""
