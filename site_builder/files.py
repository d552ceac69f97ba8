"""The files of a folder, and the hash of a file, read again only where it has changed."""

import hashlib
import os
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path

SIZE = 20
_known: dict[str, tuple[tuple[int, int, int], bytes]] = {}


def bytes_hash(data: bytes) -> bytes:
    return hashlib.blake2b(data, digest_size=SIZE).digest()


def file_hash(file: Path | str) -> bytes | None:
    """Of its bytes; None where there is no such file."""
    name = os.fspath(file)
    try:
        stat = os.stat(name)  # noqa: PTH116  (asked of every file in every build)
        state = (stat.st_mtime_ns, stat.st_size, stat.st_ino)
        known = _known.get(name)
        if known and known[0] == state:
            return known[1]
        found = bytes_hash(Path(name).read_bytes())
    except OSError:
        return None
    _known[name] = (state, found)
    return found


def folder_hash(folder: Path, pattern: str = "*") -> bytes:
    """Of the names and bytes of all files below it that fit, but for compiled code."""
    digest, start = hashlib.blake2b(digest_size=SIZE), len(os.fspath(folder))
    for name in sorted(_files(os.fspath(folder), pattern)):
        if found := file_hash(name):
            relative = name[start:].encode()
            digest.update(len(relative).to_bytes(4, "little") + relative + found)
    return digest.digest()


def folder_files(folder: Path) -> dict[str, Path]:
    """All files below ``folder``, by their path in it; what is hidden is left out."""
    return {name: folder / name for name in sorted(_shown(folder, ""))}


def _shown(folder: Path | str, inside: str) -> Iterator[str]:
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith("."):
                continue
            if entry.is_dir(follow_symlinks=False):
                yield from _shown(entry.path, f"{inside}{entry.name}/")
            elif _is_file(entry):
                yield inside + entry.name


def _is_file(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_file()
    except OSError:  # a link that leads to itself
        return False


def _files(folder: str, pattern: str) -> Iterator[str]:
    for place, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if name != "__pycache__"]
        yield from (f"{place}{os.sep}{name}" for name in files if fnmatch(name, pattern))
