"""The site as a static host would serve it, and two addresses for open pages, which get the state
of the builds as server-sent events."""

import asyncio
import json
import mimetypes
from collections.abc import AsyncIterator, Iterable
from dataclasses import dataclass
from pathlib import Path

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import Scope


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


class BuildEvents:
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


CLIENT = Path(__file__).with_name("reload.js")
OWN_NAMES = ("localhost", "127.0.0.1", "[::1]")
ANY_ADDRESS = ("0.0.0.0", "::")
TYPES = {
    ".js": "text/javascript",
    ".json": "application/json",
    ".mjs": "text/javascript",
    ".svg": "image/svg+xml",
    ".wasm": "application/wasm",
    ".woff2": "font/woff2",
}
"""Media types that browsers require; the system's own table may differ."""
WAITING = (
    "<!DOCTYPE html><meta charset=utf-8><title>Being built</title>"
    "<body><p>The book is being built. This page shows it as soon as it is there.</p>"
    "<script type=module src=/.reload/client.js></script>"
)
"""Shown until the first good build; mistakes are laid over it."""


def make_app(out: Path, news: BuildEvents, host: str) -> Starlette:
    """An application that serves the folder ``out``. Requests for a host name other than this
    server's are refused (DNS rebinding)."""
    for suffix, media_type in TYPES.items():
        mimetypes.add_type(media_type, suffix)

    async def events(_request: Request) -> Response:
        return StreamingResponse(news.events(), media_type="text/event-stream")

    async def client(_request: Request) -> Response:
        return FileResponse(CLIENT, headers={"Cache-Control": "no-cache"})

    names = ["*"] if host in ANY_ADDRESS else [*OWN_NAMES, f"[{host}]" if ":" in host else host]
    return Starlette(
        routes=[
            Route("/.reload/events", events),
            Route("/.reload/client.js", client),
            Mount("/", _Site(out, news)),
        ],
        middleware=[Middleware(TrustedHostMiddleware, allowed_hosts=names, www_redirect=False)],
    )


class _Site(StaticFiles):
    """The files of the last good build, which browsers revalidate at every load."""

    def __init__(self, out: Path, news: BuildEvents) -> None:
        super().__init__(directory=out, html=True, check_dir=False)
        self._out, self._news = out, news

    async def check_config(self) -> None:
        """The folder is there after the first build."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        if self._news.state.number and not self._out.is_dir():
            self._news.restart()
        if not self._news.state.number:
            return HTMLResponse(WAITING, 503)
        response = await super().get_response(path, scope)
        response.headers["Cache-Control"] = "no-cache"
        response.headers["Server-Timing"] = f'build;desc="{self._news.state.number}"'
        return response
