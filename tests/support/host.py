"""A host as `_headers` and the packed copies are meant for: it sends what the one says, and of each
file the smallest copy that the browser takes."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from fnmatch import fnmatchcase
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from time import time
from urllib.parse import unquote

from support.static_server import TYPES, QuietServer, running

KINDS = TYPES | {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css",
    ".webp": "image/webp",
    ".png": "image/png",
    ".webmanifest": "application/manifest+json",
}
ENCODINGS = {"br": ".br", "gzip": ".gz"}
"""The best first."""

type Rules = Mapping[str, Mapping[str, str]]
"""Headers by pattern of paths."""


@dataclass(frozen=True, slots=True)
class Sent:
    """An answer."""

    name: str
    """Name of the file."""
    query: str
    """What stood behind it in the address."""
    size: int
    """Bytes of the body."""
    asked_ms: float
    """When it was asked for, as browsers tell the time."""


class Host:
    """The folder ``root`` at ``url``, with these packed ``copies`` beside those in it; ``rules`` in
    place of what ``_headers`` says."""

    def __init__(self, root: Path, copies: Mapping[str, bytes], rules: Rules | None) -> None:
        self.root, self.copies = root, copies
        self.sent: list[Sent] = []
        self.rules = read_rules(root / "_headers") if rules is None else rules
        handler = type("Bound", (Handler,), {"host": self})
        self.server = QuietServer(("127.0.0.1", 0), handler)
        self.url = f"http://127.0.0.1:{self.server.server_address[1]}/"

    def packed(self, name: str, accepted: str) -> tuple[str, bytes]:
        """The encoding, and the body in it."""
        for encoding, ending in ENCODINGS.items():
            if encoding in accepted:
                if body := self.copies.get(name + ending):
                    return encoding, body
                if (self.root / (name + ending)).is_file():
                    return encoding, (self.root / (name + ending)).read_bytes()
        return "", (self.root / name).read_bytes()


class Handler(BaseHTTPRequestHandler):
    """Files, nothing else."""

    host: Host
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        asked_ms = 1000 * time()
        address, _, query = self.path.partition("?")
        path = unquote(address)
        name = path.lstrip("/")
        if (self.host.root / name).is_dir():
            name = f"{name.rstrip('/')}/index.html".lstrip("/")
        there = (self.host.root / name).is_file()
        name = name if there else "404.html"
        encoding, body = self.host.packed(name, self.headers.get("Accept-Encoding", ""))
        self.send_response(200 if there else 404)
        self.send_header("Content-Type", KINDS.get(Path(name).suffix, "application/octet-stream"))
        self.send_header("Content-Length", str(len(body)))
        if encoding:
            self.send_header("Content-Encoding", encoding)
        for pattern, headers in self.host.rules.items():
            if fnmatchcase(path, pattern):
                for header, value in headers.items():
                    self.send_header(header, value)
        self.end_headers()
        self.wfile.write(body)
        self.host.sent.append(Sent(name, query, len(body), asked_ms))

    def log_message(self, *_: object) -> None:
        """Print nothing: tests report for themselves."""


def read_rules(file: Path) -> Rules:
    """Read the rules of such a file; none without one."""
    rules: dict[str, dict[str, str]] = {}
    pattern = ""
    for line in file.read_text(encoding="utf-8").splitlines() if file.is_file() else ():
        if line.startswith(" "):
            name, _, value = line.strip().partition(": ")
            rules[pattern][name] = value
        elif line.strip() and not line.startswith("#"):
            pattern = line.strip()
            rules[pattern] = {}
    return rules


@contextmanager
def hosting(
    root: Path, copies: Mapping[str, bytes] | None = None, rules: Rules | None = None
) -> Iterator[Host]:
    host = Host(root, copies or {}, rules)
    with running(host.server):
        yield host
