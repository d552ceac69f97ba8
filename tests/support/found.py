"""What the book has of hard cases and of illustrations, found as the builder finds it."""

from importlib import import_module

from simulations.engine.hard_cases import read_table
from simulations.registry import found, hard_case_tables

TABLES = tuple(
    read_table(name, file.read_text(encoding="utf-8")) for name, file in hard_case_tables().items()
)
ILLUSTRATIONS = {name: import_module(of).draw for name, of in found("illustrations").items()}
