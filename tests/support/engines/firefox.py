"""Firefox by WebDriver BiDi, which it implements itself, without a driver."""

import json
import shutil
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from support.engines.engine import call
from support.limits import limit_s
from websockets.sync.client import ClientConnection, connect

NAMES = ("firefox-esr", "firefox")
SERVER = "WebDriverBiDiServer.json"

PREFERENCES = {
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.page": 0,
    "datareporting.policy.dataSubmissionEnabled": False,
    "toolkit.telemetry.enabled": False,
}

INCOMPLETE_FORMULA = "Invalid markup: Incorrect number of children"
"""Logged for each formula whose end arrives later than its beginning."""


def find_firefox() -> Path | None:
    return next((Path(found) for name in NAMES if (found := shutil.which(name))), None)


class Firefox:
    """One window; see `Engine`."""

    def __init__(self, connection: ClientConnection) -> None:
        self._connection = connection
        self._last = 0
        self._errors: list[str] = []
        self._send("session.new", capabilities={})
        self._send("session.subscribe", events=["log.entryAdded"])
        self._context = self._send("browsingContext.getTree")["contexts"][0]["context"]
        self._send(
            "browsingContext.setViewport",
            context=self._context,
            viewport={"width": 1280, "height": 900},
        )

    def open(self, url: str) -> None:
        self._send("browsingContext.navigate", context=self._context, url=url, wait="complete")

    def evaluate(self, expression: str, /, *arguments: Any) -> Any:
        answer = self._send(
            "script.evaluate",
            expression=call(expression, arguments),
            target={"context": self._context},
            awaitPromise=True,
        )
        if answer["type"] == "exception":
            raise RuntimeError(answer["exceptionDetails"]["text"])
        return json.loads(answer["result"]["value"])

    def perform(self, sources: Sequence[Mapping[str, Any]]) -> None:
        self._send("input.performActions", context=self._context, actions=sources)

    def errors(self) -> list[str]:
        self._send("session.status")  # earlier messages arrive before this answer
        return self._errors

    def _send(self, method: str, **parameters: Any) -> Any:
        self._last += 1
        self._connection.send(
            json.dumps({"id": self._last, "method": method, "params": parameters})
        )
        while True:
            message = json.loads(self._connection.recv(2 * limit_s()))
            if message.get("method") == "log.entryAdded":
                self._note(message["params"])
            elif message.get("id") == self._last:
                if message["type"] == "error":
                    raise RuntimeError(f"{method}: {message['error']}: {message['message']}")
                return message["result"]

    def _note(self, entry: Mapping[str, Any]) -> None:
        if entry["level"] == "error" and not entry["text"].startswith(INCOMPLETE_FORMULA):
            self._errors.append(entry["text"])


@contextmanager
def open_firefox(binary: Path, profile: Path) -> Iterator[Firefox]:
    """Start Firefox with this empty folder as its profile."""
    lines = (f"user_pref({json.dumps(n)}, {json.dumps(v)});\n" for n, v in PREFERENCES.items())
    (profile / "user.js").write_text("".join(lines), encoding="utf-8")
    command = [str(binary), "--headless", "--no-remote", "--profile", str(profile)]
    command += ["--remote-debugging-port", "0", "about:blank"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            with connect(f"{_address(profile)}/session", max_size=None) as connection:
                yield Firefox(connection)
        finally:
            process.terminate()


def _address(profile: Path) -> str:
    """The address that it listens at, which it writes into its profile; raises `TimeoutError`."""
    end = time.monotonic() + limit_s()
    while time.monotonic() < end:
        with suppress(FileNotFoundError, ValueError):  # not there yet, or not yet whole
            listening = json.loads((profile / SERVER).read_text(encoding="utf-8"))
            return f"ws://{listening['ws_host']}:{listening['ws_port']}"
        time.sleep(0.05)
    raise TimeoutError("Firefox does not listen")
