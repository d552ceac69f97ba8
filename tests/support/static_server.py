"""A static file server for tests, which can damage files and send further headers."""

import socket
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import unquote

TYPES = {
    ".mjs": "text/javascript", ".js": "text/javascript", ".wasm": "application/wasm",
    ".json": "application/json", ".woff2": "font/woff2", ".svg": "image/svg+xml",
}  # fmt: skip

ODD_PATH = "/%C3%BCb%20v1.2/a+b/"
"""A path with a space, a letter beyond ASCII and a dot."""


def free_port() -> int:
    """A port of this machine on which nobody listens."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault in the reply for a file."""

    change: Callable[[bytes], bytes] = bytes
    status: int = 200
    media_type: str = ""
    """Sent in place of the right one, if not empty."""
    cut: bool = False
    """Whether the connection breaks off in the middle of the file."""
    delay_s: float = 0


def half(content: bytes) -> bytes:
    """The first half and an open bracket, since half of a script may be a valid script."""
    return content[: len(content) // 2] + b"("


def changed(content: bytes) -> bytes:
    """The content with one bit flipped."""
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


def login(_: bytes) -> bytes:
    """The reply of a network that requires a sign-in first."""
    return b"<!DOCTYPE html><title>Sign in to this network</title>"


FAULTS = {
    "missing": Fault(status=404),
    "cut": Fault(cut=True),
    "half": Fault(half),
    "changed": Fault(changed),
    "login": Fault(login, media_type="text/html"),
    "login as file": Fault(login),
}


class QuietServer(ThreadingHTTPServer):
    """A server that ignores connections closed by a browser when it leaves a page."""

    daemon_threads = True

    def handle_error(self, request: object, client_address: object) -> None:
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)  # type: ignore[arg-type]


class StaticServer:
    """Serves the folder ``root`` at ``url``, below a path, with ``headers`` beside the usual ones.

    ``damaged`` maps ends of paths to bytes sent instead of the file, ``faults`` to faults of the
    reply. With ``uncached``, browsers may cache nothing; while ``offline``, no request is answered.
    """

    def __init__(self, root: Path, headers: Mapping[str, str], path: str) -> None:
        self.root = root
        self.path = path
        self.headers = headers
        self.offline = False
        self.uncached = False
        self.damaged: dict[str, bytes] = {}
        self.faults: dict[str, Fault] = {}
        self.server = QuietServer(("127.0.0.1", 0), partial(Handler, owner=self))
        self.url = f"http://127.0.0.1:{self.server.server_address[1]}{path}"


class Handler(SimpleHTTPRequestHandler):
    """Serves below a path, so that a page which assumes the server's root fails its test."""

    extensions_map = SimpleHTTPRequestHandler.extensions_map | TYPES
    protocol_version = "HTTP/1.1"

    def __init__(self, *arguments: object, owner: StaticServer) -> None:
        self.owner = owner
        super().__init__(*arguments, directory=str(owner.root))  # type: ignore[arg-type]

    def do_GET(self) -> None:
        self.directory = str(self.owner.root)
        if self.owner.offline:
            self.close_connection = True
            return
        path = self.path.partition("?")[0]
        for ending, content in self.owner.damaged.items():
            if path.endswith(ending):
                self.send(path, content, Fault())
                return
        for ending, fault in self.owner.faults.items():
            if path.endswith(ending):
                file = self.owner.root / unquote(path.removeprefix(self.owner.path))
                file = file / "index.html" if file.is_dir() else file
                self.send(path, fault.change(file.read_bytes()), fault)
                return
        if not path.startswith(self.owner.path):
            self.send_error(404)
            return
        self.path = f"/{self.path.removeprefix(self.owner.path)}"
        super().do_GET()

    def send(self, path: str, content: bytes, fault: Fault) -> None:
        time.sleep(fault.delay_s)
        self.send_response(fault.status)
        self.send_header("Content-Type", fault.media_type or self.guess_type(path))
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content[: len(content) // 2] if fault.cut else content)
        self.close_connection = fault.cut

    def end_headers(self) -> None:
        if self.owner.uncached:
            self.send_header("Cache-Control", "no-store")
        for name, value in self.owner.headers.items():
            self.send_header(name, value)
        super().end_headers()

    def log_message(self, *_: object) -> None:
        """Tests write no log."""


@contextmanager
def serving(
    root: Path, headers: Mapping[str, str] | None = None, path: str = "/book/"
) -> Iterator[StaticServer]:
    """Serve the folder while the block runs."""
    server = StaticServer(root, headers or {}, path)
    thread = threading.Thread(target=server.server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    try:
        yield server
    finally:
        server.server.shutdown()
        server.server.server_close()
        thread.join()
