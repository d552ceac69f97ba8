"""Further browsers for the tests, where they are installed."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from support.engines.engine import Engine, Window
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


class Tab:
    """A page of Chromium; see `Window`."""

    def __init__(self, page: Page) -> None:
        self._page = page

    def open(self, url: str) -> None:
        self._page.goto(url)

    def ask(self, expression: str, /, *arguments: Any) -> Any:
        return self._page.evaluate(f"(given) => ({expression})(...given)", arguments)


@contextmanager
def window(name: str, chromium: Browser, folder: Path) -> Iterator[Window]:
    """A window of the browser of that name with a fresh profile; skip the test without one."""
    if name == "Chromium":
        with chromium.new_context(service_workers="block") as context:
            yield Tab(context.new_page())
        return
    with open_engine(name, folder) as engine:
        yield engine
