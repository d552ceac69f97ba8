"""What may be wrong with the files of the runtime, and what the reader is told of it."""

from support.static_server import FAULTS, Fault

WITHOUT_SNAPSHOT = {"/snapshot.wasm": Fault(status=404)}
"""Python starts plainly, and needs all else."""
OTHER_RELEASE = Fault(lambda table: table.replace(b'"sha256-', b'"sha256-A'))
KINDS = {**FAULTS, "type": Fault(media_type="text/plain"), "other release": OTHER_RELEASE}
SAID = {
    "missing": "could not be loaded: the server answered 404",
    "cut": "did not load",
    "login": "a web page came",
    "login as file": "a web page came",
    "type": "the server sends",
    "other release": "damaged or does not belong",
}
"""Of a file with that fault; of others that it arrived damaged."""
TRIED = {
    "numpy.zip": ("missing", "cut", "half", "changed", "login", "login as file"),
    "pyodide.mjs": ("missing", "cut", "half", "changed", "login", "type"),
    "pyodide.asm.mjs": ("changed", "type"),
    "pyodide.asm.wasm": ("half", "login as file"),
    "numpy.linalg._umath_linalg.wasm": ("missing", "half"),
    "python.zip": ("missing", "changed"),
    "core.zip": ("changed", "login"),
    "runtime.json": ("half", "login as file", "other release"),
    "worker.js": ("missing", "login", "type"),
}
"""Faults by file."""
