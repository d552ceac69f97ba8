"""The hash of a file, read again only where the file has changed."""

import hashlib
from pathlib import Path

SIZE = 20
_known: dict[Path, tuple[tuple[int, int, int], bytes]] = {}


def file_hash(file: Path) -> bytes | None:
    """Of its bytes; None where there is no such file."""
    try:
        stat = file.stat()
        state = (stat.st_mtime_ns, stat.st_size, stat.st_ino)
        known = _known.get(file)
        if known and known[0] == state:
            return known[1]
        found = hashlib.blake2b(file.read_bytes(), digest_size=SIZE).digest()
    except OSError:
        return None
    _known[file] = (state, found)
    return found


def folder_hash(folder: Path, pattern: str = "*") -> bytes:
    """Of the names and bytes of all files below it that fit."""
    digest = hashlib.blake2b(digest_size=SIZE)
    for file in sorted(folder.rglob(pattern)):
        if (found := file_hash(file)) is not None and "__pycache__" not in file.parts:
            name = file.relative_to(folder).as_posix().encode()
            digest.update(len(name).to_bytes(4, "little") + name + found)
    return digest.digest()
