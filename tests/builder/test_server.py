"""The development server: its replies, the changes that it detects, and its builds in separate
processes."""

import asyncio
import os
import shutil
import subprocess
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from starlette.testclient import TestClient
from support.engine import Engine
from support.places import GERMAN_BOOK

from site_builder.server import command as module
from site_builder.server.app import BuildEvents, State, make_app
from site_builder.server.command import Builds, changes, listen

FILES = ("a.mjs", "a.wasm", "404.html", "book.json", "a.woff2", "folder/a.css", "b/index.html")


def run[T](task: Coroutine[object, object, T]) -> T:
    """Run a task in its own thread, as the tests' browser has an event loop in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, task).result()


@pytest.fixture
def news() -> BuildEvents:
    return BuildEvents()


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "outside.txt").write_text("secret")
    site = tmp_path / "site"
    for name in FILES:
        (site / name).parent.mkdir(parents=True, exist_ok=True)
        (site / name).write_text(name)
    (site / "link.txt").symlink_to(tmp_path / "outside.txt")
    return site


@pytest.fixture
def client(site: Path, news: BuildEvents) -> TestClient:
    news.succeed([])
    return TestClient(make_app(site, news, "127.0.0.1"), "http://localhost:8000")


@pytest.mark.parametrize(
    ("name", "media_type"),
    [
        ("a.mjs", "text/javascript; charset=utf-8"),
        ("a.wasm", "application/wasm"),
        ("a.woff2", "font/woff2"),
        ("book.json", "application/json"),
    ],
)
def test_file_has_the_media_type_that_browsers_require(
    client: TestClient, name: str, media_type: str
) -> None:
    assert client.get(f"/{name}").headers["Content-Type"] == media_type


@pytest.mark.parametrize("path", ["/nothing/here", "/%2e%2e/outside.txt", "/link.txt", "/folder/"])
def test_unknown_address_gets_the_books_404_page(client: TestClient, path: str) -> None:
    reply = client.get(path)
    assert (reply.status_code, reply.text) == (404, "404.html")


@pytest.mark.parametrize(
    ("host", "name", "status"),
    [
        ("127.0.0.1", "localhost:8000", 200),
        ("127.0.0.1", "[::1]:8000", 200),
        ("127.0.0.1", "evil.example", 400),
        ("127.0.0.1", "localhost.evil.example", 400),
        ("127.0.0.1", "192.168.1.5:8000", 400),
        ("192.168.1.5", "192.168.1.5:8000", 200),
        ("0.0.0.0", "192.168.1.5:8000", 200),
    ],
)
def test_request_under_another_host_name_is_refused(
    site: Path, news: BuildEvents, host: str, name: str, status: int
) -> None:
    news.succeed([])
    client = TestClient(make_app(site, news, host))
    for path in ("/b/", "/.reload/client.js"):
        assert client.get(path, headers={"Host": name}).status_code == status


def test_deleted_site_is_reported_as_being_built(
    client: TestClient, site: Path, news: BuildEvents
) -> None:
    shutil.rmtree(site)
    reply = client.get("/b/")
    assert (reply.status_code, "Being built" in reply.text) == (503, True)
    assert news.state.event() == ": \n\n"  # otherwise the page would reload itself at once


def test_unusable_port_is_reported_with_another() -> None:
    with listen("127.0.0.1", 0) as other:
        port = other.getsockname()[1]
        for number, better in ((port, port + 1), (99999, 8000)):
            with pytest.raises(OSError, match=f"port {number} is taken .*={better}"):
                listen("127.0.0.1", number)


def test_changes_are_detected_behind_links_and_in_replaced_folders(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "LOOK_MS", 60)
    root = tmp_path / ".venv" / "node_modules" / "book"
    content, site, elsewhere = root / "content", root / "build", tmp_path / "elsewhere.md"
    elsewhere.write_text("one")
    for folder in (content, site):
        folder.mkdir(parents=True)
    (content / "linked.md").symlink_to(elsewhere)

    def replace_content() -> None:
        shutil.copytree(content, root / "new", symlinks=True)
        shutil.rmtree(content)
        (root / "new").rename(content)

    def write_beside() -> None:
        for name in (".a.md.swp", "a.md~", "__pycache__", ".git/x"):
            (content / name).parent.mkdir(exist_ok=True)
            (content / name).write_text("")
        (content / "b.md").write_text("")

    steps: list[tuple[Callable[[], object], Path]] = [
        (lambda: (content / "a.md").write_text("text"), content / "a.md"),
        (lambda: elsewhere.write_text("another"), content / "linked.md"),
        (replace_content, content),
        (lambda: (content / "a.md").write_text("new"), content / "a.md"),
        (lambda: shutil.rmtree(site), site),
        (write_beside, content / "b.md"),
    ]

    async def watch() -> list[set[Path]]:
        found, reports = [], aiter(changes([content], site))
        waiting = asyncio.ensure_future(anext(reports))
        for step, path in steps:
            await asyncio.sleep(0.3)
            step()
            seen: set[Path] = set()
            while path not in seen:
                seen |= await asyncio.wait_for(waiting, 10)
                waiting = asyncio.ensure_future(anext(reports))
            found.append(seen)
        waiting.cancel()
        return found

    found = run(watch())
    assert found[0] == {content / "a.md"}
    assert found[-1] == {content / "b.md"}


SCRIPT = """\
import pathlib, sys, time
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
(out.parent / "started").open("a").write("x")
sys.stdin.readline() or sys.exit()
(out / "a.html").write_text("new")
{then}
"""


@pytest.fixture
def builds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Builds:
    """Builds of a book whose builder is a script from the test."""
    (tmp_path / "site_builder").mkdir()
    (tmp_path / "site").mkdir()
    monkeypatch.setattr("site_builder.server.command.ENGINE", tmp_path)
    return Builds(
        root=tmp_path,
        out=tmp_path / "site",
        runtime=True,
        news=BuildEvents(),
        address="http://localhost:8000/",
    )


def write_builder(builds: Builds, then: str = "") -> None:
    script = builds.root / "site_builder" / "__main__.py"
    script.write_text(SCRIPT.format(then=then))


def test_cancelled_build_ends_its_process(builds: Builds) -> None:
    write_builder(builds, "time.sleep(1); (out / 'late.html').write_text('')")

    async def cancel_build() -> None:
        build = asyncio.create_task(builds.build())
        while not (builds.out / "a.html").exists():
            await asyncio.sleep(0.01)
        build.cancel()
        await asyncio.wait([build])
        await asyncio.sleep(1.2)

    run(cancel_build())
    assert not (builds.out / "late.html").exists()
    assert builds.news.state == State()


@pytest.mark.parametrize(("renewed", "text"), [(True, "newer"), (False, "old")])
def test_next_build_uses_preloaded_code_unless_it_has_changed(
    builds: Builds, renewed: bool, text: str
) -> None:
    def writing(word: str) -> str:
        return f"import pathlib; pathlib.Path('{builds.out}/b.html').write_text('{word}')"

    async def two_builds() -> None:
        write_builder(builds, writing("old"))
        await builds.build()
        while (builds.root / "started").read_text() != "xx":
            await asyncio.sleep(0.01)
        write_builder(builds, writing("newer"))  # of another length: compiled code goes by it
        if renewed:
            await builds.end_waiting()
        await builds.build()
        await builds.end_waiting()

    run(two_builds())
    assert (builds.out / "b.html").read_text() == text


def test_waiting_process_that_has_ended_is_replaced(builds: Builds) -> None:
    """It ends at once if the book is missing for a moment."""

    async def two_builds() -> None:
        write_builder(builds)
        await builds.build()
        waiting = builds._next
        assert waiting
        waiting.kill()
        await waiting.wait()
        await builds.build()
        await builds.end_waiting()

    run(two_builds())
    assert builds.news.state.number == 2
    assert not builds.news.state.mistakes


REFUSED = "http://127.0.0.1:9"
"""A proxy at an unused port, where every connection is refused at once."""
LAST = "<!DOCTYPE html><title>The last good site</title>"


def test_first_build_without_a_network_advises_and_keeps_the_last_site(
    engine: Engine, tmp_path: Path
) -> None:
    for name in ("home", "cache", "work/site"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "work" / "site" / "index.html").write_text(LAST, encoding="utf-8")
    own = {"HOME": tmp_path / "home", "XDG_CACHE_HOME": tmp_path / "cache", "NO_PROXY": ""}
    proxies = {f"{kind}_proxy": REFUSED for kind in ("http", "https", "all")}
    named = {**proxies, **{name.upper(): REFUSED for name in proxies}, "no_proxy": ""}
    command = [engine.python, "-m", "site_builder", "serve", "--port", "0"]
    with subprocess.Popen(
        [*command, "--out", str(tmp_path / "work" / "site")], cwd=GERMAN_BOOK, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        env={**os.environ, **named, **{name: str(place) for name, place in own.items()}},
    ) as serving:  # fmt: skip
        assert serving.stdout
        output = ""
        for line in serving.stdout:
            output += line
            if line.startswith("http://localhost"):
                break
        serving.terminate()
    assert "Connect to the internet once: it is kept and never requested again." in output
    assert output.count("cannot get Temml from npm") == 1
    assert "Traceback" not in output
    work = sorted(str(path.relative_to(tmp_path)) for path in (tmp_path / "work").rglob("*"))
    assert work == ["work/site", "work/site/index.html"], "nothing half done"
    assert (tmp_path / "work" / "site" / "index.html").read_text(encoding="utf-8") == LAST
    kept = [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    assert not [path for path in kept if "partial" in path.name or "runtime" in path.parts]
