"""A folder of files addressed by their content: ``<sha256>/<name>`` in the user's cache."""

import hashlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.files.folders import replace_file
from site_builder.runtime.pinned import RuntimeFile

_intact: set[tuple[Path, int, int, int]] = set()
"""Files that were found whole, as they were then."""


def default_store() -> Path:
    """In the user's cache folder."""
    return user_cache_path("image-formation", appauthor=False) / "runtime"


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


def is_whole(stored: Path) -> bool:
    """The same of a file by its place."""
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
