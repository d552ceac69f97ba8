"""Writing the site: beside the old one first, then moved into its place as a whole."""

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


def write_site(files: Mapping[str, Content], out: Path) -> tuple[str, ...]:
    """Replace the folder ``out`` by ``files``; returns the names of those that are not as before.

    The last good site stays as it is until the new one is complete; of two builds into one folder
    the later one stays. Files that have not changed keep their modification time. Raises
    `ValueError` where ``out`` holds something else than a site, which would be lost.
    """
    filled = any(out.iterdir()) if out.is_dir() else out.exists()
    if filled and not (out / "book.json").is_file():
        raise ValueError(f"{out} is not empty and holds no site; legal: an empty folder or a site")
    out.parent.mkdir(parents=True, exist_ok=True)
    _clear_away(out)
    with _alone(out.parent):
        there = {file.relative_to(out).as_posix() for file in out.rglob("*") if file.is_file()}
        changed = [
            name
            for name, content in files.items()
            if name not in there or file_hash(out / name) != content_hash(content)
        ]
        gone = sorted(there.difference(files))
        if changed or gone:
            _replace(files, out, set(changed))
    return (*changed, *gone)


def _replace(files: Mapping[str, Content], out: Path, changed: Collection[str]) -> None:
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
        if out.exists():
            out.rename(old)
        try:
            fresh.rename(out)
        except OSError:
            if old.exists():
                old.rename(out)
            raise
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
    """Write one file of a site: readers of it have the old one or the new one, whole."""
    handle, name = tempfile.mkstemp(dir=file.parent, prefix=".new-")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(name).chmod(0o644)
        Path(name).replace(file)
    finally:
        Path(name).unlink(missing_ok=True)


def _clear_away(out: Path) -> None:
    """What builds left behind that were killed; where one had moved the site away, put it back."""
    left = re.compile(rf"\.{re.escape(out.name)}-(\d+)-(?:new|old)")
    for place in out.parent.iterdir():
        match = left.fullmatch(place.name)
        if not match or _is_running(int(match[1])):
            continue
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
    """Within, no other build replaces a site in this folder."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # some file systems have no locks
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def _link(previous: Path, target: Path) -> None:
    try:
        os.link(previous, target)
    except OSError:  # some file systems have no links
        shutil.copy2(previous, target)
