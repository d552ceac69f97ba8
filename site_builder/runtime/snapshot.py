"""The snapshot of an interpreter that has started: in browsers, Python continues from it.

Pyodide under Node starts as it does in a browser, with numpy's machine code at the same places, and
imports what most figures need. What that changes in its memory is a module of WebAssembly that
browsers have write it into theirs, instead of starting Python. It takes some three seconds, and is
cached.
"""

import json
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from site_builder.diagnostics.diagnostic import announce
from site_builder.runtime import store as stores
from site_builder.runtime.freeze import INTERPRETER, LOCK, Files, run_in_pyodide

if TYPE_CHECKING:
    from numpy.typing import NDArray

type Bytes = NDArray[np.uint8]

MAGIC = b"\x00asm\x01\x00\x00\x00"
MEMORY = ("python", "memory")
"""Names under which the module imports the memory."""
CUSTOM, IMPORTS, DATA = 0, 2, 11
"""Numbers of sections (WebAssembly Core Specification, 5.5)."""
GAP = 64
"""Unchanged bytes between changed ones that are written too, as a new run costs more."""


def changed_runs(
    memory: Bytes, base: Bytes, always: slice = slice(0), gap: int = GAP
) -> list[tuple[int, bytes]]:
    """Place and content of each run of bytes in which ``memory`` differs from the ``base``, which
    ends where it is zero, and of those at ``always``."""
    differs = memory != 0
    differs[: len(base)] = memory[: len(base)] != base
    differs[always] = True
    places = np.flatnonzero(differs)
    runs = np.split(places, np.flatnonzero(np.diff(places) > gap) + 1) if len(places) else []
    bounds = [(int(run[0]), int(run[-1]) + 1) for run in runs]
    return [(start, memory[start:end].tobytes()) for start, end in bounds]


def data_module(runs: Sequence[tuple[int, bytes]], sections: Mapping[str, bytes]) -> bytes:
    """A module that writes ``runs``, each at its place of the memory that it is given, and has
    ``sections`` of its own."""
    names = b"".join(_sized(name.encode()) for name in MEMORY)
    segments = b"".join(
        b"\x00\x41" + signed(place) + b"\x0b" + _sized(content) for place, content in runs
    )
    parts = [
        *((CUSTOM, _sized(name.encode()) + content) for name, content in sections.items()),
        (IMPORTS, unsigned(1) + names + b"\x02\x00" + unsigned(0)),
        (DATA, unsigned(len(runs)) + segments),
    ]
    return MAGIC + b"".join(bytes([number]) + _sized(content) for number, content in parts)


def unsigned(number: int) -> bytes:
    """Encode as LEB128."""
    digits = bytearray()
    while number > 0x7F:
        digits.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*digits, number])


def signed(number: int) -> bytes:
    """Encode as signed LEB128."""
    digits = bytearray()
    while not -0x40 <= number < 0x40:
        digits.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*digits, number & 0x7F])


def _sized(content: bytes) -> bytes:
    return unsigned(len(content)) + content


HERE = Path(__file__).parent
DRIVER, SETTLE = HERE / "snapshot.mjs", HERE / "settle.py"
INGREDIENTS = (DRIVER, SETTLE, Path(__file__))
SNAPSHOT = "snapshot.wasm"
"""Hosts know its media type, and compress it."""
ABOUT = "about"
"""Its section with what the worker has to know of it."""
BEFORE, AFTER = 1 << 20, 1 << 16
"""Bytes before and after the beginning of the heap that are written in any case: the environment is
there, which every browser has another one of."""


def make_snapshot(
    interpreter: Files,
    python: Path,
    libraries: Files,
    archives: Sequence[Path],
    modules: Sequence[str],
    folder: str,
    store: Path,
) -> Path:
    """The file with the snapshot.

    Parameters
    ----------
    interpreter
        Pyodide's files by name.
    python
        The archive of Python's library that readers get.
    libraries
        Machine code by its path among the modules, in the order in which browsers load it.
    archives
        Those of the modules that are imported.
    modules
        What is imported, in order.
    folder
        Where in the interpreter modules are unpacked.

    Raises
    ------
    FreezeError
        Where the interpreter fails.
    """
    given = [*(interpreter[name] for name in INTERPRETER), python, *libraries.values(), *archives]
    hashes = [stores.sha256(file.read_bytes()) for file in (*given, *INGREDIENTS)]
    recipe = json.dumps(["snapshot", hashes, [*libraries], [*modules], folder, LOCK])

    def make() -> Mapping[str, bytes]:
        announce("starting Python once, for a snapshot of its memory")
        order = {
            "folder": folder,
            "libraries": {path: str(file) for path, file in libraries.items()},
            "archives": [str(archive) for archive in archives],
            "modules": [*modules],
        }
        return {SNAPSHOT: _take_snapshot(interpreter, python, order)}

    return stores.made_once(store, f"snapshot-{stores.sha256(recipe.encode())}", make)[SNAPSHOT]


def _take_snapshot(interpreter: Files, python: Path, order: Mapping[str, object]) -> bytes:
    with tempfile.TemporaryDirectory() as scratch:
        given, out = Path(scratch) / "given", Path(scratch) / "out"
        given.mkdir()
        out.mkdir()
        (given / "order.json").write_text(json.dumps(order), encoding="utf-8")
        (given / "lock.json").write_text(json.dumps(LOCK), encoding="utf-8")
        shutil.copyfile(SETTLE, given / "settle.py")
        run_in_pyodide(DRIVER, interpreter, python, [str(given), str(out)], Path(scratch))
        memory, base = (np.fromfile(out / name, np.uint8) for name in ("memory", "base"))
        about = json.loads((out / "about.json").read_text(encoding="utf-8"))
    heap = about.pop("heap")
    runs = changed_runs(memory, base, slice(heap - BEFORE, heap + AFTER))
    described = json.dumps({**about, "size": len(memory)}, sort_keys=True)
    return data_module(runs, {ABOUT: described.encode()})
