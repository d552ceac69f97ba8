"""Imports modules of the standard library and numpy that the browser has not fetched yet."""

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib.machinery import (
    BYTECODE_SUFFIXES,
    EXTENSION_SUFFIXES,
    SOURCE_SUFFIXES,
    ExtensionFileLoader,
    FileFinder,
    ModuleSpec,
    SourceFileLoader,
    SourcelessFileLoader,
)
from pathlib import Path
from types import ModuleType

LOADERS = (
    (ExtensionFileLoader, EXTENSION_SUFFIXES),
    (SourceFileLoader, SOURCE_SUFFIXES),
    (SourcelessFileLoader, BYTECODE_SUFFIXES),
)


class PartFinder:
    """Finds modules in parts that have not been fetched yet; the last finder in `sys.meta_path`.

    The page prefetches the modules that its scenes are known to import. This finder is for all
    others, such as a module that a library imports within a function.
    """

    def __init__(self, part_of: Mapping[str, str], fetch: Callable[[str], None], folder: str):
        self._part_of = part_of
        self._fetch = fetch
        self._folder = folder
        self._fetching: set[str] = set()

    def find_spec(
        self, name: str, _path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        """The module's spec, after fetching its part; None if it is in no part.

        Raises `ImportError` if the part cannot be fetched.
        """
        part = self._part_of.get(name)
        if part is None or part in self._fetching:
            return None
        self._fetching.add(
            part
        )  # unpacking imports modules itself; those cannot be in the same archive
        try:
            self._fetch(part)
        except Exception as error:  # the fetch may fail in any way
            raise ImportError(f"{part}: {error}", name=name) from error
        finally:
            self._fetching.remove(part)
        parent = name.rpartition(".")[0].replace(".", "/")
        # A new finder, as the existing ones may have cached the listing of the folder.
        return FileFinder(str(Path(self._folder) / parent), *LOADERS).find_spec(name, target)


def fetch_missing(modules: str, fetch: Callable[[str], None], folder: str) -> None:
    """Fetch a part from now on when one of its modules is imported.

    Parameters
    ----------
    modules
        JSON object of each part to the names of its modules.
    fetch
        Fetches the part of that name and unpacks it in ``folder``.
    folder
        A folder on the import path.
    """
    part_of = {name: part for part, names in json.loads(modules).items() for name in names}
    sys.meta_path.append(PartFinder(part_of, fetch, folder))
