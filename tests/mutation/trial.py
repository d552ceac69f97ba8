"""Run the tests of a module against a mutant of it, in a forked child of this process.

The tests and their oracles are imported once, by the parent; a child needs a second or less.
Nothing is written to the working copy, so that one may go on editing it.
"""

import ast
import contextlib
import functools
import gc
import importlib
import importlib.abc
import importlib.util
import os
import resource
import sys
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import HealthCheck, Phase, settings

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / "simulations" / "models"
PACKAGE = "simulations.models"
MEMORY_LIMIT = 4 << 30
"""Bytes of address space of a mutant that grows."""


class MutatedModule(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module from the given source and leaves all others to Python."""

    def __init__(self, name: str, source: str) -> None:
        self.name, self.source = name, source

    def find_spec(self, fullname: str, *_: object) -> ModuleSpec | None:
        return importlib.util.spec_from_loader(fullname, self) if fullname == self.name else None

    def exec_module(self, module: ModuleType) -> None:
        exec(compile(self.source, f"<mutant of {self.name}>", "exec"), module.__dict__)


@functools.cache
def imported_names(file: Path) -> frozenset[str]:
    """Modules that a file imports; ``from a import b`` counts as both a and a.b."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.add(node.module)
            names.update(f"{node.module}.{alias.name}" for alias in node.names)
    return frozenset(names)


def modules() -> list[str]:
    """Names of all model modules below ``simulations.models``: ``lens.thin_lens``."""
    files = (file.relative_to(MODELS) for file in MODELS.rglob("[!_]*.py"))
    return sorted(".".join(file.with_suffix("").parts) for file in files)


def file_of(module: str) -> Path:
    return MODELS.joinpath(*module.split(".")).with_suffix(".py")


def tests_of(module: str) -> list[Path]:
    """The test files of a model: those that import it, or else those nearest above it."""
    wanted = {f"{PACKAGE}.{module}"}
    tests = sorted((ROOT / "tests" / "models").rglob("test_*.py"))
    while not (found := [file for file in tests if wanted & imported_names(file)]):
        users = {f"{PACKAGE}.{m}" for m in modules() if wanted & imported_names(file_of(m))}
        if users <= wanted:
            break
        wanted |= users
    return found


def warm_up(tests: list[Path]) -> None:
    """Import what the tests need but the models themselves, which each child has to import."""
    for file in tests:
        for name in sorted(imported_names(file)):
            if name.split(".")[0] not in ("simulations", "support"):
                with contextlib.suppress(ImportError):
                    importlib.import_module(name)
    gc.freeze()  # else each child would look through all that the parent holds


def survives(module: str, source: str, tests: list[Path], limit_s: int) -> bool:
    """Whether all tests pass with this source; endless loops and memory count as noticed.

    The limit is one of processor time, so that a busy machine judges as a quiet one does.
    """
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CPU, (limit_s, limit_s))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
        _run_tests(module, source, tests)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status) == 0


def used_s() -> float:
    """Processor time of all children so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _run_tests(module: str, source: str, tests: list[Path]) -> None:
    """Never returns: the child ends with the exit code of pytest."""
    code = 1
    try:
        sys.stdout = sys.stderr = nowhere = Path(os.devnull).open("w")  # noqa: SIM115
        os.dup2(nowhere.fileno(), 1)
        os.dup2(nowhere.fileno(), 2)
        for name in [name for name in sys.modules if name.split(".")[0] == "simulations"]:
            del sys.modules[name]
        settings.register_profile(
            "mutation",
            derandomize=True,  # the same mutant is judged alike by every run
            database=None,
            deadline=None,
            phases=(Phase.explicit, Phase.generate),
            suppress_health_check=list(HealthCheck),
        )
        settings.load_profile("mutation")
        sys.meta_path.insert(0, MutatedModule(f"{PACKAGE}.{module}", source))
        os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
        without = "cacheprovider unraisableexception threadexception doctest junitxml faulthandler"
        options = ["-x", "-q", "--tb=native", "--noconftest", "--assert=plain", f"--rootdir={ROOT}"]
        options += [f"-pno:{plugin}" for plugin in without.split()]
        code = int(pytest.main([*options, *map(str, tests)]))
    finally:
        os._exit(code)
