"""What the book has of hard cases and of illustrations, found as the builder finds it."""

from importlib import import_module

from simulations.registry import found

TABLES = tuple(import_module(module).TABLE for module in found("hard_cases").values())
ILLUSTRATIONS = {name: import_module(of).draw for name, of in found("illustrations").items()}
