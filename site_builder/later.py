"""Modules that are imported when something of them is first used."""

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


class _Later(ModuleType):
    """Stands for a module until then; afterwards it has all that the module has."""

    def __getattr__(self, attribute: str) -> Any:
        if sys.modules.get(self.__name__) is self:
            del sys.modules[self.__name__]
        module = import_module(self.__name__)
        found = getattr(module, attribute)
        self.__dict__.update(vars(module))
        return found


def import_later(name: str) -> None:
    """Whoever imports that module from here on has it, and waits for it only when it is used.

    Importlib's `LazyLoader` is of no use here: to import the module again is use enough for it.
    """
    sys.modules.setdefault(name, _Later(name))
