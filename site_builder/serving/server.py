"""The site as a static host would serve it, and two addresses below ``/.reload/`` for open pages.

It answers only to its own names: another site that a browser is led to take for this one, by a
name that its owner lets point here, is refused.
"""

import functools
import io
import ipaddress
import queue
import socket
import threading
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from site_builder.serving.news import News
from site_builder.serving.ranges import asked_part

CLIENT = Path(__file__).with_name("client.js")
KEEP_ALIVE_S = 15.0
LOOPBACK = "127.0.0.1"
OWN_NAMES = ("localhost", "127.0.0.1", "::1")
WAITING = (
    b"<!DOCTYPE html><meta charset=utf-8><title>Being built</title>"
    b"<body><p>The book is being built. This page shows it as soon as it is there.</p>"
    b"<script type=module src=/.reload/client.js></script>"
)
"""Shown until the first build is done; what is wrong with the book is laid over it."""


class Server(ThreadingHTTPServer):
    """A thread for each request; those that only listen do not keep it from ending."""

    daemon_threads = True
    request_queue_size = 128


def start_server(out: Path, port: int, news: News, host: str = LOOPBACK) -> Server:
    """A server of the folder ``out``, running in a thread. Raises `OSError` where the port is
    taken."""
    handler = functools.partial(Handler, directory=str(out), news=news, host=host)
    try:
        server = Server((host, port), handler)
    except (OSError, OverflowError) as error:
        another = port + 1 if 0 < port < 65535 else 8000
        raise OSError(f"port {port} is taken or refused; try another: PORT={another}") from error
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

    def __init__(self, *args: object, news: News, host: str, **kwargs: object) -> None:
        self.news, self.host = news, host
        super().__init__(*args, **kwargs)  # type: ignore[arg-type]

    def do_GET(self) -> None:
        if not is_own(self.headers.get("Host", ""), self.host):
            self.send_error(HTTPStatus.MISDIRECTED_REQUEST, "not a name of this server")
        elif self.path == "/.reload/events":
            self._stream_events()
        elif self.path == "/.reload/client.js":
            self._send("text/javascript", CLIENT.read_bytes())
        elif not self.news.number:
            self._send("text/html; charset=utf-8", WAITING, status=503)
        else:
            super().do_GET()

    def do_HEAD(self) -> None:
        self.do_GET()

    def send_head(self) -> io.BytesIO | None:
        if not self._is_inside():
            self.send_error(HTTPStatus.NOT_FOUND)
            return None
        file = Path(self.translate_path(self.path))
        if "Range" in self.headers and file.is_file():
            content, state = file.read_bytes(), self.date_time_string(file.stat().st_mtime)
            part = asked_part(self.headers["Range"], len(content))
            if part is not None and self.headers.get("If-Range", state) == state:
                return self._send_part(content, part, state)
        return super().send_head()  # type: ignore[return-value]

    def _send_part(self, content: bytes, part: range, state: str) -> io.BytesIO:
        """Of a file that was changed last at ``state``."""
        asked = content[part.start : part.stop]
        self.send_response(HTTPStatus.PARTIAL_CONTENT if part else 416)
        where = f"{part.start}-{part.stop - 1}" if part else "*"
        self.send_header("Content-Range", f"bytes {where}/{len(content)}")
        self.send_header("Content-Type", self.guess_type(self.path.partition("?")[0]))
        self.send_header("Content-Length", str(len(asked)))
        self.send_header("Last-Modified", state)
        self.end_headers()
        return io.BytesIO(asked)

    def list_directory(self, _path: object) -> None:
        """Not of a folder without a page."""
        self.send_error(HTTPStatus.NOT_FOUND)

    def _is_inside(self) -> bool:
        """Whether the file lies in the site, links followed."""
        try:
            place = Path(self.translate_path(self.path)).resolve()
        except (OSError, ValueError):
            return False
        return place.is_relative_to(Path(self.directory).resolve())

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
        if self.command == "HEAD":
            return
        listener = self.news.listen()
        try:
            while True:
                try:
                    event = listener.get(timeout=KEEP_ALIVE_S)
                except queue.Empty:
                    event = ": still here\n\n"
                self.wfile.write(event.encode())
                self.wfile.flush()
        except (BrokenPipeError, ConnectionResetError):
            pass
        finally:
            self.news.leave(listener)


def is_own(name: str, host: str) -> bool:
    """Whether a request's ``Host`` names this server, which listens at ``host``."""
    bare = name.rpartition(":")[0] if name.rpartition(":")[2].isdigit() else name
    bare = bare.strip("[]").lower()
    if bare in (*OWN_NAMES, host.lower()):
        return True
    if host not in ("0.0.0.0", "::", ""):
        return False
    return _is_address(bare) or bare == socket.gethostname().lower()


def _is_address(name: str) -> bool:
    """A number cannot be let point elsewhere, as a name can."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
