"""The interface to a browser of any make: pages, scripts, pointers and keys."""

import json
import time
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from support.limits import limit_s

LEFT_BUTTON = 0

type Action = Mapping[str, Any]
"""One step of a pointer or of keys (W3C WebDriver, section 15)."""


class Window(Protocol):
    """One window of a browser."""

    def open(self, url: str) -> None:
        """Load a page, and wait until it has loaded."""

    def evaluate(self, expression: str, /, *arguments: Any) -> Any:
        """The JSON result of a function in the page, or of its promise."""


class Engine(Window, Protocol):
    """A window with a fresh profile, controlled by WebDriver."""

    def perform(self, sources: Sequence[Mapping[str, Any]]) -> None:
        """Move pointers and press keys."""

    def errors(self) -> list[str]:
        """Errors in the browser's console, including violations of the content policy."""


def wait_for(engine: Window, expression: str, /, *arguments: Any) -> None:
    """Wait until a function in the page returns a true value; raises `TimeoutError`."""
    end = time.monotonic() + 2 * limit_s()
    while not engine.evaluate(expression, *arguments):
        if time.monotonic() > end:
            raise TimeoutError(f"{expression} {json.dumps(arguments)}")
        time.sleep(0.05)


def press(engine: Engine, *keys: str) -> None:
    """Press and release keys one after another."""
    steps = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
    engine.perform([{"type": "key", "id": "keyboard", "actions": steps}])


def drag(engine: Engine, *places: tuple[float, float]) -> None:
    """Press at the first of these places in the window, and release at the last."""
    moves = [_move(place) for place in places]
    down, up = ({"type": kind, "button": LEFT_BUTTON} for kind in ("pointerDown", "pointerUp"))
    _point(engine, [moves[0], down, *moves[1:], up])


def click(engine: Engine, place: tuple[float, float]) -> None:
    drag(engine, place)


def _move(place: tuple[float, float]) -> Action:
    x, y = map(round, place)
    return {"type": "pointerMove", "x": x, "y": y, "duration": 30, "origin": "viewport"}


def _point(engine: Engine, steps: Sequence[Action]) -> None:
    kind = {"pointerType": "mouse"}
    engine.perform([{"type": "pointer", "id": "mouse", "parameters": kind, "actions": steps}])


def call(expression: str, arguments: Sequence[Any]) -> str:
    """A script that calls a function and returns its result as JSON."""
    given = ", ".join(map(json.dumps, arguments))
    return f"(async () => JSON.stringify(await ({expression})({given})) ?? 'null')()"
