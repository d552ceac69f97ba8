"""Build, show, and build again on every change.

A worker builds and keeps what it has made in memory; Python that has changed runs in a fresh one.
"""

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from watchfiles import DefaultFilter, watch

from site_builder.book_root import ENGINE
from site_builder.serving.news import News
from site_builder.serving.server import LOOPBACK, start_server
from site_builder.serving.workshop import Workshop

WATCHED = ("content", "simulations", "static", "site_builder")
LOOK_MS = 100
"""Longest wait for a change before the watcher says that there was none."""
STEP_MS = 10
"""How long nothing more must change until a change is told."""


def serve(root: Path, out: Path, port: int, *, runtime: bool, host: str = LOOPBACK) -> None:
    """Serve until interrupted. Raises `OSError` with a clear message where the port is taken.

    The address is told when the first page can be shown.
    """
    news = News()
    server = start_server(out, port, news, host)
    shown = "localhost" if host == LOOPBACK else host
    address = f"http://{shown}:{server.server_address[1]}/"

    def report(told: Mapping[str, Any]) -> None:
        print(told.get("printed", ""), end="", file=sys.stderr, flush=True)
        mistakes = told["mistakes"]
        print(mistakes or f"built: {told['said']}", flush=True)
        first = not news.count
        news.finish(mistakes, told.get("changed", ()))
        if first:
            print(address, flush=True)

    workshop = Workshop(root, out, runtime, report)
    try:
        folders = {base / name for base in (root, ENGINE) for name in WATCHED}
        begun = False
        for changes in _rounds(sorted(folder for folder in folders if folder.is_dir())):
            # The first build, too, is made under watch: what is saved meanwhile makes a second.
            if changes or not begun:
                workshop.build([path for path in changes if is_code(path)] if begun else ())
                begun = True
            workshop.tick()
    except KeyboardInterrupt:
        print()  # the usual way to end
    finally:
        workshop.close()
        server.shutdown()
        server.server_close()


def is_code(path: str) -> bool:
    """Whether a worker has it in memory for good: code, and what code reads once."""
    data = "site_builder" in path and path.endswith((".json", ".toml"))
    return data or path.endswith((".py", ".mjs"))


def _rounds(folders: list[Path]) -> Iterator[list[str]]:
    """The changed files of each round, mostly none."""
    ignore = DefaultFilter(ignore_entity_patterns=(*DefaultFilter.ignore_entity_patterns, r"^\."))
    rounds = watch(
        *folders,
        watch_filter=ignore,
        debounce=LOOK_MS,
        step=STEP_MS,
        rust_timeout=LOOK_MS,
        yield_on_timeout=True,
    )
    for changes in rounds:
        yield [path for _change, path in changes]
