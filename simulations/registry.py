"""Scenes, ladders, illustrations and hard cases, found by file name and imported on demand.

    scenes/lens_distortion/scene.py      the scene lens-distortion: its ``SCENE``, which `figure` of
                                         `simulations.engine.figure` makes of a function
    ladders/precision.py                 the ladder precision: its ``LADDER``
    ladders/sums/ladder.py               the ladder sums, in a package
    illustrations/f_numbers.py           the illustration f-numbers: its ``draw``
    hard_cases/optics.toml               the hard cases of optics

The id is the name, with hyphens. Names that begin with an underscore are skipped: these packages
hold code that several share. So are hidden files, which editors and systems keep beside others.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.machinery import ModuleSpec
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import simulations
from simulations.engine.controls import suggestion
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene


class UnknownIdError(KeyError):
    """An unknown id; the message names the nearest legal one, or all."""

    def __str__(self) -> str:
        return str(self.args[0])


def modules_in(room: str, *, inside: str = "") -> dict[str, str]:
    """Id to module of all entries in a package of ``simulations``, sorted.

    ``inside`` is the module to use of an entry that is a package. Empty if the book has no such
    package, and in the browser, which has all modules in one archive.
    """
    spec = find_spec(f"simulations.{room}")
    folders = map(Path, (spec and spec.submodule_search_locations) or ())
    files = [file for folder in folders if folder.is_dir() for file in folder.iterdir()]
    return {
        file.stem.replace("_", "-"): f"simulations.{room}.{file.stem}"
        + (f".{inside}" if inside and file.is_dir() else "")
        for file in sorted(files, key=lambda file: file.stem)
        if file.suffix == ".py" or (file / "__init__.py").is_file()
        if not file.stem.startswith(("_", ".", "#"))
    }


def hard_case_tables() -> dict[str, Path]:
    """Id to file of all tables of hard cases, sorted: the book's, or those beside the engine."""
    folders = (Path(path, "hard_cases") for path in simulations.__path__)
    folder = next((folder for folder in folders if folder.is_dir()), Path("hard_cases"))
    return {file.stem.replace("_", "-"): file for file in sorted(folder.glob("*.toml"))}


SCENE_MODULES: Mapping[str, str] = modules_in("scenes", inside="scene")
LADDER_MODULES: Mapping[str, str] = modules_in("ladders", inside="ladder")


def load_scene(scene_id: str) -> Scene[Any]:
    """The scene ``scene_id``: the ``SCENE`` of its module. Raises `UnknownIdError`."""
    return _value(scene_id, scene_module(scene_id), "SCENE", Scene)


def load_ladder(ladder_id: str) -> Ladder:
    """The ladder ``ladder_id``: the ``LADDER`` of its module. Raises `UnknownIdError`."""
    module = _module("ladder", ladder_id, "ladders", "ladder", LADDER_MODULES)
    return _value(ladder_id, module, "LADDER", Ladder)


def level_labels(
    scene: Scene[Any], load: Callable[[str], Ladder] = load_ladder
) -> tuple[tuple[str, str], ...]:
    """Each level's name and label: the scene's own words, or its ladder's."""
    accuracy = scene.accuracy
    tiers = load(accuracy.ladder).tiers if accuracy.ladder else ()
    labels = {tier.id: tier.label for tier in tiers}
    return tuple((level.name, level.label or labels[level.name]) for level in accuracy.levels)


def scene_module(scene_id: str) -> str:
    """The full name of the scene's module. Raises `UnknownIdError`."""
    return _module("simulation", scene_id, "scenes", "scene", SCENE_MODULES)


def _module(kind: str, entry_id: str, room: str, inside: str, listed: Mapping[str, str]) -> str:
    """The module by its name alone, for the browser, where modules cannot be listed."""
    name = f"simulations.{room}.{entry_id.replace('-', '_')}"
    spec = _spec(name) if not {"_", "."} & {*entry_id} and not entry_id.startswith("-") else None
    if spec is None and entry_id in listed:
        file = f"{listed[entry_id].replace('.', '/')}.py"
        raise UnknownIdError(
            f"{kind} {entry_id!r} in {file!r}; legal: '_' in the file's name for '-'"
        )
    if spec is None:
        legal = f"; legal: {', '.join(listed)}" if listed else ""
        hint = suggestion(entry_id, listed) or legal
        raise UnknownIdError(f"unknown {kind} {entry_id!r}{hint}")
    return name if spec.submodule_search_locations is None else f"{name}.{inside}"


def _value[T: (Scene[Any], Ladder)](entry_id: str, module: str, name: str, kind: type[T]) -> T:
    """The attribute of the module, whose id is ``entry_id``. Raises `UnknownIdError`."""
    found = getattr(import_module(module), name, None)
    if not isinstance(found, kind):
        given = "no" if found is None else f"{type(found).__name__} as"
        legal = f"a {kind.__name__}" + ", or a function below @figure" * (name == "SCENE")
        raise UnknownIdError(f"{module} has {given} {name}; legal: {legal}")
    if found.id != entry_id:
        raise UnknownIdError(f"{module} has the id {found.id!r}; legal: {entry_id!r}")
    return found


def _spec(name: str) -> ModuleSpec | None:
    try:
        return find_spec(name)
    except ModuleNotFoundError:  # the book has no such package
        return None
