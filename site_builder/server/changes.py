"""What changes below the folders that a build reads."""

import re
from collections.abc import AsyncIterator, Collection, Mapping
from pathlib import Path

from watchfiles import Change, awatch

from site_builder.files.folders import folder_files

DEBOUNCE_MS = 100
STEP_MS = 10
"""How long nothing more must change before a change is reported."""
LOOK_MS = 1000
"""After which is looked for what the system does not report: folders replaced, and files changed
behind symbolic links."""
IGNORED = re.compile(r"\.|__pycache__$|.*(?:~|\.py[cod]|\.sw.|___jb_..._)$")
"""Names of what editors and Python write beside the sources."""

type Inodes = Mapping[Path, tuple[int, int]]


async def changes(folders: Collection[Path], made: Path) -> AsyncIterator[set[Path]]:
    """Changed files, time after time. The folder ``made`` is reported once it is gone."""

    def is_source(_change: Change, name: str) -> bool:
        """By its path below the folder, wherever that lies."""
        path = Path(name)
        inside = next(
            (path.relative_to(each) for each in folders if path.is_relative_to(each)), path
        )
        return not any(map(IGNORED.match, inside.parts))

    before, looks_without = _inodes(folders), 2
    while True:
        present = sorted(folder for folder in folders if folder.is_dir())
        async for found in awatch(
            *present, watch_filter=is_source, debounce=DEBOUNCE_MS, step=STEP_MS,
            rust_timeout=LOOK_MS, yield_on_timeout=True,
        ):  # fmt: skip
            now = _inodes(folders)
            looks_without = 0 if made.is_dir() else looks_without + 1  # a build swaps it, too
            unreported = {path for path in {*before, *now} if before.get(path) != now.get(path)}
            gone = {made} if looks_without == 2 else set()
            before = now
            if changed := {Path(name) for _, name in found} | unreported | gone:
                yield changed
            if unreported & {*folders}:
                break


def _inodes(folders: Collection[Path]) -> Inodes:
    """Of the folders, and of what links in them lead to, with its time of change."""
    found: dict[Path, tuple[int, int]] = {}
    for folder in folders:
        if folder.is_dir():
            found[folder] = (folder.stat().st_ino, 0)
            for path in folder_files(folder).values():
                if path.is_symlink():
                    state = path.stat()
                    found[path] = (state.st_ino, state.st_mtime_ns)
    return found
