"""The modules that a process has imported, and how it lets go of some, to import them as they are
now."""

import importlib
import sys
from collections.abc import Collection
from contextlib import suppress
from importlib.util import cache_from_source
from pathlib import Path

OF_A_BOOK = "simulations."
"""What modules begin with that the builder asks for by their names, and never imports itself."""


def may_let_go(modules: Collection[str]) -> bool:
    """Whether no others hold them: the builder holds what it has imported."""
    return all(name.startswith(OF_A_BOOK) for name in modules)


def let_go(modules: Collection[str]) -> None:
    """Who imports one of them next runs its source as it is then. All that import one of them must
    be among them."""
    for name in modules:
        module = sys.modules.pop(name, None)
        package, _, attribute = name.rpartition(".")
        if parent := sys.modules.get(package):
            vars(parent).pop(attribute, None)  # where `from package import module` looks first
        if file := getattr(module, "__file__", None):
            _remove_older_byte_code(Path(file))
    importlib.invalidate_caches()


def _remove_older_byte_code(file: Path) -> None:
    """Python knows by whole seconds which source it is of, and an author may save twice in one."""
    byte_code = Path(cache_from_source(str(file)))
    with suppress(OSError):
        if byte_code.stat().st_mtime_ns <= file.stat().st_mtime_ns:
            byte_code.unlink()
