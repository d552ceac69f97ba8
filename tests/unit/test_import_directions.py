"""Imports run downwards only: models, engine ← pictures ← ladders, scenes ← registry ← browser,
and models, engine ← illustrations;
among the models from numbers over light to files, inside the builder from its sources to its pages.
Nowhere do files import each other in a circle."""

import ast
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from site_builder.book_root import ENGINE_PARTS

ROOT = Path(__file__).resolve().parents[2]
LEGAL = {
    "models": {"models"},
    "engine": {"engine"},
    "pictures": {"pictures", "models", "engine"},
    "hard_cases": {"hard_cases", "models", "engine"},
    "illustrations": {"illustrations", "models", "engine"},
    "ladders": {"ladders", "pictures", "models", "engine"},
    "scenes": {"scenes", "ladders", "pictures", "models", "engine"},
    "registry": {"engine"},
    "editing": {"editing", "engine"},
    "late_imports": set(),
    "script": {"registry", "engine"},
    "browser": {"registry", "editing", "late_imports", "script", "engine"},
}
"""Part of ``simulations`` to the parts that it may import."""

MODELS = (
    "arrays", "require", "whole_numbers", "error_measures", "pixel_grid", "color", "geometry",
    "projection", "light", "distortion", "sampling", "lens", "sensor", "compression",
)  # fmt: skip
"""Rooms of ``simulations/models``: each imports itself and what stands before it."""

BUILDER = (
    "later", "blame", "raised", "book_root", "forking", "diagnostics", "kept", "drawing",
    "addresses", "source_text", "languages", "settings", "references", "runtime",
    "editor", "formulae", "output",
    "offline", "benchmarks", "charts", "page_model", "book", "markdown",
    "lecture_plan", "chapters", "source", "search", "pages", "checks", "publishing", "tools",
    "browser_python",
    "browser_python",
    "site_assets", "build", "diagnostic_formats", "check_command", "editions",
    "server", "scaffold", "guide", "__main__",
)  # fmt: skip
"""Parts of ``site_builder``, likewise."""
MARKDOWN = (
    "text", "targets", "parse_context", "files", "scenes", "headings", "role", "roles", "inline",
    "directive", "questions", "usage", "blocks", "bodies", "fences",
    "directives", "numbering", "first_marks", "parser", "glossary_links", "chapter",
)  # fmt: skip
"""Parts of ``site_builder/markdown``, likewise."""


@cache
def imported_modules(file: Path) -> tuple[str, ...]:
    return tuple(read_imports(file))


def read_imports(file: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{file.name}: relative import"
            yield str(node.module)
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def part_of(file: Path) -> str:
    return file.relative_to(ROOT / "simulations").with_suffix("").parts[0]


ENGINE_TESTS = ("builder", "editing", "unit", "books")
"""Folders whose tests say nothing of this book."""
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


def test_the_engine_imports_nothing_of_a_book() -> None:
    """Neither do the builder and their tests: what a book has is found, and handed to them."""
    own = [file for file in FILES if part_of(file) in ENGINE_PARTS]
    rooms = ["site_builder", *(f"tests/{room}" for room in ENGINE_TESTS)]
    for file in (*own, *(file for room in rooms for file in sorted((ROOT / room).rglob("*.py")))):
        for module in imported_modules(file):
            package, _, rest = module.partition(".")
            if package == "simulations" and rest:
                part = rest.partition(".")[0]
                assert part in ENGINE_PARTS, f"{file.relative_to(ROOT)} imports {module}"


def test_simulations_need_only_numpy_and_the_standard_library() -> None:
    legal = {*sys.stdlib_module_names, "numpy", "simulations"}
    for file in FILES:
        for module in imported_modules(file):
            assert module.split(".")[0] in legal, f"{file.relative_to(ROOT)} imports {module}"


def modules_of(package: Path) -> dict[str, Path]:
    """Every file of ``package`` by the name of its module; a package's is its ``__init__``."""
    files = sorted(package.rglob("*.py"))
    names = [file.relative_to(ROOT).with_suffix("").parts for file in files]
    return {
        ".".join(name).removesuffix(".__init__"): f for name, f in zip(names, files, strict=True)
    }


def test_no_files_import_each_other_in_a_circle() -> None:
    modules = modules_of(ROOT / "simulations") | modules_of(ROOT / "site_builder")
    graph = {
        name: {other for other in imported_modules(file) if other in modules}
        for name, file in modules.items()
    }
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" → ".join(reversed(error.args[1])))


@pytest.mark.parametrize(
    ("room", "order"),
    [
        ("simulations.models", MODELS),
        ("site_builder", BUILDER),
        ("site_builder.markdown", MARKDOWN),
    ],
)
def test_a_part_imports_only_what_stands_before_it(room: str, order: Sequence[str]) -> None:
    prefix = f"{room}."
    for module, file in modules_of(ROOT.joinpath(*room.split("."))).items():
        if module == room:
            continue
        part = module.removeprefix(prefix).partition(".")[0]
        assert part in order, f"{file.relative_to(ROOT)} has no place in the order of {room}"
        for other in imported_modules(file):
            below = other.removeprefix(prefix).partition(".")[0]
            if other.startswith(prefix) and below in order:
                fault = f"{file.relative_to(ROOT)} imports {other}"
                assert order.index(below) <= order.index(part), fault
