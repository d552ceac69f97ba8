"""WebKitGTK by WebDriver: the driver, a window, and a virtual screen."""

import json
import os
import re
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import Request, urlopen

from support.engines.engine import call
from support.limits import LONGEST_S, limit_s
from support.static_server import free_port

PACKAGES = ("webkit2gtk-driver", "gir1.2-webkit2-4.1", "python3-gi", "xvfb")
"""Packages of Debian."""
DRIVER, SCREEN, PYTHON = "WebKitWebDriver", "Xvfb", "/usr/bin/python3"
WINDOW = Path(__file__).with_name("webkit_window.py")
IMPORTS_WEBKIT = "import gi; gi.require_version('WebKit2', '4.1'); gi.require_version('Gtk', '3.0')"
CONSOLE = "console.txt"
CANCELLED = re.compile(
    r"Fetch API cannot load http://127\.0\.0\.1:\S+ due to access control checks"
)
"""Logged when a page is left before a request to its own host is answered, though no access check
applies to its own host."""


def find_webkit() -> Path | None:
    """The driver, if the virtual screen and the library for the window are installed too."""
    found = shutil.which(DRIVER)
    if not (found and shutil.which(SCREEN) and Path(PYTHON).exists()):
        return None
    window = subprocess.run([PYTHON, "-c", IMPORTS_WEBKIT], stderr=subprocess.DEVNULL, check=False)
    return Path(found) if window.returncode == 0 else None


class WebKit:
    """One window; see `Engine`."""

    def __init__(self, driver: str, profile: Path) -> None:
        """``driver``: its address. ``profile``: a folder."""
        self._address = f"{driver}/session"
        self._console = profile / CONSOLE
        options = {"binary": PYTHON, "args": [str(WINDOW), str(profile)]}
        wanted = {"alwaysMatch": {"webkitgtk:browserOptions": options}}
        session = self._send("", capabilities=wanted)["sessionId"]
        self._address += f"/{session}"
        limit_ms = round(2000 * LONGEST_S)
        self._send("/timeouts", script=limit_ms, pageLoad=limit_ms)

    def open(self, url: str) -> None:
        self._send("/url", url=url)

    def evaluate(self, expression: str, /, *arguments: Any) -> Any:
        script = f"return {call(expression, arguments)}"
        return json.loads(self._send("/execute/sync", script=script, args=[]))

    def perform(self, sources: Sequence[Mapping[str, Any]]) -> None:
        self._send("/actions", actions=sources)

    def errors(self) -> list[str]:
        written = self._console.read_text(encoding="utf-8", errors="replace").splitlines()
        errors = [line for line in written if "CONSOLE" in line and " ERROR " in line]
        return [line for line in errors if not CANCELLED.search(line)]

    def _send(self, command: str, **parameters: Any) -> Any:
        request = Request(
            self._address + command,
            json.dumps(parameters).encode(),
            {"Content-Type": "application/json"},
        )
        try:
            with urlopen(request, timeout=3 * LONGEST_S) as reply:
                return json.load(reply)["value"]
        except HTTPError as error:
            answer = json.load(error)["value"]
            raise RuntimeError(f"{command}: {answer['error']}: {answer['message']}") from error


@contextmanager
def open_webkit(driver: Path, profile: Path) -> Iterator[WebKit]:
    """Start WebKitGTK with this empty folder as its profile."""
    port = free_port()
    command = [str(driver), f"--port={port}"]
    with _screen() as display, (profile / CONSOLE).open("w", encoding="utf-8") as console:
        environment = {**os.environ, "HOME": str(profile), "DISPLAY": display, "GDK_BACKEND": "x11"}
        with subprocess.Popen(
            command,
            stdout=console,
            stderr=subprocess.STDOUT,
            env=environment,
            start_new_session=True,
        ) as process:
            try:
                address = f"http://127.0.0.1:{port}"
                _wait_for_driver(address)
                yield WebKit(address, profile)
            finally:
                os.killpg(process.pid, signal.SIGTERM)  # with the window, its child


@contextmanager
def _screen() -> Iterator[str]:
    """The name of a virtual screen."""
    command = [SCREEN, "-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        try:
            assert process.stdout
            yield f":{process.stdout.readline().strip()}"  # written once it can be used
        finally:
            process.terminate()


def _wait_for_driver(address: str) -> None:
    """Wait until the driver answers; raises `TimeoutError`."""
    end = time.monotonic() + limit_s()
    while time.monotonic() < end:
        with suppress(URLError), urlopen(f"{address}/status", timeout=3 * limit_s()):
            return
        time.sleep(0.05)
    raise TimeoutError("the WebKit driver does not answer")
