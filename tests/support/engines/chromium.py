"""Chromium, as the other tests have it, behind what all engines share."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

from playwright.sync_api import Page
from support.engines.engine import call
from support.reader import Reader


class Chromium:
    """The page of a reader; see `Engine`."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader

    def open(self, url: str) -> None:
        self._reader.page.goto(url)

    def ask(self, expression: str, /, *arguments: Any) -> Any:
        return json.loads(self._reader.page.evaluate(call(expression, arguments)))

    def perform(self, sources: Sequence[Mapping[str, Any]]) -> None:
        for source in sources:
            for action in source["actions"]:
                _act(self._reader.page, action)

    def complaints(self) -> list[str]:
        return self._reader.complaints


def _act(page: Page, action: Mapping[str, Any]) -> None:
    match action["type"]:
        case "pointerMove":
            page.mouse.move(action["x"], action["y"])
        case "pointerDown":
            page.mouse.down()
        case "pointerUp":
            page.mouse.up()
        case "keyDown":
            page.keyboard.down(KEYS.get(action["value"], action["value"]))
        case "keyUp":
            page.keyboard.up(KEYS.get(action["value"], action["value"]))


KEYS = {
    "\ue004": "Tab",
    "\ue007": "Enter",
    "\ue00c": "Escape",
    "\ue00e": "PageUp",
    "\ue00f": "PageDown",
    "\ue010": "End",
    "\ue011": "Home",
    "\ue012": "ArrowLeft",
    "\ue013": "ArrowUp",
    "\ue014": "ArrowRight",
    "\ue015": "ArrowDown",
}
"""Names by the codes of WebDriver (W3C WebDriver, section 17.4.2)."""
