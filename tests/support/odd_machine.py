"""``python odd_machine.py ROOT OUT``: build a book where folders list their files backwards."""

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

scan, names = os.scandir, os.listdir


class Backwards:
    """What ``os.scandir`` gives, the last name first."""

    def __init__(self, *folder: Any) -> None:
        with scan(*folder) as entries:
            self.entries = iter(sorted(entries, key=lambda entry: entry.name, reverse=True))

    def __iter__(self) -> Iterator[os.DirEntry[str]]:
        return self.entries

    def __next__(self) -> os.DirEntry[str]:
        return next(self.entries)

    def __enter__(self) -> "Backwards":
        return self

    def __exit__(self, *_: object) -> None: ...


if __name__ == "__main__":
    os.scandir = Backwards  # type: ignore[assignment]
    os.listdir = lambda *folder: sorted(names(*folder), reverse=True)  # type: ignore[assignment]
    from site_builder.build import Options, build_site

    build_site(Options(Path(sys.argv[1]), runtime=False), Path(sys.argv[2]))
