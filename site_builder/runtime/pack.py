"""Everything that the browser loads to run our Python, and the table of it: ``runtime.json``."""

import base64
import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.book_root import ENGINE, is_engine
from site_builder.kept.files import file_hash
from site_builder.kept.keeper import kept_as
from site_builder.runtime import store as stores
from site_builder.runtime.fetch import fetch_runtime
from site_builder.runtime.freeze import (
    DRIVER,
    INTERPRETER,
    LOCK,
    PROGRAM,
    FreezeError,
    Frozen,
    compile_sources,
    freeze_libraries,
    libraries_of,
)
from site_builder.runtime.imports import (
    Table,
    imports_of,
    module_files,
    outside,
    reach,
)
from site_builder.runtime.memory import MEMORY, make_memory
from site_builder.runtime.modules import CORE, ENTRY, Modules, archive_of, cut, sources_of
from site_builder.runtime.pinned import (
    NUMPY_WHEEL,
    PYTHON_LIBRARY,
    PYTHON_VERSION,
    VERSIONS,
    Versions,
)

TABLE_NAME = "runtime.json"
SIMULATIONS = "simulations.zip"


@dataclass(frozen=True, slots=True)
class RuntimeBundle:
    """The files of the site's runtime folder."""

    files: Mapping[str, Path]
    """Name in the site's runtime folder to where the file lies now."""
    versions: Versions
    wants_memory: str = ""
    """Why there is no memory for Python to begin with, where there should be one."""

    @property
    def sources(self) -> str:
        """Hash of the simulations, as the worker knows it; nothing where there are none."""
        return self._hash(SIMULATIONS)

    @property
    def table(self) -> str:
        """Hash of the table of the files, likewise."""
        return self._hash(TABLE_NAME)

    def _hash(self, name: str) -> str:
        file = self.files.get(name)
        return _integrity(file) if file else ""


def pack_runtime(
    simulations: Path,
    store: Path | None = None,
    scenes: Modules = SCENE_MODULES,
    ladders: Modules = LADDER_MODULES,
    *,
    compiled: bool = True,
) -> RuntimeBundle:
    """Fetch what is pinned, cut it into parts, and pack the simulations beside it.

    Of a book's folder ``simulations``, that is what its pages run: the ``scenes`` and ``ladders``
    that they show, and all that these import: ``compiled`` and small, as every reader would else
    wait for that, and as sources beside it, for those who edit them. Equal sources give equal
    bytes, so a hash over the files names the runtime.

    Raises
    ------
    RuntimeFetchError
        Where the pinned files are neither cached nor to be had.
    FreezeError
        Where the simulations import what the browser lacks.
    """
    folder = store or stores.default_store()
    fetched = fetch_runtime(folder)
    files = book_modules(simulations)
    given = {name: file_hash(file) for name, file in files.items()}
    imports, _ = kept_as("imports", given, lambda: imports_of(files))
    modules = page_modules(imports, scenes, ladders)
    at_once = outside(imports, reach(imports, ENTRY))
    machine = {name: fetched[name] for name in INTERPRETER}
    frozen = freeze_libraries(
        machine,
        fetched[PYTHON_LIBRARY.name],
        fetched[NUMPY_WHEEL.name],
        at_once,
        outside(imports, modules),
        folder,
    )
    sources = sources_of(files, modules)
    hashes = {path: file_hash(file) for path, file in sources.items()}
    byte_code: Mapping[str, bytes] = {}
    if compiled:
        python = fetched[PYTHON_LIBRARY.name]
        key = (hashes, PYTHON_LIBRARY, file_hash(PROGRAM), file_hash(DRIVER))
        byte_code, _ = kept_as("byte code", key, lambda: compile_sources(machine, python, sources))
    ours = module_parts(files, cut(imports, scenes, ladders), byte_code, small=compiled)
    ours[SIMULATIONS.removesuffix(".zip")] = source_archive(files, modules, small=compiled)
    archives = {
        **{f"{part}.zip": file for part, file in frozen.archives.items()},
        **{f"{part}.zip": stores.put(folder, f"{part}.zip", data) for part, data in ours.items()},
    }
    libraries = {file.name: file for file in frozen.libraries.values()}
    loaded = {**machine, **libraries, **archives}
    wants_memory = ""
    if compiled:
        core = cut(imports, scenes, ladders)[CORE]
        try:
            loaded[MEMORY] = make_memory(
                machine,
                archives["python.zip"],
                frozen.libraries,
                [archives["numpy.zip"], archives[f"{CORE}.zip"]],
                [ENTRY, *sorted(core)],
                SITE_PACKAGES,
                folder,
            )
        except FreezeError as error:
            wants_memory = str(error)
    table = json.dumps(
        runtime_table(loaded, frozen, imports, scenes, ladders), indent=1, sort_keys=True
    )
    return RuntimeBundle(
        {
            **loaded,
            TABLE_NAME: stores.put(folder, TABLE_NAME, table.encode()),
        },
        VERSIONS,
        wants_memory,
    )


def book_modules(simulations: Path) -> dict[str, Path]:
    """The file of every module, by full name: the engine's, and those of a book's folder."""
    engine = {n: f for n, f in module_files(ENGINE / "simulations").items() if is_engine(n)}
    own = {name: file for name, file in module_files(simulations).items() if not is_engine(name)}
    return dict(sorted({**own, **engine}.items()))


def page_modules(
    imports: Table, scenes: Modules = SCENE_MODULES, ladders: Modules = LADDER_MODULES
) -> frozenset[str]:
    """What the worker, the scenes and the ladders import.

    Tables of hard cases are not among it, nor models that only these ask: the book prints what
    they say.
    """
    starts = (ENTRY, *scenes.values(), *ladders.values())
    return frozenset[str]().union(*(reach(imports, start) for start in starts))


def source_archive(
    files: Mapping[str, Path], modules: Collection[str], *, small: bool = True
) -> bytes:
    """Those ``modules`` that have one of the ``files``. Equal sources give equal bytes."""
    sources = sources_of(files, modules)
    return archive_of({path: file.read_bytes() for path, file in sources.items()}, small=small)


def module_parts(
    files: Mapping[str, Path],
    parts: Mapping[str, Collection[str]],
    byte_code: Mapping[str, bytes],
    *,
    small: bool = True,
) -> dict[str, bytes]:
    """The archive of each part; of a module without ``byte_code``, its source."""

    def members(modules: Collection[str]) -> dict[str, bytes]:
        sources = sources_of(files, modules)
        return {
            path + "c" if path + "c" in byte_code else path: byte_code.get(path + "c")
            or file.read_bytes()
            for path, file in sources.items()
        }

    return {part: archive_of(members(modules), small=small) for part, modules in parts.items()}


def runtime_table(
    loaded: Mapping[str, Path],
    frozen: Frozen,
    imports: Table,
    scenes: Modules = SCENE_MODULES,
    ladders: Modules = LADDER_MODULES,
) -> dict[str, object]:
    """What the worker knows of the files beside it.

    ``lock``: what Pyodide asks for. ``integrity``: hash of each of the files ``loaded``.
    ``folder``: where modules are unpacked, and ``library``: where Python looks for its own.
    ``libraries``: where in the folder the machine code of each library belongs that is loaded at
    once. ``modules``: of each part of a library that is not, the modules in it; ``machine_code``:
    which of these parts hold some. ``scenes`` and ``ladders``: which parts each of them imports.
    """
    later = {part: names for part, names in frozen.modules.items() if part not in AT_ONCE}
    return {
        "lock": LOCK,
        "folder": SITE_PACKAGES,
        "library": LIBRARY,
        "libraries": {file.name: path for path, file in frozen.libraries.items()},
        "machine_code": sorted(part for part in later if libraries_of(frozen.archives[part])),
        "integrity": {name: _integrity(file) for name, file in loaded.items()},
        "modules": later,
        "scenes": {
            key: [f"scene-{key}", *parts_of(imports, name, later)] for key, name in scenes.items()
        },
        "ladders": {
            key: [f"ladder-{key}", *parts_of(imports, name, later)] for key, name in ladders.items()
        },
    }


SITE_PACKAGES = f"/lib/python{PYTHON_VERSION.rpartition('.')[0]}/site-packages"
LIBRARY = f"/lib/python{PYTHON_VERSION.rpartition('.')[0].replace('.', '')}.zip"
AT_ONCE = ("python", "numpy")
"""The parts that the interpreter starts with."""


def parts_of(imports: Table, module: str, modules: Mapping[str, tuple[str, ...]]) -> list[str]:
    """The parts that ``module`` imports from, itself or through others of its package."""
    wanted = outside(imports, reach(imports, module)) if module in imports else {}
    return sorted(part for part, names in modules.items() if not wanted.keys().isdisjoint(names))


def integrity(content: bytes) -> str:
    """As `fetch` takes it."""
    return _told(stores.sha256(content))


def _integrity(file: Path) -> str:
    """The same of a file, whose place in the store says it."""
    return _told(file.parent.name if stores.is_whole(file) else stores.sha256(file.read_bytes()))


def _told(sha256: str) -> str:
    return "sha256-" + base64.b64encode(bytes.fromhex(sha256)).decode()
