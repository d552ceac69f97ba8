"""Writing the site: beside the old one first, then swapped in whole."""

import fcntl
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from site_builder.kept.files import bytes_hash, file_hash
from site_builder.output.assets import Content
from site_builder.output.exchange import exchange


def write_site(files: Mapping[str, Content], out: Path) -> tuple[str, ...]:
    """Replace the folder ``out`` by ``files``; returns the names of those that are not as before.

    The last good site stays as it is until the new one is complete; of two builds into one folder
    the later one stays. Files that have not changed keep their modification time. Raises
    `ValueError` where ``out`` holds something else than a site, which would be lost.
    """
    _check_holds_a_site(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    _clear_away(out)
    fresh = out.with_name(f".{out.name}-{os.getpid()}-new")
    old = out.with_name(f".{out.name}-{os.getpid()}-old")
    try:
        changed = [name for name in files if not _write_file(fresh / name, files[name], out / name)]
        gone = [name for name in _names_in(out) if name not in files]
        with _alone(out.parent):
            _swap(fresh, out, old)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)
    return (*changed, *gone)


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


def _write_file(target: Path, content: Content, previous: Path) -> bool:
    """Whether it is as it was; then it is the same file."""
    target.parent.mkdir(parents=True, exist_ok=True)
    data = content if isinstance(content, bytes) else None
    hashed = file_hash(content) if isinstance(content, Path) else bytes_hash(content)
    if hashed is not None and file_hash(previous) == hashed:
        try:
            os.link(previous, target)
        except OSError:  # some file systems have no links
            shutil.copy2(previous, target)
        return True
    target.write_bytes(content.read_bytes() if isinstance(content, Path) else data or b"")
    return False
