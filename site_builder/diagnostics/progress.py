"""How far a long build is: one line with a bar, on a terminal, once a step has taken a second."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO

_terminal: TextIO | None = None
_bars: list[Any] = []
"""Of the step that runs."""


def show_progress(stream: TextIO | None) -> None:
    """From now on, on ``stream`` if that is a terminal."""
    global _terminal
    _terminal = stream if stream and stream.isatty() else None


@contextmanager
def counting(what: str, total: int) -> Iterator[None]:
    """A step that makes so many of these, with a call of `advance` for each."""
    if _terminal is None or not total:
        yield
        return
    from tqdm import tqdm  # imported only where it is shown

    with tqdm(total=total, desc=what, file=_terminal, delay=1, leave=False) as bar:
        _bars.append(bar)
        try:
            yield
        finally:
            _bars.remove(bar)


def advance() -> None:
    for bar in _bars:
        bar.update()


def say(line: str, stream: TextIO) -> None:
    """Print the line, above the bar."""
    for bar in _bars:
        bar.clear()
    print(line, file=stream, flush=True)
