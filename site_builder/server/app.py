"""The site as a static host would serve it, and two addresses for open pages."""

import mimetypes
from pathlib import Path

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from site_builder.server.news import News

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


def make_app(out: Path, news: News, host: str) -> Starlette:
    """Serves the folder ``out``. Requests by another name than that of this server are refused, as
    when another site's name has been pointed here (DNS rebinding)."""
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

    def __init__(self, out: Path, news: News) -> None:
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
