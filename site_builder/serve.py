"""Build, show, and build again on every change.

Each rebuild runs in a fresh process, so that changed Python counts. The site is served as a
static host would, plus two addresses below ``/.reload/`` that tell open pages of new builds.
"""

import functools
import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from watchfiles import DefaultFilter, watch

from site_builder.book_root import ENGINE, VARIABLE

WATCHED = ("content", "simulations", "static", "site_builder")
CLIENT = Path(__file__).with_name("reload.js")
KEEP_ALIVE_S = 15.0
LOOK_MS = 200
"""Longest wait for a change before the watcher says that there was none."""


@dataclass(slots=True)
class Builds:
    """The state of the last build, and the pages that wait to hear of the next."""

    count: int = 0
    """Builds so far, good or bad."""
    number: int = 0
    """Of the last good one."""
    mistakes: str = ""
    """What the last build printed where it failed."""
    listeners: list["queue.SimpleQueue[str]"] = field(default_factory=list)

    def finish(self, mistakes: str) -> None:
        """Take note of a build and tell every open page."""
        self.mistakes = mistakes
        self.count += 1
        self.number += not mistakes
        for listener in list(self.listeners):
            listener.put(self.event())

    def event(self) -> str:
        """The state as a server-sent event."""
        if self.mistakes:
            return f"event: failed\ndata: {json.dumps(self.mistakes)}\n\n"
        return f"event: built\ndata: {self.number}\n\n"


def serve(root: Path, out: Path, port: int, *, runtime: bool) -> None:
    """Serve until interrupted. Raises `OSError` with a clear message where the port is taken."""
    builds = Builds()
    server = start_server(out, port, builds)
    print(f"http://localhost:{server.server_address[1]}/", flush=True)
    try:
        folders = {base / name for base in (root, ENGINE) for name in WATCHED}
        for changes in _rounds(sorted(folder for folder in folders if folder.is_dir())):
            # The first build, too, is made under watch: what is saved meanwhile makes a second.
            if changes or not builds.count:
                rebuild(root, out, builds, runtime=runtime)
    except KeyboardInterrupt:
        print()  # the usual way to end
    finally:
        server.shutdown()
        server.server_close()


def _rounds(folders: list[Path]) -> Iterator[Collection[object]]:
    """The changes of each round, mostly none."""
    ignore = DefaultFilter(ignore_entity_patterns=(*DefaultFilter.ignore_entity_patterns, r"^\."))
    return watch(
        *folders,
        watch_filter=ignore,
        rust_timeout=LOOK_MS,
        yield_on_timeout=True,
    )


def rebuild(root: Path, out: Path, builds: Builds, *, runtime: bool) -> None:
    """One build in a process of its own."""
    command = [
        sys.executable,
        "-m",
        "site_builder",
        "build",
        "--out",
        str(out.resolve()),
        "--reload",
    ]
    done = subprocess.run(
        [*command, *([] if runtime else ["--no-runtime"])],
        cwd=ENGINE, env={**os.environ, VARIABLE: str(root)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    print(done.stdout + done.stderr, end="", flush=True)
    builds.finish(done.stderr or "the build failed" if done.returncode else "")


def start_server(out: Path, port: int, builds: Builds) -> ThreadingHTTPServer:
    """A server of the folder ``out``, running in a thread."""
    handler = functools.partial(Handler, directory=str(out), builds=builds)
    try:
        server = ThreadingHTTPServer(("", port), handler)
    except (OSError, OverflowError) as error:
        another = port + 1 if 0 < port < 65535 else 8000
        raise OSError(f"port {port} is taken or refused; try another: PORT={another}") from error
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


class Handler(SimpleHTTPRequestHandler):
    """Static files, the client of `serve`, and its stream of events."""

    extensions_map = {  # noqa: RUF012  (declared without ClassVar in the base class)
        **SimpleHTTPRequestHandler.extensions_map,
        ".mjs": "text/javascript",
        ".js": "text/javascript",
        ".wasm": "application/wasm",
        ".json": "application/json",
        ".svg": "image/svg+xml",
        ".woff2": "font/woff2",
    }

    def __init__(self, *args: object, builds: Builds, **kwargs: object) -> None:
        self.builds = builds
        super().__init__(*args, **kwargs)  # type: ignore[arg-type]

    def do_GET(self) -> None:
        if self.path == "/.reload/events":
            self._stream_events()
        elif self.path == "/.reload/client.js":
            self._send("text/javascript", CLIENT.read_bytes())
        elif self.builds.mistakes and not Path(self.directory).is_dir():
            self._send("text/html; charset=utf-8", FIRST_BUILD_FAILED, status=503)
        else:
            super().do_GET()

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        page = Path(self.directory) / "404.html"
        if code == 404 and page.is_file():
            self._send("text/html; charset=utf-8", page.read_bytes(), status=404)
        else:
            super().send_error(code, message, explain)

    def end_headers(self) -> None:
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    def log_message(self, format: str, *args: object) -> None:
        """Quiet: the terminal is for diagnostics."""

    def _send(self, kind: str, body: bytes, status: int = 200) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def _stream_events(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.end_headers()
        listener: queue.SimpleQueue[str] = queue.SimpleQueue()
        self.builds.listeners.append(listener)
        try:
            event = self.builds.event() if self.builds.number or self.builds.mistakes else ": \n\n"
            while True:
                self.wfile.write(event.encode())
                self.wfile.flush()
                try:
                    event = listener.get(timeout=KEEP_ALIVE_S)
                except queue.Empty:
                    event = ": still here\n\n"
        except (BrokenPipeError, ConnectionResetError):
            pass
        finally:
            self.builds.listeners.remove(listener)


FIRST_BUILD_FAILED = (
    b"<!DOCTYPE html><meta charset=utf-8><title>Not built yet</title>"
    b"<body><p>The book could not be built.</p><script src=/.reload/client.js></script>"
)
"""Shown where there is no site yet to lay the mistakes over."""
