"""What open pages are told of builds."""

import json
import queue
from collections.abc import Iterable
from dataclasses import dataclass, field
from threading import Lock


@dataclass(slots=True)
class News:
    """The state of the last build, and the pages that wait to hear of the next."""

    count: int = 0
    """Builds so far, good or bad."""
    number: int = 0
    """Of the last good one."""
    mistakes: str = ""
    """What the last build said where it failed."""
    changed: tuple[str, ...] = ()
    """Files that the last good build changed."""
    listeners: list["queue.SimpleQueue[str]"] = field(default_factory=list)
    _lock: Lock = field(default_factory=Lock)

    def finish(self, mistakes: str, changed: Iterable[str] = ()) -> None:
        """Take note of a build and tell every open page."""
        with self._lock:
            self.mistakes = mistakes
            self.count += 1
            if not mistakes:
                self.number += 1
                self.changed = tuple(changed)
            for listener in list(self.listeners):
                listener.put(self.event())

    def event(self) -> str:
        """The state as a server-sent event; a comment before the first build is done."""
        if self.mistakes:
            return f"event: failed\ndata: {json.dumps(self.mistakes)}\n\n"
        if not self.number:
            return ": \n\n"
        told = {"number": self.number, "changed": self.changed}
        return f"event: built\ndata: {json.dumps(told)}\n\n"

    def listen(self) -> "queue.SimpleQueue[str]":
        """A queue of events, the present state first."""
        listener: queue.SimpleQueue[str] = queue.SimpleQueue()
        with self._lock:
            listener.put(self.event())
            self.listeners.append(listener)
        return listener

    def leave(self, listener: "queue.SimpleQueue[str]") -> None:
        with self._lock:
            self.listeners.remove(listener)
