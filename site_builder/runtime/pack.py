"""Everything that the browser loads to run our Python, and the table of it: ``runtime.json``."""

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.cache.results import cached_result
from site_builder.files.engine import ENGINE, is_engine
from site_builder.files.folders import archive_of, data_of, file_hash, integrity
from site_builder.programs.node import Package
from site_builder.runtime import store as stores
from site_builder.runtime.downloads import fetch_packages, fetch_runtime
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
    CORE,
    ENTRY,
    Modules,
    Table,
    cut,
    imports_of,
    module_files,
    outside,
    reach,
    sources_of,
)
from site_builder.runtime.snapshot import SNAPSHOT, make_snapshot
from site_builder.runtime.store import (
    NUMPY_WHEEL,
    PYTHON_LIBRARY,
    PYTHON_VERSION,
    VERSIONS,
    Versions,
)

TABLE_NAME = "runtime.json"
ASKED = ("simulations.models.", "simulations.hard_cases.", "simulations.world.")
"""Begins the names of modules that exercises use, whatever pages run."""
SIMULATIONS = "simulations"
"""The chunk with all sources, for readers who edit them."""
SITE_PACKAGES = f"/lib/python{PYTHON_VERSION.rpartition('.')[0]}/site-packages"
LIBRARY = f"/lib/python{PYTHON_VERSION.rpartition('.')[0].replace('.', '')}.zip"
AT_ONCE = ("python", "numpy")
"""The chunks that the interpreter starts with."""
PACKAGE = "package-"
"""Begins the names of chunks of packages besides numpy."""


@dataclass(frozen=True, slots=True)
class RuntimeBundle:
    """The files of the site's runtime folder."""

    files: Mapping[str, Path]
    """Name in the site's runtime folder to the path of the file."""
    versions: Versions
    snapshot_error: str = ""
    """Why there is no snapshot for Python to begin with, where there should be one."""
    packages: tuple[Package, ...] = ()
    """Packages that the book declares, and all that they need."""

    @property
    def sources(self) -> str:
        """Hash of the simulations, for the worker; nothing where there are none."""
        return self._hash(f"{SIMULATIONS}.zip")

    @property
    def table(self) -> str:
        """Hash of the table of the files, likewise."""
        return self._hash(TABLE_NAME)

    def _hash(self, name: str) -> str:
        file = self.files.get(name)
        return integrity(file.read_bytes()) if file else ""


def pack_runtime(
    simulations: Path,
    store: Path | None = None,
    scenes: Modules = SCENE_MODULES,
    ladders: Modules = LADDER_MODULES,
    *,
    compiled: bool = True,
    packages: Sequence[str] = (),
) -> RuntimeBundle:
    """Fetch what is pinned, cut it into chunks, and pack the simulations beside it.

    Of a book's folder ``simulations``, that is what its pages run: the ``scenes`` and ``ladders``
    that they show, and all that these import; ``compiled``, with a snapshot of an interpreter that
    has imported the core, as every reader would else wait for that; and as sources beside it, for
    those who edit them. Besides numpy they may import ``packages`` of Pyodide's release. Equal
    sources give equal bytes, so a hash over the files names the runtime.

    Raises
    ------
    RuntimeFetchError
        Where the pinned files are neither cached nor to be had.
    PackageError
        Where Pyodide's release has no such package.
    FreezeError
        Where the simulations import what the browser lacks.
    """
    folder = store or stores.default_store()
    fetched = fetch_runtime(folder)
    wheels = fetch_packages(packages, folder)
    machine = {name: fetched[name] for name in INTERPRETER}
    python, numpy = fetched[PYTHON_LIBRARY.name], fetched[NUMPY_WHEEL.name]
    files = book_modules(simulations)
    imports = imports_of(files)
    modules = page_modules(imports, scenes, ladders)
    at_once, later = outside(imports, reach(imports, ENTRY)), outside(imports, modules)
    others = [wheel.path for wheel in wheels]
    sources = sources_of(files, modules) if compiled else {}
    frozen = freeze_libraries(machine, python, numpy, at_once, later, folder, others, sources)
    byte_code: Mapping[str, bytes] = {}
    if compiled:
        hashes = {path: file_hash(file) for path, file in sources.items()}
        key = (hashes, PYTHON_LIBRARY, file_hash(PROGRAM), file_hash(DRIVER))
        fresh = frozen.byte_code
        byte_code = cached_result(
            "byte code", key, lambda: dict(fresh) or compile_sources(machine, python, sources)
        )
    chunks = cut(imports, scenes, ladders)
    ours = {chunk: chunk_archive(files, names, byte_code) for chunk, names in chunks.items()}
    asked = {name for name in files if name.startswith(ASKED)}
    ours[SIMULATIONS] = chunk_archive(files, modules | asked)
    archives = {
        **{f"{chunk}.zip": file for chunk, file in frozen.archives.items()},
        **{f"{chunk}.zip": stores.put(folder, f"{chunk}.zip", ours[chunk]) for chunk in ours},
    }
    libraries = {file.name: file for file in frozen.libraries.values()}
    loaded = {**machine, **libraries, **archives}
    snapshot_error = ""
    if compiled:
        try:
            loaded[SNAPSHOT] = make_snapshot(
                machine,
                archives["python.zip"],
                frozen.libraries,
                [archives["numpy.zip"], archives[f"{CORE}.zip"]],
                [ENTRY, *sorted(chunks[CORE] - importing_packages(imports, frozen))],
                SITE_PACKAGES,
                folder,
            )
        except FreezeError as error:
            snapshot_error = str(error)
    table = json.dumps(
        runtime_table(loaded, frozen, imports, scenes, ladders), indent=1, sort_keys=True
    )
    listed = {TABLE_NAME: stores.put(folder, TABLE_NAME, table.encode())}
    shipped = tuple(wheel.package for wheel in wheels)
    return RuntimeBundle({**loaded, **listed}, VERSIONS, snapshot_error, shipped)


def importing_packages(imports: Table, frozen: Frozen) -> frozenset[str]:
    """The simulations that need a package besides numpy, which no snapshot has."""
    packages = {name: of for name, of in frozen.modules.items() if name.startswith(PACKAGE)}
    return frozenset(module for module in imports if chunks_of(imports, module, packages))


def book_modules(simulations: Path) -> dict[str, Path]:
    """The file of every module, by full name: the engine's, and those of a book's folder."""
    engine = {n: f for n, f in module_files(ENGINE / "simulations").items() if is_engine(n)}
    return dict(sorted({**engine, **module_files(simulations)}.items()))


def page_modules(
    imports: Table, scenes: Modules = SCENE_MODULES, ladders: Modules = LADDER_MODULES
) -> frozenset[str]:
    """What the worker, the scenes and the ladders import.

    Tables of hard cases are not among it, nor models that only these ask: the book prints what
    they say.
    """
    starts = (ENTRY, *scenes.values(), *ladders.values())
    return frozenset[str]().union(*(reach(imports, start) for start in starts))


def chunk_archive(
    files: Mapping[str, Path],
    modules: Collection[str],
    byte_code: Mapping[str, bytes] = MappingProxyType({}),
) -> bytes:
    """The archive of those ``modules`` that have one of the ``files``, with their data; without
    ``byte_code``, their sources."""
    sources = sources_of(files, modules)
    data = {path: file for one in sources.items() for path, file in data_beside(*one).items()}
    return archive_of(
        {
            path + "c" if path + "c" in byte_code else path: byte_code.get(path + "c")
            or file.read_bytes()
            for path, file in (sources | data).items()
        }
    )


def data_beside(path: str, module: Path) -> dict[str, Path]:
    """The data of a module by their paths in its archive, given its own there."""
    folder = path.rpartition("/")[0]
    return {f"{folder}/{name}": file for name, file in data_of(module).items()}


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
    once. ``modules``: of each chunk of a library that is not, the modules in it; ``machine_code``:
    which of numpy's among these hold some. ``scenes`` and ``ladders``: which chunks each of them
    imports.
    """
    later = {chunk: names for chunk, names in frozen.modules.items() if chunk not in AT_ONCE}

    def chunks(kind: str, modules: Modules) -> dict[str, list[str]]:
        return {
            key: [f"{kind}-{key}", *chunks_of(imports, name, later)]
            for key, name in modules.items()
        }

    return {
        "lock": LOCK,
        "folder": SITE_PACKAGES,
        "library": LIBRARY,
        "libraries": {file.name: path for path, file in frozen.libraries.items()},
        "machine_code": sorted(
            chunk
            for chunk in later
            if libraries_of(frozen.archives[chunk]) and not chunk.startswith(PACKAGE)
        ),
        "integrity": {name: integrity(file.read_bytes()) for name, file in loaded.items()},
        "modules": later,
        "scenes": chunks("scene", scenes),
        "ladders": chunks("ladder", ladders),
    }


def chunks_of(imports: Table, module: str, modules: Mapping[str, tuple[str, ...]]) -> list[str]:
    """The chunks that ``module`` imports from, itself or through others of its package."""
    wanted = outside(imports, reach(imports, module)) if module in imports else {}
    return sorted(chunk for chunk, names in modules.items() if not wanted.keys().isdisjoint(names))
