"""Build, serve, and build again on every change."""

import asyncio
import signal
import socket
from collections.abc import AsyncIterator
from pathlib import Path

import uvicorn

from site_builder.files.engine import ENGINE, STATIC
from site_builder.server.app import make_app
from site_builder.server.builds import Builds, changes, is_code
from site_builder.server.news import News

LOOPBACK = "127.0.0.1"


def serve(root: Path, out: Path, port: int, *, runtime: bool, host: str = LOOPBACK) -> None:
    """Serve until interrupted. Raises `OSError` with a clear message where the port is taken."""
    with listen(host, port) as listener:
        shown = "localhost" if host == LOOPBACK else host
        address = f"http://{shown}:{listener.getsockname()[1]}/"
        builds = Builds(root, out.resolve(), runtime, News(), address)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            asyncio.run(_serve(builds, listener, host))
        except KeyboardInterrupt:
            print()  # the usual way to end


def listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    another = port + 1 if 0 < port < 65535 else 8000
    refused = f"port {port} is taken or refused; try another: PORT={another}"
    if not 0 <= port < 65536:
        raise OSError(refused)
    try:
        return socket.create_server((host, port), family=family, backlog=128)
    except OSError as error:
        raise OSError(refused) from error


async def _serve(builds: Builds, listener: socket.socket, host: str) -> None:
    app = make_app(builds.out, builds.news, host)
    config = uvicorn.Config(app, log_level="critical", lifespan="off", timeout_graceful_shutdown=0)
    async with asyncio.TaskGroup() as tasks:
        watching = tasks.create_task(_build_on_change(builds))
        await uvicorn.Server(config).serve(sockets=[listener])
        watching.cancel()


async def _build_on_change(builds: Builds) -> None:
    """The newest change wins: a build of an outdated state is cancelled."""
    try:
        async with asyncio.TaskGroup() as tasks:
            build = tasks.create_task(builds.build())
            async for changed in _sources(builds):
                if any(map(is_code, changed)):
                    await builds.end_waiting()
                if not (build.done() and builds.replace_styles(changed)):
                    build.cancel()
                    await asyncio.wait([build])
                    build = tasks.create_task(builds.build())
    finally:
        await builds.end_waiting()


def _sources(builds: Builds) -> AsyncIterator[set[Path]]:
    own = {builds.root / name for name in ("content", "simulations", "static")}
    engine = {ENGINE / "simulations", ENGINE / "site_builder", STATIC}
    return changes(own | engine, builds.out)
