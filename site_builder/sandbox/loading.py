"""Scenes and ladders by their ids; one that cannot be loaded is an error of one sentence."""

import sys
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from importlib import import_module
from types import ModuleType

from simulations.registry import LADDER_MODULES, SCENE_MODULES, UnknownIdError
from site_builder.cache.hashing import source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import place_of, remember, words_of
from site_builder.diagnostics.diagnostic import cause
from site_builder.sandbox.pool import LimitError, run_limited

IMPORT_SECONDS = 15.0
"""Limit by the clock: an import computes little, and what waits in one waits for ever."""
MODULES = {"simulation": SCENE_MODULES, "ladder": LADDER_MODULES}


def loaded[T](kind: str, item_id: str, load: Callable[[str], T], error: type[Exception]) -> T:
    """What ``load`` makes of the id; an id that is not known, and whatever a scene's or ladder's
    own code may raise, is an ``error``. ``kind``: ``simulation`` or ``ladder``."""
    try:
        if module := MODULES[kind].get(item_id):
            imported(module)
        return load(item_id)
    except UnknownIdError as unknown:
        raise error(str(unknown)) from None
    except Exception as failure:
        raise error(f"{kind} {item_id!r} cannot be loaded: {cause(failure)}") from failure


def imported(module: str) -> ModuleType:
    """A module of the author's, which may raise whatever it likes. It is imported in the sandbox
    first: one that never ends, or ends its process, is an exception here."""
    if module not in sys.modules:
        _try_import(module, source_hash(module))
    return import_module(module)


def import_figures() -> None:
    """Import all scenes and ladders before a build asks for them, which then reports their
    errors."""
    for module in (*SCENE_MODULES.values(), *LADDER_MODULES.values()):
        with suppress(Exception):
            imported(module)


@cached
def _try_import(module: str, _sources: bytes) -> None:
    try:
        run_limited(partial(_import, module), IMPORT_SECONDS)
    except LimitError as error:
        place, words = place_of(error), words_of(error)
        if not place:  # it ended its process, at an unknown line
            place, words = f"{module.replace('.', '/')}.py:1", f"{words}, while it was imported"
        raise remember(error, place, words) from None


def _import(module: str) -> None:
    import_module(module)
