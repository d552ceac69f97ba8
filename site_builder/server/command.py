"""Build, serve, and build again on every change, each time in a process of its own, so that it runs
the code as it is now."""

import asyncio
import os
import re
import signal
import socket
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import AsyncIterator, Collection, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import uvicorn
from watchfiles import Change, awatch

from site_builder.assets.page_assets import NOW, STYLE_SHEET
from site_builder.diagnostics.diagnostic import END
from site_builder.files.engine import ENGINE, STATIC
from site_builder.files.folders import folder_files, replace_file
from site_builder.server.app import BuildEvents, make_app

DEBOUNCE_MS = 100
STEP_MS = 10
"""How long nothing more must change before a change is reported."""
LOOK_MS = 1000
"""After which is looked for what the system does not report: folders replaced, and files changed
behind symbolic links."""
IGNORED = re.compile(r"\.|__pycache__$|.*(?:~|\.py[cod]|\.sw.|___jb_..._)$")
"""Names of what editors and Python write beside the sources."""

type Inodes = Mapping[Path, tuple[int, int]]


async def changes(folders: Collection[Path], made: Path) -> AsyncIterator[set[Path]]:
    """Changed files, time after time. The folder ``made`` is reported once it is gone."""

    def is_source(_change: Change, name: str) -> bool:
        """Judged by its path below the folder, wherever that lies."""
        path = Path(name)
        inside = next(
            (path.relative_to(each) for each in folders if path.is_relative_to(each)), path
        )
        return not any(map(IGNORED.match, inside.parts))

    before, looks_without = _inodes(folders), 2
    while True:
        present = sorted(folder for folder in folders if folder.is_dir())
        async for found in awatch(
            *present, watch_filter=is_source, debounce=DEBOUNCE_MS, step=STEP_MS,
            rust_timeout=LOOK_MS, yield_on_timeout=True,
        ):  # fmt: skip
            now = _inodes(folders)
            looks_without = 0 if made.is_dir() else looks_without + 1  # a build swaps it, too
            unreported = {path for path in {*before, *now} if before.get(path) != now.get(path)}
            gone = {made} if looks_without == 2 else set()
            before = now
            if changed := {Path(name) for _, name in found} | unreported | gone:
                yield changed
            if unreported & {*folders}:
                break


def _inodes(folders: Collection[Path]) -> Inodes:
    """Inodes of the folders, and of the targets of links in them with their times of change."""
    found: dict[Path, tuple[int, int]] = {}
    for folder in folders:
        if folder.is_dir():
            found[folder] = (folder.stat().st_ino, 0)
            for path in folder_files(folder).values():
                if path.is_symlink():
                    state = path.stat()
                    found[path] = (state.st_ino, state.st_mtime_ns)
    return found


MOST_BYTES = 1 << 20
"""Limit of a line that a build prints."""

type Files = dict[str, tuple[int, int]]
"""Time of change and size of files, by name."""


@dataclass(slots=True, kw_only=True)
class Builds:
    """Builds the book at ``root`` into ``out``, and reports the outcome to ``news``."""

    root: Path
    out: Path
    runtime: bool
    news: BuildEvents
    address: str
    """Printed after the first build."""
    _sheets: dict[Path, str] = field(default_factory=dict)
    """The style sheets as the site has them."""
    _files: Files = field(default_factory=dict)
    """The site as open pages have it: a cancelled build may have written it all the same."""
    _terminal: int = field(default_factory=lambda: os.dup(2))
    """On which a build shows how far it is; its own standard error is read here."""
    _next: Process | None = None
    """Has imported the builder and waits for a change."""

    async def build(self) -> None:
        """One build. Cancelled, it ends the process; the last good site stays."""
        self._sheets = dict(style_sheets(self.root))
        process, self._next = self._next, None
        if process is None or process.returncode is not None:  # it found no book, which may be back
            process = await self._start()
        try:
            printed, problems = await _output(process)
        finally:
            await end(process)
        if process.returncode:
            self.news.fail(problems or f"the build ended with exit code {process.returncode}")
            print(self.news.state.mistakes, flush=True)
        else:
            before, self._files = self._files, files_in(self.out)
            self.news.succeed(differing(before, self._files))
            print(problems, end="", file=sys.stderr, flush=True)
            print(printed, end="", flush=True)
        if self.address:
            print(self.address, flush=True)
            self.address = ""
        self._next = await self._start()

    async def end_waiting(self) -> None:
        """End the process that has imported the code as it was."""
        waiting, self._next = self._next, None
        if waiting:
            await end(waiting)

    async def _start(self) -> Process:
        """A process that builds as soon as it is sent a line, and ends with its input."""
        runtime = [] if self.runtime else ["--no-runtime"]
        return await asyncio.create_subprocess_exec(
            sys.executable, "-m", "site_builder", "build", "--reload", "--wait",
            "--out", self.out, *runtime, "--bar", str(self._terminal),
            stdin=PIPE, stdout=PIPE, stderr=PIPE, pass_fds=[self._terminal],
            limit=MOST_BYTES,
            cwd=self.root, start_new_session=True,
        )  # fmt: skip

    def replace_styles(self, changed: Collection[Path]) -> bool:
        """Put changed style sheets into the joined one, which needs no build. False where something
        else has changed too, or where the joined sheet does not hold a sheet as it was."""
        joined = self.out / NOW / STYLE_SHEET
        if self.news.state.mistakes or not joined.is_file():
            return False
        text = joined.read_text(encoding="utf-8")
        after = {path: sheet for path, sheet in style_sheets(self.root) if path in changed}
        for path in changed:
            old = self._sheets.get(path, "")
            if path not in after or not old or text.count(old) != 1:
                return False
            text = text.replace(old, after[path])
        replace_file(joined, text.encode())
        self._sheets |= after
        self._files = files_in(self.out)
        self.news.succeed([NOW + STYLE_SHEET])
        return True


async def _output(process: Process) -> tuple[str, str]:
    """What a build prints once it is sent a line, and its problems. Progress is shown at once."""
    assert process.stdin
    assert process.stdout
    assert process.stderr
    process.stdin.write(b"\n")
    process.stdin.close()
    problems = []
    async for data in process.stderr:
        line = data.decode(errors="replace")
        if line.rstrip().endswith(END) and ": " not in line:  # no diagnostic
            print(line, end="", flush=True)
        else:
            problems.append(line)
    printed = await process.stdout.read()
    await process.wait()
    return printed.decode(errors="replace"), "".join(problems)


def is_code(path: Path) -> bool:
    """Whether a process that has imported the builder may have read the file already."""
    return (
        path.suffix == ".py"
        or path.parent.name == "hard_cases"
        or path.is_relative_to(ENGINE / "site_builder")
    )


async def end(process: Process) -> None:
    """With all that it has started."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    await process.wait()


def style_sheets(root: Path) -> Iterator[tuple[Path, str]]:
    for static in {root / "static", STATIC}:
        for path in (static / "css").glob("*.css"):
            yield path, path.read_text(encoding="utf-8", errors="replace")


def files_in(folder: Path) -> Files:
    found: Files = {}
    for path in folder.rglob("*"):
        with suppress(FileNotFoundError):  # another build may replace the site meanwhile
            if path.is_file():
                state = path.stat()
                found[path.relative_to(folder).as_posix()] = (state.st_mtime_ns, state.st_size)
    return found


def differing(before: Files, after: Files) -> list[str]:
    """
    >>> differing({"a": (1, 1), "b": (1, 1), "c": (1, 1)}, {"a": (1, 1), "b": (2, 1)})
    ['b', 'c']
    """
    return sorted(name for name in before | after if before.get(name) != after.get(name))


LOOPBACK = "127.0.0.1"


def serve(root: Path, out: Path, port: int, *, runtime: bool, host: str = LOOPBACK) -> None:
    """Serve until interrupted. Raises `OSError` with a clear message where the port is taken."""
    with listen(host, port) as listener:
        shown = "localhost" if host == LOOPBACK else host
        address = f"http://{shown}:{listener.getsockname()[1]}/"
        builds = Builds(
            root=root, out=out.resolve(), runtime=runtime, news=BuildEvents(), address=address
        )
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
    own = {builds.root / name for name in ("content", "simulations", "static")}
    engine = {ENGINE / "simulations", ENGINE / "site_builder", STATIC}
    try:
        async with asyncio.TaskGroup() as tasks:
            build = tasks.create_task(builds.build())
            async for changed in changes(own | engine, builds.out):
                if any(map(is_code, changed)):
                    await builds.end_waiting()
                if not (build.done() and builds.replace_styles(changed)):
                    build.cancel()
                    await asyncio.wait([build])
                    build = tasks.create_task(builds.build())
    finally:
        await builds.end_waiting()
