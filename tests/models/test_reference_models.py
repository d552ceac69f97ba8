"""Models that nothing in the page runs: they say so, and the book still asks them."""

import ast
import tomllib
from pathlib import Path

from simulations.registry import hard_case_tables
from site_builder.runtime.imports import Table, module_files, reach
from site_builder.runtime.pack import page_modules

SIMULATIONS = Path(__file__).resolve().parents[2] / "simulations"
MODELS = {
    name: file
    for name, file in module_files(SIMULATIONS).items()
    if name.startswith("simulations.models.") and file.stem != "__init__"
}


def is_marked(file: Path) -> bool:
    words = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
    return any(line.startswith("Reference: ") for line in words.splitlines())


def test_the_models_marked_as_reference_are_those_that_no_figure_and_no_ladder_imports(
    imports_of_the_book: Table,
) -> None:
    marked = {name for name, file in MODELS.items() if is_marked(file)}
    assert marked == MODELS.keys() - page_modules(imports_of_the_book)


def test_every_model_is_run_by_a_figure_or_a_ladder_or_asked_in_a_hard_case(
    imports_of_the_book: Table,
) -> None:
    tables = [tomllib.loads(file.read_text("utf-8")) for file in hard_case_tables().values()]
    named = {path.partition(":")[0] for table in tables for path in table["names"]}
    asked = [reach(imports_of_the_book, name) for name in named & imports_of_the_book.keys()]
    assert MODELS.keys() <= page_modules(imports_of_the_book).union(*asked)
