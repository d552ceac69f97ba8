"""The exact third-party files that run in the reader's browser, in a folder of files addressed by
their content: ``<sha256>/<name>`` in the user's cache."""

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from site_builder.files.folders import cache_folder, replace_file

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


_intact: set[tuple[Path, int, int, int]] = set()
"""Files that were found whole, as they were then."""


def default_store() -> Path:
    """In the user's cache folder."""
    return cache_folder() / "runtime"


def sha256(content: bytes) -> str:
    """Hexadecimal SHA-256 of ``content``."""
    return hashlib.sha256(content).hexdigest()


def location(store: Path, file: RuntimeFile) -> Path:
    """The only place where ``file`` may lie."""
    return store / file.sha256 / file.name


def is_intact(store: Path, file: RuntimeFile) -> bool:
    """Whether the stored copy exists and has the hash in its path."""
    place = location(store, file)
    try:
        stat = place.stat()
        state = (place, stat.st_mtime_ns, stat.st_size, stat.st_ino)
        if state not in _intact and sha256(place.read_bytes()) == file.sha256:
            _intact.add(state)
    except OSError:
        return False
    return state in _intact


def is_intact_file(stored: Path) -> bool:
    """Whether the stored file has the content that its hash states."""
    return is_intact(stored.parents[1], RuntimeFile(stored.name, stored.parent.name))


def put(store: Path, name: str, content: bytes) -> Path:
    """Store ``content``; readers see the whole file or none, even with several writers."""
    target = location(store, RuntimeFile(name, sha256(content)))
    target.parent.mkdir(parents=True, exist_ok=True)
    replace_file(target, content)
    return target


def made_once(
    store: Path, recipe: str, make: Callable[[], Mapping[str, bytes]]
) -> Mapping[str, Path]:
    """The files that ``make`` gives, by name; made only where none of that recipe, or no intact
    ones, are stored."""
    store.mkdir(parents=True, exist_ok=True)
    record = store / f"{recipe}.json"
    if not (stored := _recorded(store, record)):
        stored = {name: put(store, name, content) for name, content in make().items()}
        hashes = {name: path.parent.name for name, path in stored.items()}
        record.write_text(json.dumps(hashes), encoding="utf-8")
    return stored


def _recorded(store: Path, record: Path) -> Mapping[str, Path]:
    """The stored files that a record names, where all are intact; else nothing."""
    try:
        hashes: dict[str, str] = json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    files = [RuntimeFile(name, hash_) for name, hash_ in hashes.items()]
    if not all(is_intact(store, file) for file in files):
        return {}
    return {file.name: location(store, file) for file in files}
