"""A small package of ``simulations`` that no book has, for tests of what reads authors' modules."""

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import simulations

PACKAGE = "simulations.small"


@contextmanager
def small_package(folder: Path, modules: Mapping[str, str]) -> Iterator[None]:
    """The package, of these sources by the names of their modules, while the block runs."""
    room = folder / "simulations" / "small"
    room.mkdir(parents=True)
    for name, source in {"__init__": "", **modules}.items():
        (room / f"{name}.py").write_text(source, encoding="utf-8")
    sys.path.append(str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in [name for name in sys.modules if name.startswith(PACKAGE)]:
            del sys.modules[name]
        vars(simulations).pop("small", None)
