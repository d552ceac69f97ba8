"""Further browsers for the tests, where they are installed."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from pathlib import Path

from support.engines.engine import Engine
from support.engines.firefox import find_firefox, open_firefox

HOW_TO = "its tests are skipped; install it, for example by `apt-get install firefox-esr`"


def _firefox(folder: Path) -> AbstractContextManager[Engine] | None:
    found = find_firefox()
    return open_firefox(found, folder) if found else None


ENGINES: Mapping[str, Callable[[Path], AbstractContextManager[Engine] | None]] = {
    "Firefox": _firefox,
}
"""How to open one with an empty folder for its profile; None where it is not installed."""
