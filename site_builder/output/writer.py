"""Writing the site: beside the old one first, then swapped in whole."""

import os
import shutil
from collections.abc import Mapping
from pathlib import Path

from site_builder.output.assets import Content, content_bytes


def write_site(files: Mapping[str, Content], out: Path) -> None:
    """Replace the folder ``out`` by ``files``.

    The last good site stays as it is until the new one is complete. Files that have not changed
    keep their modification time. Raises `ValueError` where ``out`` holds something else than a
    site, which would be lost.
    """
    filled = any(out.iterdir()) if out.is_dir() else out.exists()
    if filled and not (out / "book.json").is_file():
        raise ValueError(f"{out} is not empty and holds no site; legal: an empty folder or a site")
    out.parent.mkdir(parents=True, exist_ok=True)
    fresh = out.with_name(f".{out.name}-{os.getpid()}-new")
    old = out.with_name(f".{out.name}-{os.getpid()}-old")
    try:
        for name, content in files.items():
            _write_file(fresh / name, content, out / name)
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


def _write_file(target: Path, content: Content, previous: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    data = content_bytes(content)
    target.write_bytes(data)
    if (
        previous.is_file()
        and previous.stat().st_size == len(data)
        and previous.read_bytes() == data
    ):
        stat = previous.stat()
        os.utime(target, ns=(stat.st_atime_ns, stat.st_mtime_ns))
