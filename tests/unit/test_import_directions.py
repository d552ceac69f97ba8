"""Imports run downwards only: models, engine ← pictures ← ladders, scenes ← registry ← browser."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LEGAL = {
    "models": {"models"},
    "engine": {"engine"},
    "pictures": {"pictures", "models", "engine"},
    "extremes": {"extremes", "models", "engine"},
    "ladders": {"ladders", "pictures", "models", "engine"},
    "scenes": {"scenes", "ladders", "pictures", "models", "engine"},
    "registry": {"scenes", "ladders", "pictures", "models", "engine"},
    "browser": {"registry", "scenes", "ladders", "pictures", "models", "engine", "browser"},
}
"""Part of ``simulations`` to the parts that it may import."""


def imported_modules(file: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{file.name}: relative import"
            yield str(node.module)
            if node.module == "simulations":
                yield from (f"simulations.{alias.name}" for alias in node.names)


def part_of(file: Path) -> str:
    return file.relative_to(ROOT / "simulations").with_suffix("").parts[0]


FILES = sorted((ROOT / "simulations").rglob("*.py"))


def test_every_part_of_simulations_has_its_place() -> None:
    assert {part_of(file) for file in FILES} <= {*LEGAL, "__init__"}


@pytest.mark.parametrize("part", LEGAL)
def test_a_part_imports_only_what_lies_below_it(part: str) -> None:
    for file in (file for file in FILES if part_of(file) == part):
        for module in imported_modules(file):
            names = module.split(".")
            if names[0] == "simulations" and len(names) > 1:
                assert names[1] in LEGAL[part], f"{file.relative_to(ROOT)} imports {module}"


def test_simulations_need_only_numpy_and_the_standard_library() -> None:
    legal = {*sys.stdlib_module_names, "numpy", "simulations"}
    for file in FILES:
        for module in imported_modules(file):
            assert module.split(".")[0] in legal, f"{file.relative_to(ROOT)} imports {module}"
