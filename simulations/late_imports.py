"""Python's library and numpy come to the browser in parts; what is asked for first comes last."""

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
    """Finds modules in parts that have not been fetched yet: the last finder that is asked.

    The page fetches ahead what its scenes are known to import. This is for all the rest: a
    module that a library imports in the midst of a function, say.
    """

    def __init__(self, part_of: Mapping[str, str], fetch: Callable[[str], None], folder: str):
        self._part_of = part_of
        self._fetch = fetch
        self._folder = folder
        self._fetching: set[str] = set()

    def find_spec(
        self, name: str, _path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        """Where the module is, once its part has been fetched; None if it is in no part.

        Raises `ImportError` where the part cannot be had.
        """
        part = self._part_of.get(name)
        if part is None or part in self._fetching:
            return None
        self._fetching.add(part)  # what unpacking imports cannot come out of the same archive
        try:
            self._fetch(part)
        except Exception as error:  # whatever keeps the page from having it
            raise ImportError(f"{part}: {error}", name=name) from error
        finally:
            self._fetching.remove(part)
        parent = name.rpartition(".")[0].replace(".", "/")
        # A new finder, for those in use may not have noticed yet that there are new files.
        return FileFinder(str(Path(self._folder) / parent), *LOADERS).find_spec(name, target)


def fetch_missing(modules: str, fetch: Callable[[str], None], folder: str) -> None:
    """From now on, importing a module of a part has the part fetched.

    Parameters
    ----------
    modules
        JSON object of each part to the names of its modules.
    fetch
        Has the part of that name unpacked in ``folder`` when it returns.
    folder
        A folder in which modules are looked for.
    """
    part_of = {name: part for part, names in json.loads(modules).items() for name in names}
    sys.meta_path.append(PartFinder(part_of, fetch, folder))
