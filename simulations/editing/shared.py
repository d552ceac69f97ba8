"""Restores the modules that edits share with the engine, whatever a reader's program has set."""

import sys
from types import ModuleType
from typing import Any

HEAP, IMMUTABLE = 1 << 9, 1 << 8
"""Flags of classes (`Py_TPFLAGS_HEAPTYPE`, `Py_TPFLAGS_IMMUTABLETYPE` in `object.h`)."""
_namespaces: list[tuple[dict[str, Any], dict[str, Any]]] = []
"""The namespace of each module, and `sys.modules`, with its contents before any edit ran."""
_classes: list[tuple[type, dict[str, Any]]] = []
"""Each changeable class of the modules, with its attributes before any edit ran."""
_finders: list[tuple[list[Any], list[Any]]] = []
"""The lists by which modules are found, with their contents before any edit ran."""


def restore_modules() -> None:
    """Undo the changes of earlier edits to `builtins`, numpy, all other modules and their classes.

    The first call stores the contents of the modules. Nothing of `builtins` is used before it is
    restored. Submodules that were imported meanwhile stay.
    """
    for namespace, stored_values in _namespaces:
        namespace.update(stored_values)
    for entries, kept_entries in _finders:
        entries[:] = kept_entries
    for namespace, stored_values in _namespaces:
        for name in namespace.keys() - stored_values.keys():
            if type(namespace[name]) is not ModuleType:
                del namespace[name]
    for kind, stored_values in _classes:
        for name, value in stored_values.items():
            if vars(kind).get(name) is not value:
                type.__setattr__(kind, name, value)
        for name in vars(kind).keys() - stored_values.keys():
            type.__delattr__(kind, name)
    if not _finders:
        lists = (sys.meta_path, sys.path, sys.path_hooks)
        _finders.extend((finders, finders.copy()) for finders in lists)
    known = {id(namespace) for namespace, _ in _namespaces}
    modules = [module for module in sys.modules.values() if type(module) is ModuleType]
    for namespace in [*map(vars, modules), sys.modules]:
        if id(namespace) not in known:
            _namespaces.append((namespace, dict(namespace)))
    stored = {id(kind) for kind, _ in _classes}
    values = (value for module in modules for value in vars(module).values())
    for kind in {value for value in values if isinstance(value, type)}:
        can_be_set = kind.__flags__ & (HEAP | IMMUTABLE) == HEAP
        if can_be_set and id(kind) not in stored:
            _classes.append((kind, dict(vars(kind))))
