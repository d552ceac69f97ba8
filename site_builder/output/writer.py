"""Files of the site: their contents, folders that are named by a hash of these, and the writing of
all, beside the old site first, then moved into its place as a whole."""

import errno
import fcntl
import hashlib
import os
import shutil
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from site_builder.files.folders import bytes_hash, file_hash, folder_files, replace_file

type Content = bytes | Path
"""The bytes of a file, or its path."""


def hashed_folder(kind: str, files: Mapping[str, Content]) -> tuple[str, dict[str, Content]]:
    """The folder ``KIND/HASH/`` and the files under it.

    One folder for all, not one hash per file: ES modules and style sheets keep referring to each
    other by relative addresses.
    """
    digest = hashlib.sha256()
    for name in sorted(files):
        digest.update(name.encode() + b"\0" + content_hash(files[name]))
    folder = f"{kind}/{digest.hexdigest()[:12]}/"
    return folder, {folder + name: content for name, content in files.items()}


def content_hash(content: Content) -> bytes:
    if isinstance(content, bytes):
        return bytes_hash(content)
    return file_hash(content) or bytes_hash(content.read_bytes())


def content_bytes(content: Content) -> bytes:
    return content if isinstance(content, bytes) else content.read_bytes()


def write_site(
    files: Mapping[str, Content], out: Path, *, known_by: str = "book.json"
) -> tuple[str, ...]:
    """Replace the folder ``out`` by ``files``; returns the names of those that are not as before.

    The last good site stays as it is until the new one is complete; of two builds into one folder
    the later one stays. Files that have not changed keep their modification time. Raises
    `ValueError` where ``out`` holds something else than a site, which would be lost: a folder
    without the file that it is ``known_by``.
    """
    out = out.resolve()
    filled = any(out.iterdir()) if out.is_dir() else out.exists()
    if filled and not (out / known_by).is_file():
        raise ValueError(f"{out} is not empty and holds no site; legal: an empty folder or a site")
    out.parent.mkdir(parents=True, exist_ok=True)
    with _locked(out.parent):
        fresh, old = (out.with_name(f".{out.name}-{age}") for age in ("new", "old"))
        if old.exists() and not out.exists():  # a build was killed while it put the new one there
            old.rename(out)
        there = {file.relative_to(out).as_posix() for file in out.rglob("*") if file.is_file()}
        changed = [
            name
            for name, content in files.items()
            if name not in there or file_hash(out / name) != content_hash(content)
        ]
        gone = sorted(there.difference(files))
        try:
            if changed or gone:
                _remove(fresh, old)
                _fill(fresh, files, out, set(changed))
                _swap(fresh, out, old)
        finally:
            _remove(fresh, old)
    return (*changed, *gone)


def _remove(*folders: Path) -> None:
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)


def _fill(fresh: Path, files: Mapping[str, Content], out: Path, changed: Collection[str]) -> None:
    """The new site beside the old one; what has not changed is the same file."""
    for folder in {(fresh / name).parent for name in files}:
        folder.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        if name in changed:
            (fresh / name).write_bytes(content_bytes(content))
        else:
            _link(out / name, fresh / name)


def _swap(fresh: Path, out: Path, old: Path) -> None:
    if out.exists():
        try:
            out.rename(old)
        except OSError as error:
            if error.errno not in (errno.EBUSY, errno.EXDEV):
                raise
            _fill_in_place(fresh, out)  # it is a mount point
            return
    try:
        fresh.rename(out)
    except OSError:
        if old.exists():
            old.rename(out)
        raise


def _fill_in_place(fresh: Path, out: Path) -> None:
    """Each file whole, those that pages load before the pages."""
    new = sorted(folder_files(fresh), key=lambda name: name.endswith((".html", ".json")))
    for name in new:
        replace_file(out / name, (fresh / name).read_bytes())
    for name in folder_files(out).keys() - {*new}:
        (out / name).unlink()


def advice(error: OSError) -> str:
    """What to do where the disk takes nothing more."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    shut = error.errno in (errno.EROFS, errno.EACCES, errno.EPERM)
    if not (full or shut):
        return ""
    better = "make room" if full else "make its folder writable, or choose another one by --out"
    return f"; what was built before is as it was; {better}, and build again"


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
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
