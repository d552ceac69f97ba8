"""Scenes and ladders by their ids; one that cannot be loaded is an error of one sentence."""

import copyreg
import pickle
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from importlib import import_module
from typing import Any

from simulations.registry import (
    LADDER_MODULES,
    SCENE_MODULES,
    UnknownIdError,
    load_ladder,
    load_scene,
)
from site_builder.cache.hashing import HOLDERS, know_module, module_of, source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import place_of, remember, words_of
from site_builder.diagnostics.diagnostic import cause
from site_builder.sandbox.data import packed, unpacked
from site_builder.sandbox.pool import LimitError, copies, run_limited

MODULES = {"simulation": SCENE_MODULES, "ladder": LADDER_MODULES}


def loaded[T](kind: str, item_id: str, load: Callable[[str], T], error: type[Exception]) -> T:
    """What ``load`` makes of the id, as `held`; an id that is not known, and whatever a scene's or
    ladder's own code may raise, is an ``error``. ``kind``: ``simulation`` or ``ladder``."""
    try:
        return held(MODULES[kind].get(item_id, ""), partial(load, item_id))
    except UnknownIdError as unknown:
        raise error(str(unknown)) from None
    except Exception as failure:
        raise error(f"{kind} {item_id!r} cannot be loaded: {cause(failure)}") from failure


def held[T](module: str, get: Callable[[], T]) -> T:
    """What ``get`` finds in an author's module: within limits, a copy without code, made once in
    the sandbox."""
    known = copies()
    if known is None:
        return get()
    if module not in known:
        found = unpacked(_copied(module, get, source_hash(module)))
        known[module] = know_module(found, module)
    return known[module]  # type: ignore[no-any-return]


def read_figures() -> None:
    """Read all scenes and ladders before a build asks for them, which then reports their
    errors."""
    kinds: tuple[tuple[str, Callable[[str], object]], ...] = (
        ("simulation", load_scene),
        ("ladder", load_ladder),
    )
    for kind, load in kinds:
        for item_id in MODULES[kind]:
            with suppress(RuntimeError):
                loaded(kind, item_id, load, RuntimeError)


@cached
def _copied(module: str, get: Callable[[], object], _sources: bytes) -> bytes:
    try:
        return run_limited(partial(_packed, get))
    except LimitError as error:
        place, words = place_of(error), words_of(error)
        if not place and module:  # it ended its process, at an unknown line
            place, words = f"{module.replace('.', '/')}.py:1", f"{words}, while it was imported"
        raise remember(error, place, words) from None


def _packed(get: Callable[[], object]) -> bytes:
    return packed(get())


def _held(module: str, name: str) -> Any:
    return held(module, partial(_attribute, module, name))


def _attribute(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


def _by_name(value: Any) -> tuple[Any, tuple[str, str]]:
    module = module_of(value)
    if module is None:
        raise pickle.PicklingError(f"{value.id!r} is in no module")
    return _held, (module, HOLDERS[type(value)])


for _holder in HOLDERS:  # what is code is pickled as the name of it
    copyreg.pickle(_holder, _by_name)
