"""The Python of every scene as its readers open it: a file each, fetched when one is opened."""

import ast
import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, partial
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

from simulations.editing.definitions import (
    Definition,
    defined_name,
    definitions,
    home,
    is_editable,
    module_source,
)
from simulations.engine.scene import Scene
from site_builder.cache.results import cached
from site_builder.pool.processes import run_in_pool
from site_builder.runtime.imports import is_module


@dataclass(frozen=True, slots=True)
class Module:
    """A module that readers may look into."""

    name: str
    source: str
    definitions: Mapping[str, Definition]
    imported: Mapping[str, str]
    """Names that it imports from editable modules: to ``MODULE`` or ``MODULE:NAME``."""
    mentions: Mapping[str, tuple[str, ...]]
    """Each definition to the names in it, those of attributes with a dot, in order."""


@cached
def scene_sources(scene: Scene[Any]) -> bytes:
    """What makes the frames of ``scene``, as JSON.

    ``draw`` and ``stages`` name definitions, ``MODULE:NAME``, and so does ``formula``, empty where
    the scene has none; ``definitions`` holds these and all that they use, however indirectly: each
    with its file, first line, text, a hash of the text, and what it uses itself. What lies outside
    the editable modules is left out.
    """
    return run_in_pool(partial(_scene_sources, scene))


def _scene_sources(scene: Scene[Any]) -> bytes:
    formula = _home(scene.formula) if scene.formula else ""
    stages = [{"name": stage.name, "definition": _home(stage.compute)} for stage in scene.stages]
    drawn = _home(scene.draw)
    found = _closure([drawn, *(stage["definition"] for stage in stages)])
    data = {"draw": drawn, "stages": stages, "formula": formula, "definitions": found}
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).encode()


def formula_fault(scene: Scene[Any]) -> str:
    """What is wrong with the formula of ``scene``; nothing where its frames are made with it."""
    return _formula_fault(scene) if scene.formula else ""


@cached
def _formula_fault(scene: Scene[Any]) -> str:
    return run_in_pool(partial(_formula_error, scene))


def _formula_error(scene: Scene[Any]) -> str:
    sources = json.loads(_scene_sources(scene))
    if sources["formula"] in sources["definitions"]:
        return ""
    name = getattr(scene.formula, "__qualname__", repr(scene.formula))
    return f"formula {name}; legal: a function that its stages or its drawing use"


def _home(function: Any) -> str:
    module, name = home(function)
    return _key(module, name) if name else ""


def _key(module: str, name: str) -> str:
    return f"{module}:{name}"


def _closure(keys: Iterable[str]) -> dict[str, dict[str, object]]:
    """These definitions and all that they use."""
    found: dict[str, dict[str, object]] = {}
    waiting = [key for key in keys if key]
    while waiting:
        key = waiting.pop(0)
        if key not in found:
            uses = uses_of(key)
            found[key] = {**_definition(key), "uses": uses}
            waiting += uses
    return found


def _definition(key: str) -> dict[str, object]:
    module, _, name = key.partition(":")
    place = read_module(module).definitions[name]
    lines = read_module(module).source.split("\n")[place.first - 1 : place.last]
    text = "\n".join(lines)
    return {
        "path": module.replace(".", "/") + ".py",
        "line": place.first,
        "text": text,
        "hash": hashlib.sha256(text.encode()).hexdigest()[:16],
    }


def uses_of(key: str) -> list[str]:
    """The definitions of editable modules that a definition names, each once, in order."""
    return [*_uses_of(key, import_module(key.partition(":")[0]))]


@cache
def _uses_of(key: str, _imported: ModuleType) -> tuple[str, ...]:
    name, _, own = key.partition(":")
    module = read_module(name)
    used = dict.fromkeys(_resolve(module, mention) for mention in module.mentions[own])
    return tuple(use for use in used if use not in ("", key))


def _resolve(module: Module, mention: str) -> str:
    """The definition of a name in ``module``; nothing for a name of another package."""
    name, _, attribute = mention.partition(".")
    if name in module.definitions:
        return _key(module.name, name)
    source, _, wanted = module.imported.get(name, "").partition(":")
    wanted = wanted or attribute
    if not source or not wanted:
        return ""
    origin = read_module(source)
    return _key(source, wanted) if wanted in origin.definitions else _resolve(origin, wanted)


def read_module(name: str) -> Module:
    """An editable module, by its full name; read once for as long as it is not imported anew."""
    return _read_module(name, import_module(name))


@cache
def _read_module(name: str, _imported: ModuleType) -> Module:
    source = module_source(name)
    tree = ast.parse(source)
    mentions: dict[str, tuple[str, ...]] = {}
    for statement in tree.body:
        defined = defined_name(statement)
        if defined:
            mentions[defined] = tuple(_names_in(statement))
    imported = {local: target for item in tree.body for local, target in _imports(item)}
    return Module(name, source, definitions(source), imported, mentions)


def _names_in(statement: ast.stmt) -> list[str]:
    """Names and names with an attribute, in the order of the text; not those of arguments."""
    nodes = list(ast.walk(statement))
    arguments = {node.arg for node in nodes if isinstance(node, ast.arg)}
    found: list[tuple[int, int, str]] = []
    for node in nodes:
        match node:
            case ast.Attribute(value=ast.Name(id=name), attr=attribute) if name not in arguments:
                found.append((node.lineno, node.col_offset, f"{name}.{attribute}"))
            case ast.Name(id=name) if name not in arguments:
                found.append((node.lineno, node.col_offset, name))
    return [name for _, _, name in sorted(found)]


def _imports(statement: ast.stmt) -> Iterator[tuple[str, str]]:
    """Local names and what they stand for, of an import from editable modules."""
    if not isinstance(statement, ast.ImportFrom) or not statement.module:
        return
    for alias in statement.names:
        whole = f"{statement.module}.{alias.name}"
        local = alias.asname or alias.name
        if is_editable(whole) and find_spec(statement.module) and is_module(whole):
            yield local, whole
        elif is_editable(statement.module):
            yield local, _key(statement.module, alias.name)
