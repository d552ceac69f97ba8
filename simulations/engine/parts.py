"""Python's library and numpy come to the browser in parts; what is asked for first comes last."""

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType


class PartFinder:
    """Finds modules in parts that have not been fetched yet: the last finder that is asked.

    The page fetches ahead what its scenes are known to import. This is for all the rest: a
    module that a library imports in the midst of a function, say.
    """

    def __init__(self, part_of: Mapping[str, str], fetch: Callable[[str], None], folder: str):
        self._part_of = part_of
        self._fetch = fetch
        self._folder = folder

    def find_spec(
        self, name: str, _path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        """Where the module is, once its part has been fetched; None if it is in no part.

        Raises `ImportError` where the part cannot be had.
        """
        part = self._part_of.get(name)
        if part is None:
            return None
        try:
            self._fetch(part)
        except Exception as error:  # whatever keeps the page from having it
            raise ImportError(f"{part} could not be fetched: {error}", name=name) from error
        PathFinder.invalidate_caches()
        parent = name.rpartition(".")[0].replace(".", "/")
        return PathFinder.find_spec(name, [str(Path(self._folder) / parent)], target)


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
