"""Values as bytes and back. Scenes and ladders are packed as the names of what holds them."""

import copyreg
import io
import pickle
import re
import sys
from collections.abc import Collection, Mapping
from importlib import import_module
from typing import Any

from simulations.engine.hard_cases import HardCases
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene

HOLDERS: Mapping[type, str] = {Scene: "SCENE", Ladder: "LADDER", HardCases: "TABLE"}
"""What is code and no plain data, and the name of a module's that holds it."""

_homes: dict[int, tuple[object, str | None]] = {}


def home_of(thing: object) -> str | None:
    """The module that holds a scene, ladder or table of hard cases, or that defines a function;
    None where there is none."""
    name = HOLDERS.get(type(thing))
    if name is None:
        return getattr(thing, "__module__", None)
    known = _homes.get(id(thing))
    if known is None or known[0] is not thing:
        modules = (module for module in list(sys.modules.values()) if module is not None)
        held = (module.__name__ for module in modules if vars(module).get(name) is thing)
        known = _homes[id(thing)] = (thing, next(held, None))
    return known[1]


def packed(value: object) -> bytes:
    buffer = io.BytesIO()
    packer = pickle.Pickler(buffer, protocol=pickle.HIGHEST_PROTOCOL)
    packer.dispatch_table = TABLE
    packer.dump(value)
    return buffer.getvalue()


def unpacked(data: bytes) -> Any:
    return pickle.loads(data)


def modules_in(value: object, packages: Collection[str]) -> frozenset[str] | None:
    """The modules below ``packages`` that something in ``value`` may be of; of what cannot be
    packed, nobody can say."""
    if isinstance(value, bytes | str):
        return frozenset()
    try:
        data = packed(value)
    except pickle.PicklingError:
        return None
    named = rf"(?:{'|'.join(map(re.escape, sorted(packages)))})(?:\.\w+)*"
    return frozenset(name.decode() for name in re.findall(named.encode(), data))


def _by_name(thing: Any) -> tuple[Any, tuple[str, str]]:
    home = home_of(thing)
    if home is None:
        raise pickle.PicklingError(f"{thing.id!r} is in no module")
    return _held, (home, HOLDERS[type(thing)])


def _held(module: str, name: str) -> Any:
    return getattr(import_module(module), name)


TABLE = {**copyreg.dispatch_table, **dict.fromkeys(HOLDERS, _by_name)}
"""How things are packed that are of no plain kind."""
