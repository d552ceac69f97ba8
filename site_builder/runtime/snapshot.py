"""The snapshot of an interpreter that has started: in browsers, Python continues from it.

Pyodide under Node starts as it does in a browser, with numpy's machine code at the same places, and
imports what most figures need. What that changes in its memory is a file that browsers write into
theirs, instead of starting Python. It takes some three seconds, and is cached.
"""

import json
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from site_builder.diagnostics.progress import announce
from site_builder.runtime import store as stores
from site_builder.runtime.data_module import changed_runs, data_module
from site_builder.runtime.freeze import INTERPRETER, LOCK, Files, run_in_pyodide

HERE = Path(__file__).parent
DRIVER, SETTLE = HERE / "snapshot.mjs", HERE / "settle.py"
INGREDIENTS = (DRIVER, SETTLE, HERE / "data_module.py", Path(__file__))
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
        return {SNAPSHOT: _made(interpreter, python, order)}

    return stores.made_once(store, f"snapshot-{stores.sha256(recipe.encode())}", make)[SNAPSHOT]


def _made(interpreter: Files, python: Path, order: Mapping[str, object]) -> bytes:
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
