"""The folders of this book and of the German one, and the book's illustrations and tables of hard
cases."""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path

from simulations.engine.hard_cases import HardCases, read_table
from simulations.engine.illustration import Illustration
from simulations.registry import hard_case_tables, modules_in

ROOT = Path(__file__).resolve().parents[2]
GERMAN_BOOK = ROOT / "tests" / "fixtures" / "german-book"
SCENES = {name: f"simulations.scenes.{name}.scene" for name in ("fadenpendel", "saite")}
LADDERS = {"tonhoehe": "simulations.ladders.tonhoehe"}
"""The modules of the German book, by id."""


@cache
def hard_cases() -> tuple[HardCases, ...]:
    """The book's tables of hard cases."""
    tables = hard_case_tables().items()
    return tuple(read_table(name, file.read_text(encoding="utf-8")) for name, file in tables)


@cache
def illustrations() -> dict[str, Callable[[], Illustration]]:
    """The functions that draw the book's illustrations, by id."""
    return {
        name: import_module(module).draw for name, module in modules_in("illustrations").items()
    }
