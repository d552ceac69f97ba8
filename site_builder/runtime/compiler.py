"""Trace and compile, inside the interpreter that will run the modules.

Runs in Pyodide, started by ``interpreter.mjs``, with its standard library and nothing else. Reads
``/freezer/order.json`` and writes ``/freezer/out/``: zip archives of modules, and
``modules.json`` with the names of the modules in each, unless the order asks for nothing; and
``sources.zip``, what lies in ``/freezer/sources/``, compiled.
"""

import ast
import importlib.util
import json
import sys
import zipfile
from collections.abc import Iterable, Mapping
from importlib import import_module
from importlib._bootstrap_external import _code_to_hash_pyc  # type: ignore[attr-defined]
from pathlib import Path
from types import CodeType

FREEZER = Path("/freezer")
OUT = FREEZER / "out"
SITE = Path("/lib/traced")
ITS_OWN = ("_pyodide", "pyodide")
"""Packages of the interpreter's own: in a browser it imports more of them than here, and their
docstrings are read."""
DISPENSABLE = ("ssl", "bz2", "lzma", "compression", "ctypes")
"""What Python's library imports where it is there, and does without where it is not."""
PACKAGE = "package-"
"""Begins the names of chunks of packages besides numpy."""
FOR_COMPILERS = (".pyi", ".pyx", ".pxd", ".pxi", ".h", ".c", ".typed")
EPOCH = (2020, 1, 1, 0, 0, 0)

type Members = Mapping[str, bytes]
"""The modules of an archive: path in it to content."""


def main() -> None:
    order = json.loads((FREEZER / "order.json").read_text())
    OUT.mkdir()
    if order:
        chunks = cut_libraries(order["at_once"], order["later"])
        for chunk, members in chunks.items():
            write(chunk, members)
        modules = {
            chunk: sorted(map(module_name, filter(is_module, members)))
            for chunk, members in chunks.items()
        }
        (OUT / "modules.json").write_text(json.dumps(modules, sort_keys=True))
    write("sources", compiled(read_folder(FREEZER / "sources")))


def cut_libraries(at_once: list[str], later: list[str]) -> dict[str, Members]:
    """Python's library and the packages, in chunks.

    ``python`` and ``numpy``: what the interpreter itself and the modules ``at_once`` import; of
    Python's library also what the modules ``later`` import, but nothing `DISPENSABLE`.
    ``numpy-PACKAGE``: each package that is named in ``later`` only. ``package-NAME``: of each other
    package, what the modules ``later`` import, and its data. These are compiled.
    ``python-rest``, ``numpy-rest`` and ``package-NAME-rest``: all else.
    """
    python, packages = read_archive(FREEZER / "python.zip"), read_folder(FREEZER / "packages")
    install(packages)
    trace(at_once)
    core = set(sys.modules)
    trace(later)
    named = {package_prefix(name) for name in later} - core
    chunks: dict[str, dict[str, bytes]] = {}
    for member, content in python.items():
        chunk = "python" if is_needed(member, set(sys.modules)) else "python-rest"
        chunks.setdefault(chunk, {})[member] = content
    for member, content in packages.items():
        if member.startswith("numpy/"):
            package = package_prefix(module_name(member))
            later_chunk = package.replace(".", "-") if package in named else "numpy-rest"
            chunk = "numpy" if is_needed(member, core) else later_chunk
        else:
            chunk = PACKAGE + module_name(member).partition(".")[0]
            chunk += "" if module_name(member) in sys.modules or is_data(member) else "-rest"
        chunks.setdefault(chunk, {})[member] = content
    whole = any(chunk.startswith(PACKAGE) for chunk in chunks)
    return {
        chunk: members
        if chunk.endswith("-rest")
        else compiled(members, whole=whole and chunk != "python")
        for chunk, members in chunks.items()
    }


def is_needed(member: str, imported: set[str]) -> bool:
    name = module_name(member)
    if any(name == each or name.startswith(each + ".") for each in DISPENSABLE):
        return False
    return name in imported or name.split(".")[0] in ITS_OWN


def package_prefix(module: str) -> str:
    """``numpy.fft.helper`` → ``numpy.fft``."""
    return ".".join(module.split(".")[:2])


def read_archive(archive: Path) -> dict[str, bytes]:
    """The modules in a zip archive, in order."""
    with zipfile.ZipFile(archive) as opened:
        return {name: opened.read(name) for name in sorted(opened.namelist()) if is_module(name)}


def read_folder(folder: Path) -> dict[str, bytes]:
    """The modules in a folder, and the data of packages, in order."""
    files = {f.relative_to(folder).as_posix(): f for f in folder.rglob("*.*") if f.is_file()}
    kept = sorted(name for name in files if is_module(name) or is_data(name))
    return {name: files[name].read_bytes() for name in kept}


def is_module(name: str) -> bool:
    return name.endswith((".py", ".pyc", ".so"))


def is_data(name: str) -> bool:
    """Whether a package reads it as it runs: numpy reads nothing."""
    package, _, rest = name.partition("/")
    in_package = rest and "." not in package and package != "numpy"
    return bool(in_package) and not is_module(name) and not name.endswith(FOR_COMPILERS)


def install(members: Members) -> None:
    """Make modules importable."""
    for name, content in members.items():
        (SITE / name).parent.mkdir(parents=True, exist_ok=True)
        (SITE / name).write_bytes(content)
    sys.path.append(str(SITE))


def trace(names: Iterable[str]) -> None:
    """Import modules. One that is not there is named in ``/freezer/missing``: the program ends."""
    for name in names:
        try:
            import_module(name)
        except ModuleNotFoundError:
            (FREEZER / "missing").write_text(name)
            raise


def module_name(member: str) -> str:
    """``numpy/lib/__init__.py`` → ``numpy.lib``; what follows a first dot is the kind of file."""
    return member.partition(".")[0].replace("/", ".").removesuffix(".__init__")


def compiled(members: Members, *, whole: bool = False) -> dict[str, bytes]:
    """Sources as byte code that is never checked against its source; the rest as it is."""
    return {
        (name + "c" if name.endswith(".py") else name): (
            byte_code(name, content, whole=whole) if name.endswith(".py") else content
        )
        for name, content in members.items()
    }


def byte_code(name: str, source: bytes, *, whole: bool) -> bytes:
    """Without assertions and docstrings, which the page does not use; but ``whole`` where packages
    are there that may read those of numpy, as numpy.ma does, and their own."""
    tree = ast.parse(source, name)
    if not whole and name.rpartition("/")[2].startswith("_add_newdocs"):
        tree.body = [each for each in tree.body if not adds_docs(each)]
    optimize = 0 if whole or name.split("/")[0] in ITS_OWN else 2
    code = without_lines(compile(tree, name, "exec", dont_inherit=True, optimize=optimize))
    content: bytes = _code_to_hash_pyc(code, importlib.util.source_hash(source), False)
    return content


def without_lines(code: CodeType) -> CodeType:
    """Every instruction in the first line of its function (CPython,
    ``InternalDocs/code_objects.md``, "Source code locations"), as the page shows no other."""
    units = len(code.co_code) // 2
    lengths = [8] * (units // 8) + [units % 8] * (units % 8 > 0)
    table = b"".join(bytes([0x80 | 13 << 3 | length - 1, 0]) for length in lengths)
    consts = tuple(
        without_lines(each) if isinstance(each, CodeType) else each for each in code.co_consts
    )
    return code.replace(co_linetable=table, co_consts=consts)


def adds_docs(statement: ast.stmt) -> bool:
    """Whether it does nothing but give a function of numpy's machine code its docstring."""
    match statement:
        case ast.Expr(ast.Call(ast.Name("add_newdoc" | "add_newdoc_for_scalar_type"))):
            return True
    return False


def write(chunk: str, members: Members) -> None:
    """An archive that is not compressed: it is read in a third of the time."""
    with zipfile.ZipFile(OUT / f"{chunk}.zip", "w") as archive:
        for name, content in sorted(members.items()):
            archive.writestr(zipfile.ZipInfo(name, EPOCH), content)


main()
