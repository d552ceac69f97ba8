"""Whose book it is: the one around the engine, or that in the folder which ``BOOK`` names.

    python -m site_builder build
    BOOK=tests/waves_book python -m site_builder build

The engine is this package, ``static/`` and `ENGINE_PARTS` of ``simulations``. All else is a book's:
``content/`` and the other parts of ``simulations``, such as scenes, ladders and models. Where the
book lies elsewhere, ``simulations`` is made of the engine's parts and that book's, and nothing of
the book around the engine can be imported.
"""

import os
import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType

import simulations

ENGINE = Path(__file__).resolve().parents[1]
"""The engine's folder."""
ENGINE_PARTS = ("browser", "editing", "engine", "late_imports", "registry", "script")
"""Packages and modules right below ``simulations``."""
VARIABLE = "BOOK"
"""Of the environment, so that the processes which a build starts know it too."""


def is_engine(module: str) -> bool:
    """Whether a module of ``simulations``, by its full name, is the engine's and no book's."""
    _, _, part = module.partition(".")
    return not part or part.partition(".")[0] in ENGINE_PARTS


def own_or_engine(root: Path, path: str) -> Path:
    """The file or folder ``path`` of the book at ``root`` or, where it has none, the engine's."""
    own = root / path
    return own if own.exists() else ENGINE / path


class EngineFinder:
    """Finds the engine's parts of ``simulations`` in the engine's folder, whatever a book has."""

    def find_spec(
        self, name: str, _path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        package, _, part = name.partition(".")
        if package != "simulations" or part not in ENGINE_PARTS:
            return None
        return PathFinder.find_spec(name, [str(ENGINE / "simulations")], target)


def _open(root: Path) -> Path:
    """From here on, ``simulations`` is that of the book at ``root``. Raises `SystemExit`."""
    if not (root / "content").is_dir():
        raise SystemExit(f"{VARIABLE}={root} is no book; legal: a folder that holds content/")
    if root != ENGINE:
        sys.meta_path.insert(0, EngineFinder())
        simulations.__path__ = [str(root / "simulations")]
    return root


ROOT = _open(Path(os.environ.get(VARIABLE) or ENGINE).resolve())
"""The book's folder."""
