"""Restores the modules that edits share with the engine, whatever a reader's program has set."""

import sys
from types import ModuleType
from typing import Any

_namespaces: list[tuple[dict[str, Any], dict[str, Any]]] = []
"""The namespace of each module, and `sys.modules`, and what it held before any edit ran."""
_finders: list[tuple[list[Any], list[Any]]] = []
"""The lists by which modules are found, likewise."""


def restore_modules() -> None:
    """Undo what earlier edits have set in `builtins`, numpy and all other modules.

    The first call keeps what the modules hold. Nothing of `builtins` is used before it is restored.
    Submodules that were imported meanwhile stay.
    """
    for namespace, kept in _namespaces:
        namespace.update(kept)
    for entries, kept_entries in _finders:
        entries[:] = kept_entries
    for namespace, kept in _namespaces:
        for name in namespace.keys() - kept.keys():
            if type(namespace[name]) is not ModuleType:
                del namespace[name]
    if not _finders:
        _finders.extend((each, each.copy()) for each in (sys.meta_path, sys.path, sys.path_hooks))
    known = {id(namespace) for namespace, _ in _namespaces}
    modules = [module for module in sys.modules.values() if type(module) is ModuleType]
    for namespace in [*map(vars, modules), sys.modules]:
        if id(namespace) not in known:
            _namespaces.append((namespace, dict(namespace)))
