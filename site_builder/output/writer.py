"""Writing the site: beside the old one first, then swapped in whole. Where it is a single file that
differs, as after most edits, that alone is replaced, which is whole as well."""

import errno
import fcntl
import os
import re
import shutil
import tempfile
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from site_builder.files import file_hash
from site_builder.output.assets import Content, content_bytes, content_hash
from site_builder.output.exchange import exchange

type Hashes = dict[str, tuple[Content, bytes]]
"""Of contents by the names of their files, with these contents: hashed once while they are the
same in memory."""


def write_site(
    files: Mapping[str, Content], out: Path, hashes: Hashes | None = None
) -> tuple[str, ...]:
    """Replace the folder ``out`` by ``files``; returns the names of those that are not as before.

    The last good site stays as it is until the new one is complete; of two builds into one folder
    the later one stays. Files that have not changed keep their modification time. ``hashes`` are
    of the files as they were written last, and become those of ``files``. Raises `ValueError`
    where ``out`` holds something else than a site, which would be lost.
    """
    _check_holds_a_site(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    _clear_away(out)
    known = {} if hashes is None else hashes
    found: dict[str, bytes] = {}

    def differs(name: str, content: Content) -> bool:
        """Of what is new, which is most of a first build, no hash is asked."""
        before = file_hash(f"{out}{os.sep}{name}")
        if before is None and hashes is None:
            return True
        found[name] = _hash_once(name, content, known)
        return before != found[name]

    with _alone(out.parent):
        there = set(_names_in(out))
        changed = [name for name, content in files.items() if differs(name, content)]
        gone = sorted(there.difference(files))
        if len(changed) == 1 and not gone and changed[0] in there:
            replace_file(out / changed[0], content_bytes(files[changed[0]]))
        elif changed or gone:
            _replace_all(files, out, set(changed))
    known.clear()
    known.update({name: (content, found[name]) for name, content in files.items() if name in found})
    return (*changed, *gone)


def _hash_once(name: str, content: Content, known: Hashes) -> bytes:
    before = known.get(name)
    if before is not None and before[0] is content and isinstance(content, bytes):
        return before[1]
    return content_hash(content)


def _replace_all(files: Mapping[str, Content], out: Path, changed: Collection[str]) -> None:
    """The new site beside the old one, then in its place; what has not changed is the same file."""
    fresh = out.with_name(f".{out.name}-{os.getpid()}-new")
    old = out.with_name(f".{out.name}-{os.getpid()}-old")
    try:
        for folder in {(fresh / name).parent for name in files}:
            folder.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            if name in changed:
                (fresh / name).write_bytes(content_bytes(content))
            else:
                _link(out / name, fresh / name)
        _swap(fresh, out, old)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def way_out(error: OSError) -> str:
    """What to do where the disk takes nothing more."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    shut = error.errno in (errno.EROFS, errno.EACCES, errno.EPERM)
    if not (full or shut):
        return ""
    better = "make room" if full else "choose a folder that can be written, by --out"
    return f"; what was built before is as it was; {better}, and build again"


def replace_file(file: Path, data: bytes) -> None:
    """Write one file of a site; who reads it has the old one or the new one, whole."""
    handle, name = tempfile.mkstemp(dir=file.parent, prefix=".new-")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(name).chmod(0o644)
        Path(name).replace(file)
    finally:
        Path(name).unlink(missing_ok=True)


def _check_holds_a_site(out: Path) -> None:
    filled = any(out.iterdir()) if out.is_dir() else out.exists()
    if filled and not (out / "book.json").is_file():
        raise ValueError(f"{out} is not empty and holds no site; legal: an empty folder or a site")


def _swap(fresh: Path, out: Path, old: Path) -> None:
    if not out.exists():
        fresh.rename(out)
    elif not exchange(fresh, out):  # then in two steps, and back where the second fails
        out.rename(old)
        try:
            fresh.rename(out)
        except OSError:
            old.rename(out)
            raise


def _clear_away(out: Path) -> None:
    """What builds left behind that were killed; where one was between its two steps, put the site
    back first."""
    left = re.compile(rf"\.{re.escape(out.name)}-(\d+)-(?:new|old)")
    for place in out.parent.iterdir():
        match = left.fullmatch(place.name)
        if match and not _is_running(int(match[1])):
            if place.name.endswith("-old") and not out.exists():
                place.rename(out)
            else:
                shutil.rmtree(place, ignore_errors=True)


def _is_running(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:  # another user's
        return True
    return True


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Within, no other build swaps a site in this folder."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # some file systems have no locks
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def _names_in(out: Path) -> Iterator[str]:
    start = len(os.fspath(out)) + 1
    for place, _, names in os.walk(out):
        yield from (f"{place}{os.sep}{name}"[start:].replace(os.sep, "/") for name in names)


def _link(previous: Path, target: Path) -> None:
    try:
        os.link(previous, target)
    except OSError:  # some file systems have no links
        shutil.copy2(previous, target)
