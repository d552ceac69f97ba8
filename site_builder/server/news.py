"""The state of the builds for open pages, as server-sent events."""

import asyncio
import json
from collections.abc import AsyncIterator, Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class State:
    """The builds so far."""

    number: int = 0
    """Number of the last good build; 0 before the first."""
    changed: tuple[str, ...] = ()
    """Files that the last good build changed, relative to the site."""
    mistakes: str = ""
    """What the last build printed where it failed."""

    def event(self) -> str:
        """
        >>> State(2, ("a/index.html",)).event()
        'event: built\\ndata: {"number": 2, "changed": ["a/index.html"]}\\n\\n'
        """
        if self.mistakes:
            return f"event: failed\ndata: {json.dumps(self.mistakes)}\n\n"
        if not self.number:
            return ": \n\n"
        data = {"number": self.number, "changed": self.changed}
        return f"event: built\ndata: {json.dumps(data)}\n\n"


class News:
    """The present state, and a stream of it for each open page."""

    def __init__(self) -> None:
        self.state = State()
        self._newer = asyncio.Event()

    def succeed(self, changed: Iterable[str]) -> None:
        self._publish(State(self.state.number + 1, tuple(changed)))

    def fail(self, mistakes: str) -> None:
        self._publish(State(self.state.number, self.state.changed, mistakes))

    def restart(self) -> None:
        """Return to the state before the first build: what was built is gone."""
        self._publish(State())

    async def events(self) -> AsyncIterator[str]:
        """The present state first. A slow reader gets the newest state, not each one."""
        while True:
            newer = self._newer
            yield self.state.event()
            await newer.wait()

    def _publish(self, state: State) -> None:
        self.state = state
        self._newer.set()
        self._newer = asyncio.Event()
