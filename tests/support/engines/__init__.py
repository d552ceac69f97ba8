"""Firefox and WebKitGTK for the tests, if they are installed."""

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
"""Each opens a browser with an empty folder as its profile; None if it is not installed."""


def open_engine(name: str, folder: Path) -> AbstractContextManager[Engine]:
    """Open the browser, or skip the test if it is not installed."""
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

    def evaluate(self, expression: str, /, *arguments: Any) -> Any:
        return self._page.evaluate(f"(given) => ({expression})(...given)", arguments)


@contextmanager
def window(name: str, chromium: Browser, folder: Path) -> Iterator[Window]:
    """A window with a fresh profile of the named browser; skip the test if it is not installed."""
    if name == "Chromium":
        with chromium.new_context(service_workers="block") as context:
            yield Tab(context.new_page())
        return
    with open_engine(name, folder) as engine:
        yield engine
