"""Further browsers for the tests, where they are installed."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from support.engines.engine import Engine
from support.engines.firefox import find_firefox, open_firefox
from support.engines.webkit import find_webkit, open_webkit

HOW_TO = (
    "its tests are skipped; install it, for example by "
    "`apt-get install firefox-esr webkit2gtk-driver xvfb`"
)


def _firefox(folder: Path) -> AbstractContextManager[Engine] | None:
    found = find_firefox()
    return open_firefox(found, folder) if found else None


def _webkit(folder: Path) -> AbstractContextManager[Engine] | None:
    found = find_webkit()
    return open_webkit(found, folder) if found else None


ENGINES: Mapping[str, Callable[[Path], AbstractContextManager[Engine] | None]] = {
    "Firefox": _firefox,
    "WebKitGTK": _webkit,
}
"""How to open one with an empty folder for its profile; None where it is not installed."""


def open_engine(name: str, folder: Path) -> AbstractContextManager[Engine]:
    """Open it, or skip the test."""
    opened = ENGINES[name](folder)
    if opened is None:
        pytest.skip(f"{name}: {HOW_TO}")
    return opened
