"""The exact third-party files that run in the reader's browser."""

from dataclasses import dataclass

PYODIDE_VERSION = "314.0.3"
PYTHON_VERSION = "3.14.2"
"""What Pyodide's interpreter says of itself."""
NUMPY_VERSION = "2.4.3"
"""Equal to the native pin in ``pyproject.toml``, so that both sides compute alike."""


@dataclass(frozen=True, slots=True)
class Versions:
    """What the reader's browser runs; empty texts for a site without a runtime."""

    pyodide: str = ""
    python: str = ""
    numpy: str = ""


VERSIONS = Versions(PYODIDE_VERSION, PYTHON_VERSION, NUMPY_VERSION)


@dataclass(frozen=True, slots=True)
class RuntimeFile:
    """A file that is known by its content, wherever it comes from."""

    name: str
    sha256: str


NUMPY_WHEEL = RuntimeFile(
    f"numpy-{NUMPY_VERSION}-cp314-cp314-pyemscripten_2026_0_wasm32.whl",
    "0cad9c1b91f0082e4f959bc0e0bf5835a2efbba6ab3b1e9d1fe6e7e564cca98e",
)

PYTHON_LIBRARY = RuntimeFile(
    "python_stdlib.zip", "444c770dfd75a32097fc0a7d5c1413fd3140601f49c3a1f2e9af0376fcd124b4"
)

RUNTIME_FILES = (
    RuntimeFile("pyodide.mjs", "5cfc46f5dcbaf2a16f26e2363f441873eb424762609cc03db00d6a2ace4d00e5"),
    RuntimeFile(
        "pyodide.asm.mjs", "1a9775427ef6e8abaa7db88ece0515422d1886915ae5c9093776410c865dfd8d"
    ),
    RuntimeFile(
        "pyodide.asm.wasm", "e7f8fac36f8bf11085309cbc5c829b3ec3057c18bf1d73b05a6741612d63cdbf"
    ),
    PYTHON_LIBRARY,
    NUMPY_WHEEL,
)

RELEASE_LOCK = RuntimeFile(
    "pyodide-lock.json", "c963d22858f6bcb8f41586a2142f03905ab370c88ea22a86a2736e95fac2a8f3"
)
"""The release's own list of its packages, with their hashes."""

LOCK_INFO = {
    "abi_version": "2026_0",
    "arch": "wasm32",
    "platform": "emscripten_5_0_3",
    "python": "3.14.0",
}
"""Header of the lock file that Pyodide's release carries: what it insists on."""
