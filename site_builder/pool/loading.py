"""Scenes and ladders by their ids, as copies without code; one that cannot be loaded is an error of
one sentence."""

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
from site_builder.diagnostics.blame import in_module
from site_builder.diagnostics.diagnostic import cause
from site_builder.pool.processes import copies, packed, run_in_pool

MODULES = {"simulation": SCENE_MODULES, "ladder": LADDER_MODULES}


def loaded[T](kind: str, item_id: str, load: Callable[[str], T], error: type[Exception]) -> T:
    """What ``load`` makes of the id, as `copy_of`; an id that is not known, and whatever a scene's
    or ladder's own code may raise, is an ``error``. ``kind``: ``simulation`` or ``ladder``."""
    try:
        return copy_of(MODULES[kind].get(item_id, ""), partial(load, item_id))
    except UnknownIdError as unknown:
        raise error(str(unknown)) from None
    except Exception as failure:
        raise error(f"{kind} {item_id!r} cannot be loaded: {cause(failure)}") from failure


def copy_of[T](module: str, get: Callable[[], T]) -> T:
    """What ``get`` finds in an author's module: with a pool a copy without code, made once."""
    known = copies()
    if known is None:
        return get()
    if module not in known:
        with in_module(module):
            copy = pickle.loads(_packed_copy(module, get, source_hash(module)))
        known[module] = know_module(copy, module)
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
def _packed_copy(module: str, get: Callable[[], object], _sources: bytes) -> bytes:
    return run_in_pool(partial(_packed, get), of=module)


def _packed(get: Callable[[], object]) -> bytes:
    return packed(get())


def _copy(module: str, name: str) -> Any:
    return copy_of(module, partial(_attribute, module, name))


def _attribute(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


def _by_name(value: Any) -> tuple[Any, tuple[str, str]]:
    module = module_of(value)
    if module is None:
        raise pickle.PicklingError(f"{value.id!r} is in no module")
    return _copy, (module, HOLDERS[type(value)])


for _holder in HOLDERS:  # what is code is pickled as the name of it
    copyreg.pickle(_holder, _by_name)
